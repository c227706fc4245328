"""The short text of one table cell, shared by the formats that people read."""
from ulpgate_report import numbers
from ulpgate_report.tables import Marked

_SHORT = {"ulp": numbers.short_ulp, "distance": numbers.short_distance}
NUMERIC_KINDS = ("count", "ulp", "distance")


def value_and_mark(cell):
    """The bare value of a cell and its mismatches."""
    if isinstance(cell, Marked):
        return cell.value, cell.mismatches
    return cell, 0


def short(cell, kind, argument_digits=None):
    """The cell without its mark; arguments whole, or cut to `argument_digits`."""
    value, _ = value_and_mark(cell)
    if kind in _SHORT:
        return _SHORT[kind](value)
    if value is None:
        return "-"
    if kind == "arguments":
        if argument_digits is None:
            return ", ".join(value)
        return numbers.short_arguments(value, argument_digits)
    return str(value)
