"""The short text of one table cell, shared by the formats that people read."""
from ulpgate_report.tables.table import Judged, Marked
from ulpgate_report.values import numbers

_SHORT = {
    "ulp": numbers.short_ulp,
    "distance": numbers.short_distance,
    "real": numbers.short_real,
    "rough": numbers.rough,
}
NUMERIC_KINDS = ("count", "ulp", "distance", "real", "rough")
CODE_KINDS = ("code", "arguments", "command")
# Beyond this a command is cut where its whole length has no place.
COMMAND_LENGTH = 64


def value_and_mark(cell):
    """The bare value of a cell and the mark beside it, empty where there is none."""
    if isinstance(cell, (Marked, Judged)):
        return cell.value, cell.mark
    return cell, ""


def is_cut(cell, kind, argument_digits):
    """Whether the short form leaves digits out."""
    value, _ = value_and_mark(cell)
    cuts = kind in ("arguments", "command") and value
    return bool(cuts) and short(value, kind, argument_digits) != short(value, kind)


def short(cell, kind, argument_digits=None):
    """The cell without its mark; arguments and commands whole, or cut where `argument_digits` are given."""
    value, _ = value_and_mark(cell)
    if kind in _SHORT:
        return _SHORT[kind](value)
    if value is None:
        return "-"
    if kind == "arguments":
        if argument_digits is None:
            return ", ".join(value)
        return numbers.short_arguments(value, argument_digits)
    if kind == "command" and argument_digits is not None:
        return value if len(value) <= COMMAND_LENGTH else value[:COMMAND_LENGTH] + "..."
    return str(value)
