"""Combines the strata of each (function, part, type): maxima by max, counts and histograms by sum, means by weight."""
from dataclasses import dataclass

from ulpgate_report.values import numbers
from ulpgate_report.values.row import Row

# The two sets of arguments that the published table was made with.
PAPER_STRATA = ("uniform", "stratified")
BUCKETS_PER_OCTAVE = 4


@dataclass(frozen=True)
class Cell:
    """The combined numbers of one row and type; None where no finite sample was judged."""

    samples: int
    judged: int
    max_ulp: object
    stratum: object
    argmax: tuple
    max_float_distance: object
    mean_ulp: object
    p50_ulp: object
    p99_ulp: object
    correctly_rounded: int
    exact_count: int
    buckets: tuple
    mismatch: dict
    max_ulp_over_condition: object
    oracle_compared: int
    oracle_disagreed: int

    @property
    def mismatches(self):
        """Samples whose outcome is of the wrong kind, over all classes."""
        return sum(self.mismatch.values())


@dataclass(frozen=True)
class CombinedRun:
    """A run with its cells: over all strata, and over the paper's two alone; keys are (Row, type token)."""

    context: dict
    types: tuple
    rows: tuple
    strata: tuple
    cells: dict
    paper_cells: dict
    records: tuple
    time_ns: dict

    @property
    def type_tokens(self):
        """Tokens in the order of the context."""
        return tuple(entry["token"] for entry in self.types)


def bucket_upper_ulp(index):
    """Upper edge of a histogram bucket in ULP; inf beyond a double's range."""
    try:
        return 2.0 ** (index / BUCKETS_PER_OCTAVE)
    except OverflowError:
        return numbers.INFINITE


def percentile_ulp(share, judged, exact_count, buckets, max_ulp):
    """Upper bound of a percentile: the upper edge of the bucket that holds it, no larger than the maximum.

    `buckets` is sorted. Judged samples that no bucket holds have an infinite error and stand last.
    """
    if judged == 0 or max_ulp is None:
        return None
    # The smallest count that reaches the share, in integers: a share is given in percent.
    wanted = -(-judged * share // 100)
    seen = exact_count
    if seen >= wanted:
        return 0
    for index, count in buckets:
        seen += count
        if seen >= wanted:
            edge = bucket_upper_ulp(index)
            return edge if edge < max_ulp else max_ulp
    return max_ulp


def _weighted_mean_ulp(records):
    judged = sum(record["judged"] for record in records)
    pairs = [
        (numbers.measured(record["mean_ulp"]), record["judged"])
        for record in records
        if record["judged"] and record["mean_ulp"] is not None
    ]
    if not pairs:
        return None
    if any(mean == numbers.INFINITE for mean, _ in pairs):
        return numbers.INFINITE
    return sum(mean * weight for mean, weight in pairs) / judged


def _largest(records, key):
    """The largest value of `key` and the first record that has it."""
    best, holder = None, None
    for record in records:
        value = numbers.measured(record.get(key))
        if numbers.larger(value, best):
            best, holder = value, record
    return best, holder


def _summed(pairs):
    total = {}
    for key, count in pairs:
        if count:
            total[key] = total.get(key, 0) + count
    return dict(sorted(total.items()))


def combine_cell(records):
    """One cell from the records of one row and type, which come in the order of the strata."""
    max_ulp, worst = _largest(records, "max_ulp")
    judged = sum(record["judged"] for record in records)
    exact_count = sum(record["histogram"]["exact"] for record in records)
    buckets = tuple(
        _summed(pair for r in records for pair in r["histogram"]["buckets"]).items()
    )
    oracles = [record.get("oracle", {}) for record in records]
    return Cell(
        samples=sum(record["samples"] for record in records),
        judged=judged,
        max_ulp=max_ulp,
        stratum=worst["stratum"] if worst else None,
        argmax=tuple(worst["argmax"]) if worst else (),
        max_float_distance=_largest(records, "max_float_distance")[0],
        mean_ulp=_weighted_mean_ulp(records),
        p50_ulp=percentile_ulp(50, judged, exact_count, buckets, max_ulp),
        p99_ulp=percentile_ulp(99, judged, exact_count, buckets, max_ulp),
        correctly_rounded=sum(record["correctly_rounded"] for record in records),
        exact_count=exact_count,
        buckets=buckets,
        mismatch=_summed(pair for r in records for pair in r["mismatch"].items()),
        max_ulp_over_condition=_largest(records, "max_ulp_over_condition")[0],
        oracle_compared=sum(oracle.get("compared", 0) for oracle in oracles),
        oracle_disagreed=sum(oracle.get("disagreed", 0) for oracle in oracles),
    )


def _cells(records, row_of, strata):
    grouped = {}
    for record in records:
        if record["stratum"] in strata:
            row = row_of[record["function"], record["part"]]
            grouped.setdefault((row, record["type"]), []).append(record)
    return {key: combine_cell(group) for key, group in grouped.items()}


def combine_run(run):
    """All cells of a run, in display order whatever the order of the lines was."""
    context = run.context
    rows = tuple(
        Row(entry["name"], part, entry["class"])
        for entry in context["functions"]
        for part in entry["parts"]
    )
    row_of = {(row.function, row.part): row for row in rows}
    types = tuple(context["types"])
    strata = tuple(context["strata"])
    place = {key: index for index, key in enumerate(row_of)}
    type_place = {entry["token"]: index for index, entry in enumerate(types)}
    records = sorted(
        run.math,
        key=lambda record: (
            place[record["function"], record["part"]],
            type_place[record["type"]],
            strata.index(record["stratum"]),
        ),
    )
    return CombinedRun(
        context=context,
        types=types,
        rows=rows,
        strata=strata,
        cells=_cells(records, row_of, strata),
        paper_cells=_cells(records, row_of, PAPER_STRATA),
        records=tuple(records),
        time_ns=run.time_ns,
    )
