"""What is tabled of the math functions: columns and rows, without any format."""
from ulpgate_report.math import reproducer
from ulpgate_report.math.combine import PAPER_STRATA
from ulpgate_report.tables.table import Column, Marked, Table, columns_of
from ulpgate_report.values import numbers, outcomes
from ulpgate_report.values.row import Row


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


def _told(caption, errors):
    """A caption that says what inf is, where an error is it."""
    is_met = numbers.INFINITE in errors
    said = " inf: more ULP than a double can tell, in no order." if is_met else ""
    return caption + said


_WRONG_KIND = "!n: n samples of the wrong kind (NaN, infinity, sign of zero, overflow, underflow)."


def paper_table(combined):
    """The published table: maximum integer distance over its two sets of arguments."""
    strata = " and ".join(PAPER_STRATA)
    return _matrix(
        combined,
        "paper_table",
        f"Maximum error as an integer distance (float_distance) to the rounded reference, strata {strata} only. "
        + _WRONG_KIND,
        "distance",
        combined.paper_cells,
        lambda cell: cell.max_float_distance,
    )


def _limits(errors):
    """How many of these largest errors lie within 0.5, 1 and 4 ULP each, and how many beyond."""
    return tuple(
        sum(low < error <= high for error in errors)
        for low, high in ((-1, 0.5), (0.5, 1), (1, 4), (4, numbers.INFINITE))
    )


def _causes(cells):
    """Kinds of wrong results with their counts, the most frequent first."""
    counts = {}
    for cell in cells:
        for name, count in cell.mismatch.items():
            counts[name] = counts.get(name, 0) + count
    return sorted(
        ((n, c) for n, c in counts.items() if c), key=lambda nc: (-nc[1], nc[0])
    )


def type_table(combined):
    """What each type comes to: its rows by the size of their largest error, the worst of them, what is of the wrong kind."""
    lines = []
    for token in combined.type_tokens:
        found = [
            (row, combined.cells[row, token])
            for row in combined.rows
            if (row, token) in combined.cells
        ]
        judged = [(row, cell) for row, cell in found if cell.max_ulp is not None]
        worst = max(judged, key=lambda rc: rc[1].max_ulp, default=(None, None))
        causes = _causes(cell for _, cell in found)
        lines.append(
            (
                token,
                len(found),
                *_limits([cell.max_ulp for _, cell in judged]),
                worst[1] and worst[1].max_ulp,
                worst[0] and worst[0].label,
                sum(count for _, count in causes),
                sum(1 for _, cell in found if cell.mismatches),
                ", ".join(f"{name} {count:,}" for name, count in causes) or None,
            )
        )
    columns = (
        Column("type", "type", "code"),
        *columns_of("count", rows="rows", to_half="to 0.5 ULP", to_one="to 1"),
        *columns_of("count", to_four="to 4", beyond="beyond"),
        Column("max_ulp", "max ULP", "ulp"),
        Column("where", "of", "code"),
        *columns_of("count", wrong_kind="wrong kind", in_rows="in rows"),
        Column("causes", "which", "prose"),
    )
    caption = (
        "Rows (functions, or parts of them) of each type by their largest error, the worst of them, and results that no number of ULP describes: "
        "how many, in how many rows, and of which kinds."
    )
    caption += outcomes.explained(n for n, _ in _causes(combined.cells.values()))
    caption = _told(caption, [cell.max_ulp for cell in combined.cells.values()])
    return Table("type_table", caption, columns, tuple(lines))


def worst_table(combined, most=8):
    """The functions with the largest errors, each in the type where its own is largest; of several infinite ones all are counted."""
    judged = [
        (row, token, cell)
        for (row, token), cell in combined.cells.items()
        if cell.max_ulp is not None
    ]
    # Ties keep the order of functions and types.
    judged.sort(key=lambda one: -one[2].max_ulp)
    worst = {}
    for one in judged:
        worst.setdefault(one[0], one)
    infinite = sum(cell.max_ulp == numbers.INFINITE for _, _, cell in judged)
    rows = [
        (
            row.label,
            token,
            cell.max_ulp,
            cell.stratum,
            reproducer.command_of(combined.context, row.function, token, cell.argmax),
        )
        for row, token, cell in list(worst.values())[:most]
    ]
    columns = (
        *columns_of("code", function="function", type="type"),
        Column("max_ulp", "max ULP", "ulp"),
        Column("stratum", "stratum", "text"),
        Column("command", "shown by", "command"),
    )
    caption = (
        "The largest errors of all, each function in the type where its own is largest."
    )
    caption = _told(caption, [row[2] for row in rows])
    if infinite:
        caption += (
            f" So large are {infinite} rows: a function, or a part of it, in a type."
        )
    return Table("worst_table", caption, columns, tuple(rows))


def ulp_matrix(combined):
    """Maximum ULP error, function by type."""
    caption = "Maximum error in ULP against the unrounded reference, all strata. "
    errors = [cell.max_ulp for cell in combined.cells.values()]
    return _matrix(
        combined,
        "ulp_matrix",
        _told(caption + _WRONG_KIND, errors),
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
        *columns_of("code", function="function", type="type"),
        *columns_of("ulp", max_ulp="max ULP", p99_ulp="p99 ULP"),
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
    ("implementation", "implementation", "text"),
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
    caption += outcomes.explained(sorted({row[4] for row in rows}))
    return Table("mismatch_table", caption, columns, tuple(rows))
