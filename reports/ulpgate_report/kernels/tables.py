"""The tables of a run of kernels as plain data."""
from ulpgate_report.kernels.combine import STABILITY_LIMIT, UNSTABLE, row_of_record
from ulpgate_report.tables.table import Column, Judged, Marked, Table, columns_of
from ulpgate_report.values import numbers

_QUANTITY = Column("quantity", "kernel, quantity", "code")
_TYPE = Column("type", "type", "code")
_STRATUM = Column("stratum", "stratum", "text")


def reproducer(record, arguments):
    """The command that shows everything about one state."""
    return " ".join(["ulpgate at", record["function"], record["type"], *arguments])


def _matrix(combined, name, caption, cell_of):
    columns = [_QUANTITY]
    columns += [Column(token, token, "ulp") for token in combined.type_tokens]
    rows = []
    for row in combined.rows:
        cells = [combined.cells.get((row, token)) for token in combined.type_tokens]
        rows.append((row.label, *(cell and cell_of(cell) for cell in cells)))
    return Table(name, caption, tuple(columns), tuple(rows))


def kernel_stability(combined):
    """Error over condition and the verdict, quantity by type."""
    return _matrix(
        combined,
        "kernel_stability",
        "Largest normwise error divided by condition number and unit roundoff 2^-p, all strata: how many roundings "
        f"a quantity loses beyond what its state makes inevitable. Above {STABILITY_LIMIT} it is called unstable; "
        "0: no result was off by more than half a ULP.",
        lambda cell: Judged(cell.max_normwise_over_condition, cell.verdict),
    )


def kernel_ulp(combined):
    """Largest componentwise error in ULP, quantity by type."""
    return _matrix(
        combined,
        "kernel_ulp",
        "Largest error of a component in ULP of that component, all strata, whatever the condition of the state. "
        "!n: n samples of the wrong kind (NaN, infinity, sign of zero, overflow, underflow).",
        lambda cell: Marked(cell.max_ulp, cell.mismatches),
    )


def kernel_errors(combined):
    """Error, condition and what they say together, a line for each quantity and type."""
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
                        cell.ulp_stratum,
                        cell.max_normwise,
                        cell.condition,
                        cell.normwise_stratum,
                        cell.max_normwise_over_condition,
                        cell.reading,
                    )
                )
    columns = (
        _QUANTITY,
        _TYPE,
        Column("max_ulp", "max ULP", "ulp"),
        Column("ulp_stratum", "stratum", "text"),
        *columns_of("ulp", max_normwise="normwise (u)", condition="condition there"),
        Column("normwise_stratum", "stratum there", "text"),
        Column("max_normwise_over_condition", "error / (condition u)", "ulp"),
        Column("reading", "reading", "text"),
    )
    caption = (
        "Largest error of a component in ULP; largest error of the whole quantity in units of roundoff u = 2^-p, with "
        "condition number and stratum of that very state; largest quotient of the two over all states. "
        f"Ill-conditioned, not unstable: more than {STABILITY_LIMIT} roundings lost, but the state makes them "
        "inevitable. Small component of a vector: right as a vector, wrong in a component beside a larger one."
    )
    return Table("kernel_errors", caption, columns, tuple(rows))


def kernel_unstable(combined):
    """The records that the verdict calls unstable, with a state to look at."""
    rows = []
    for record in combined.records:
        if record["verdict"] == UNSTABLE:
            measured = ("max_normwise_over_condition", "max_normwise", "condition")
            rows.append(
                (
                    row_of_record(record).label,
                    record["type"],
                    record["stratum"],
                    *(numbers.measured(record[name]) for name in measured),
                    reproducer(record, record["normwise_argmax"]),
                )
            )
    columns = (
        _QUANTITY,
        _TYPE,
        _STRATUM,
        *columns_of(
            "ulp",
            max_normwise_over_condition="error / (condition u)",
            max_normwise="normwise (u)",
            condition="condition there",
        ),
        Column("reproducer", "reproducer", "command"),
    )
    caption = (
        f"Records that lose more than {STABILITY_LIMIT} roundings beyond their condition. "
        "Normwise error, condition and reproducer belong to the state of the largest normwise error."
    )
    return Table("kernel_unstable", caption, columns, tuple(rows))


def kernel_mismatches(combined):
    """Samples whose outcome is of the wrong kind, a line for each class that occurred."""
    rows = []
    for record in combined.records:
        for name, count in sorted(record["mismatch"].items()):
            if count:
                first = record.get("mismatch_first", {}).get(name)
                rows.append(
                    (
                        row_of_record(record).label,
                        record["type"],
                        record["stratum"],
                        name,
                        count,
                        reproducer(record, first) if first else None,
                    )
                )
    columns = (
        _QUANTITY,
        _TYPE,
        _STRATUM,
        Column("class", "class", "code"),
        Column("count", "count", "count"),
        Column("reproducer", "reproducer", "command"),
    )
    caption = "Samples whose outcome is of the wrong kind; a command shows the first state of its class."
    return Table("kernel_mismatches", caption, columns, tuple(rows))


_RECORD_FIELDS = (
    ("type", "type", "code"),
    ("stratum", "stratum", "text"),
    ("samples", "samples", "count"),
    ("judged", "judged", "count"),
    ("max_ulp", "max ULP", "ulp"),
    ("p99_ulp", "p99 ULP", "ulp"),
    ("p50_ulp", "p50 ULP", "ulp"),
    ("mean_ulp", "mean ULP", "ulp"),
    ("max_normwise", "normwise (u)", "ulp"),
    ("condition", "condition there", "ulp"),
    ("max_normwise_over_condition", "error / (condition u)", "ulp"),
    ("verdict", "verdict", "text"),
)


def kernel_records(combined):
    """Every record on a line of its own; their states stand in kernels.jsonl alone."""
    columns = [_QUANTITY, *(Column(*field) for field in _RECORD_FIELDS)]
    columns.append(Column("mismatches", "mismatches", "count"))
    rows = []
    for record in combined.records:
        fields = [numbers.measured(record[name]) for name, _, _ in _RECORD_FIELDS]
        mismatches = sum(record["mismatch"].values())
        rows.append((row_of_record(record).label, *fields, mismatches))
    return Table("kernel_records", "Every record.", tuple(columns), tuple(rows))
