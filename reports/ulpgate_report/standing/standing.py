"""What a run is held to: findings of the gate, and the rows that are others than in an earlier run."""
import json
from dataclasses import dataclass

from ulpgate_report.kernels import combine as combine_kernels
from ulpgate_report.math import combine as combine_math
from ulpgate_report.math import reproducer
from ulpgate_report.records.errors import InvalidInput
from ulpgate_report.values import numbers

# A finding of this kind is no failure: a limit that could be lower.
_NOTES = ("note",)
# And these say that a row was not judged, not that it is wrong.
_UNJUDGED = ("another plan", "no budget", "not measured", "incomplete")
_FIELDS = ("kind", "function", "type", "message")
WORSE, BETTER, NEW, GONE = "worse", "better", "new", "gone"


@dataclass(frozen=True)
class Change:
    """A row that is another than before; errors are None where the row was not there or nothing was judged."""

    label: str
    type: str
    change: str
    before: object
    after: object
    wrong_before: int
    wrong_after: int
    command: object


@dataclass(frozen=True)
class Gate:
    """What a gate came to: its exit code, its verdict in words, findings, and what is wrong beside them."""

    exit_code: int
    verdict: str
    findings: list
    remarks: tuple = ()


@dataclass(frozen=True)
class Standing:
    """`gate` is None where none was asked, `changes` where there is no earlier run."""

    gate: object
    changes: object
    rows: int
    before: dict
    wrong_kind: int
    complete: bool

    @property
    def failures(self):
        """What the gate holds against the run."""
        findings = self.gate.findings if self.gate else ()
        return [f for f in findings if f["kind"].lower() not in _NOTES]

    @property
    def wrong(self):
        """Those of the failures that were judged."""
        return [f for f in self.failures if f["kind"].lower() not in _UNJUDGED]

    def of_change(self, change):
        """The changes of one sort."""
        return [one for one in self.changes or () if one.change == change]


def _is_gate(found):
    """Whether it has what is read of it here."""
    if not isinstance(found, dict):
        return False
    sets, findings = found.get("sets"), found.get("findings")
    return (
        isinstance(found.get("exit_code"), int)
        and isinstance(found.get("verdict"), str)
        and isinstance(sets, list)
        and all(
            isinstance(s, dict) and isinstance(s.get("remarks"), list) for s in sets
        )
        and isinstance(findings, list)
        and all(
            isinstance(f, dict) and all(isinstance(f.get(k), str) for k in _FIELDS)
            for f in findings
        )
    )


def load_gate(path):
    """The Gate in a file that `ulpgate gate --json` printed."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InvalidInput(f"{path}: {error.strerror}") from error
    except ValueError as error:
        raise InvalidInput(f"{path}: {error}") from error
    if not _is_gate(found):
        raise InvalidInput(f"{path}: not what `ulpgate gate --json` prints")
    remarks = [said for one in found["sets"] for said in one["remarks"]]
    return Gate(found["exit_code"], found["verdict"], found["findings"], tuple(remarks))


def _cells(run):
    """{(row, type): (largest error, wrong kinds, command or None)} of functions and kernels."""
    found = {}

    def shown(key, args):
        row, token = key
        if not args:
            return None
        return reproducer.command_of(run.context, row.function, token, args)

    if run.math:
        for key, cell in combine_math.combine_run(run).cells.items():
            found[key] = (cell.max_ulp, cell.mismatches, shown(key, cell.argmax))
    if run.kernels:
        for key, cell in combine_kernels.combine_run(run).cells.items():
            command = shown(key, cell.normwise_argmax)
            found[key] = (cell.max_ulp, cell.mismatches, command)
    return found


def _change(old, new):
    """WORSE, BETTER or None of a row that both runs have; results of the wrong kind weigh more than errors."""
    if old[1] != new[1]:
        return WORSE if new[1] > old[1] else BETTER
    if old[0] == new[0]:
        return None
    if new[0] is None:
        return WORSE  # nothing is judged any more
    return WORSE if numbers.larger(new[0], old[0]) else BETTER


def _changes(old, new):
    found = []
    for key in dict.fromkeys([*new, *old]):
        row, token = key
        before, after = old.get(key), new.get(key)
        if before and after:
            change = _change(before, after)
        else:
            change = NEW if after else GONE
        if change is None:
            continue
        found.append(
            Change(
                row.label,
                token,
                change,
                before and before[0],
                after and after[0],
                before[1] if before else 0,
                after[1] if after else 0,
                (after or before)[2],
            )
        )
    order = (WORSE, GONE, NEW, BETTER)
    return sorted(found, key=lambda one: order.index(one.change))


def of(run):
    """The standing of a run; None where it has neither functions nor kernels."""
    if not (run.math or run.kernels):
        return None
    cells = _cells(run)
    changes = None if run.before is None else _changes(_cells(run.before), cells)
    wrong = sum(cell[1] for cell in cells.values())
    before = {} if run.before is None else run.before.context
    complete = run.context.get("complete", True)
    return Standing(run.gate, changes, len(cells), before, wrong, complete)
