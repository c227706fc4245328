"""A table as plain data: columns, rows and what may stand beside a value, without any format."""
from dataclasses import dataclass


@dataclass(frozen=True)
class Column:
    """A column; `kind` is one of text, code, count, ulp, distance, real, rough (a time and the like), arguments, command, prose."""

    name: str
    title: str
    kind: str


def columns_of(kind, **titles):
    """Columns of one kind, in their order: `columns_of("real", error="largest error", seconds="time (s)")`."""
    return tuple(Column(name, title, kind) for name, title in titles.items())


@dataclass(frozen=True)
class Marked:
    """A measured value with the number of mismatches beside it."""

    value: object
    mismatches: int

    # What the second column of such a cell is called in CSV.
    mark_name = "mismatches"

    @property
    def mark(self):
        """What stands beside the value."""
        return f"!{self.mismatches}" if self.mismatches else ""

    @property
    def mark_value(self):
        """The mark for programs."""
        return str(self.mismatches)


@dataclass(frozen=True)
class Judged:
    """A measured value with a verdict beside it, which is shown where it is not `good`."""

    value: object
    verdict: str
    good: str = "stable"

    mark_name = "verdict"

    @property
    def mark(self):
        """What stands beside the value."""
        return "" if self.verdict == self.good else self.verdict

    @property
    def mark_value(self):
        """The verdict for programs."""
        return self.verdict


@dataclass(frozen=True)
class Table:
    """A table; a cell is None where nothing was measured."""

    name: str
    caption: str
    columns: tuple
    rows: tuple
