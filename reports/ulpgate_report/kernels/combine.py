"""Combines the strata of each (kernel, quantity, type), and what one stratum shows over all types."""
from dataclasses import dataclass

from ulpgate_report.values import numbers
from ulpgate_report.values.row import Row

UNSTABLE = "unstable"
# More roundings than a backward stable evaluation of a few dozen operations accumulates: the limit of the verdict.
STABILITY_LIMIT = 16


@dataclass(frozen=True)
class KernelCell:
    """The combined numbers of one quantity and type; None where no finite sample was judged.

    `condition` belongs to the state of the largest normwise error, which stands in `normwise_argmax`.
    """

    samples: int
    max_ulp: object
    ulp_stratum: object
    max_normwise: object
    normwise_stratum: object
    normwise_argmax: tuple
    condition: object
    max_normwise_over_condition: object
    over_condition_stratum: object
    verdict: str
    mismatches: int

    @property
    def reading(self):
        """What the three numbers say together, in words."""
        if self.verdict == UNSTABLE:
            return "unstable"
        if self.max_ulp is None:
            return "nothing judged"
        if not numbers.larger(self.max_ulp, STABILITY_LIMIT):
            return "accurate"
        if numbers.larger(self.max_normwise, STABILITY_LIMIT):
            return "ill-conditioned, not unstable"
        return "small component of a vector"


@dataclass(frozen=True)
class CombinedKernels:
    """A run of kernels: cells by (Row, type token), and by (Row, stratum) over all types."""

    context: dict
    types: tuple
    rows: tuple
    strata: tuple
    cells: dict
    stratum_cells: dict
    records: tuple

    @property
    def type_tokens(self):
        """Tokens in the order of the context."""
        return tuple(entry["token"] for entry in self.types)


def row_of_record(record):
    """The row that a record belongs to."""
    return Row(record["function"], record["part"], "kernel")


def _largest(records, key):
    best, holder = None, {}
    for record in records:
        value = numbers.measured(record[key])
        if numbers.larger(value, best):
            best, holder = value, record
    return best, holder


def combine_cell(records):
    """One cell from the records of one row, which come in display order; a tie goes to the first."""
    max_ulp, ulp_holder = _largest(records, "max_ulp")
    max_normwise, holder = _largest(records, "max_normwise")
    over, over_holder = _largest(records, "max_normwise_over_condition")
    unstable = any(record["verdict"] == UNSTABLE for record in records)
    return KernelCell(
        samples=sum(record["samples"] for record in records),
        max_ulp=max_ulp,
        ulp_stratum=ulp_holder.get("stratum"),
        max_normwise=max_normwise,
        normwise_stratum=holder.get("stratum"),
        normwise_argmax=tuple(holder.get("normwise_argmax", ())),
        condition=numbers.measured(holder.get("condition")),
        max_normwise_over_condition=over,
        over_condition_stratum=over_holder.get("stratum"),
        verdict=UNSTABLE if unstable else "stable",
        mismatches=sum(sum(record["mismatch"].values()) for record in records),
    )


def _cells(records, second):
    grouped = {}
    for record in records:
        key = (row_of_record(record), record[second])
        grouped.setdefault(key, []).append(record)
    return {key: combine_cell(group) for key, group in grouped.items()}


def combine_run(run):
    """All cells of a run of kernels, in display order whatever the order of the lines was."""
    context = run.context
    rows = tuple(
        Row(entry["name"], output["name"], "kernel")
        for entry in context["kernels"]
        for output in entry["outputs"]
    )
    strata = tuple(context["strata"])
    place = {row: index for index, row in enumerate(rows)}
    type_place = {entry["token"]: i for i, entry in enumerate(context["types"])}
    records = sorted(
        run.kernels,
        key=lambda record: (
            place[row_of_record(record)],
            type_place[record["type"]],
            strata.index(record["stratum"]),
        ),
    )
    return CombinedKernels(
        context=context,
        types=tuple(context["types"]),
        rows=rows,
        strata=strata,
        cells=_cells(records, "type"),
        stratum_cells=_cells(records, "stratum"),
        records=tuple(records),
    )
