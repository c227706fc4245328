"""The tables as plain data: columns and rows, without any format."""
from dataclasses import dataclass

from ulpgate_report.math.combine import PAPER_STRATA, Row
from ulpgate_report.records import numbers


@dataclass(frozen=True)
class Column:
    """A column; `kind` is one of text, code, count, ulp, distance, real, arguments, command, prose."""

    name: str
    title: str
    kind: str


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


def _matrix(combined, name, caption, kind, cells, value_of):
    """Rows by types; `value_of` takes a cell to its number."""
    columns = [Column("function", "function", "code")]
    columns += [Column(token, token, kind) for token in combined.type_tokens]
    rows = []
    for row in combined.rows:
        line = [row.label]
        for token in combined.type_tokens:
            cell = cells.get((row, token))
            line.append(cell and Marked(value_of(cell), cell.mismatches))
        rows.append(tuple(line))
    return Table(name, caption, tuple(columns), tuple(rows))


def paper_table(combined):
    """The published table: maximum integer distance over its two sets of arguments."""
    strata = " and ".join(PAPER_STRATA)
    return _matrix(
        combined,
        "paper_table",
        f"Maximum error as an integer distance (float_distance) to the rounded reference, strata {strata} only. "
        "!n: n samples of the wrong kind (NaN, infinity, sign of zero, overflow, underflow).",
        "distance",
        combined.paper_cells,
        lambda cell: cell.max_float_distance,
    )


def ulp_matrix(combined):
    """Maximum ULP error, function by type."""
    return _matrix(
        combined,
        "ulp_matrix",
        "Maximum error in ULP against the unrounded reference, all strata. "
        "!n: n samples of the wrong kind (NaN, infinity, sign of zero, overflow, underflow).",
        "ulp",
        combined.cells,
        lambda cell: cell.max_ulp,
    )


def ulp_table(combined):
    """Maximum ULP error of each function and type and where it happens."""
    rows = []
    for row in combined.rows:
        for token in combined.type_tokens:
            cell = combined.cells.get((row, token))
            if cell is not None:
                rows.append(
                    (
                        row.label,
                        token,
                        cell.max_ulp,
                        cell.p99_ulp,
                        cell.stratum,
                        cell.argmax,
                        cell.mismatches,
                    )
                )
    columns = (
        Column("function", "function", "code"),
        Column("type", "type", "code"),
        Column("max_ulp", "max ULP", "ulp"),
        Column("p99_ulp", "p99 ULP", "ulp"),
        Column("stratum", "stratum", "text"),
        Column("argument", "argument", "arguments"),
        Column("mismatches", "mismatches", "count"),
    )
    caption = (
        "Maximum error in ULP against the unrounded reference over all strata, an upper bound of its 99th percentile, "
        "where the maximum happens, and the number of samples of the wrong kind."
    )
    return Table("ulp_table", caption, columns, tuple(rows))


# Name, title and kind of the long table's columns that a record holds as they are.
_LONG_FIELDS = (
    ("type", "type", "code"),
    ("stratum", "stratum", "text"),
    ("samples", "samples", "count"),
    ("judged", "judged", "count"),
    ("max_ulp", "max ULP", "ulp"),
    ("p99_ulp", "p99 ULP", "ulp"),
    ("p50_ulp", "p50 ULP", "ulp"),
    ("mean_ulp", "mean ULP", "ulp"),
    ("correctly_rounded", "correctly rounded", "count"),
    ("max_float_distance", "max float_distance", "distance"),
    ("max_ulp_over_condition", "max ULP / condition", "ulp"),
)


def long_table(combined):
    """Every record on a line of its own."""
    columns = [Column("function", "function", "code")]
    columns += [Column(*field) for field in _LONG_FIELDS]
    columns += [
        Column("mismatches", "mismatches", "count"),
        Column("argument", "argument", "arguments"),
    ]
    rows = []
    for record in combined.records:
        label = Row(record["function"], record["part"], record["class"]).label
        fields = [numbers.measured(record[name]) for name, _, _ in _LONG_FIELDS]
        mismatches = sum(record["mismatch"].values())
        rows.append((label, *fields, mismatches, tuple(record["argmax"])))
    return Table("long_table", "Every record.", tuple(columns), tuple(rows))


def mismatch_table(combined):
    """Samples whose outcome is of the wrong kind, a line for each class that occurred."""
    rows = []
    for record in combined.records:
        for name, count in sorted(record["mismatch"].items()):
            if count:
                first = record.get("mismatch_first", {}).get(name, ())
                rows.append(
                    (
                        record["function"],
                        record["part"],
                        record["type"],
                        record["stratum"],
                        name,
                        count,
                        tuple(first),
                    )
                )
    columns = (
        Column("function", "function", "code"),
        Column("part", "part", "text"),
        Column("type", "type", "code"),
        Column("stratum", "stratum", "text"),
        Column("class", "class", "code"),
        Column("count", "count", "count"),
        Column("first_argument", "first argument", "arguments"),
    )
    caption = "Samples whose outcome is of the wrong kind, with the first argument of each class."
    return Table("mismatch_table", caption, columns, tuple(rows))
