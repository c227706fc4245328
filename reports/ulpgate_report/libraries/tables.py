"""What is tabled of several libraries: maximum errors and times, function by library."""
from ulpgate_report.tables.table import Column, Marked, Table


def _columns(beside, kind):
    return tuple(Column(label, label, kind) for label in beside.labels)


def library_ulp(beside):
    """Maximum ULP error, function and type by library."""
    rows = []
    for token in beside.type_tokens:
        for row in beside.rows_of(token):
            cells = [run.cells.get((row, token)) for run in beside.runs]
            shown = [cell and Marked(cell.max_ulp, cell.mismatches) for cell in cells]
            rows.append((row.label, token, *shown))
    columns = (Column("function", "function", "code"), Column("type", "type", "code"))
    caption = (
        "Maximum error in ULP of the functions of several libraries against the unrounded reference, all strata that were run. "
        "!n: n samples of the wrong kind, crashes and their like among them."
    )
    return Table(
        "library_ulp", caption, (*columns, *_columns(beside, "ulp")), tuple(rows)
    )


def library_time(beside):
    """Time of a call, function and type by library."""
    rows = []
    for token in beside.type_tokens:
        for function in dict.fromkeys(row.function for row in beside.rows_of(token)):
            times = [run.time_ns.get((function, token)) for run in beside.runs]
            if any(time is not None for time in times):
                rows.append((function, token, *times))
    columns = (Column("function", "function", "code"), Column("type", "type", "code"))
    caption = (
        "Time of one evaluation in nanoseconds, the least of several repeats over batches of uniform arguments; of a vector function its time "
        "divided by its lanes. Functions of a library run in a process of their own."
    )
    return Table(
        "library_time", caption, (*columns, *_columns(beside, "rough")), tuple(rows)
    )


def library_findings(beside):
    """Where each library errs most: the arguments."""
    rows = []
    for label, run in zip(beside.labels, beside.runs):
        for token in run.type_tokens:
            for row in run.rows:
                cell = run.cells.get((row, token))
                if cell is not None:
                    rows.append(
                        (
                            row.label,
                            token,
                            label,
                            cell.max_ulp,
                            cell.stratum,
                            cell.argmax if cell.max_ulp else None,
                            cell.mismatches,
                        )
                    )
    rows.sort(key=lambda line: (beside.type_tokens.index(line[1]), line[0]))
    columns = (
        Column("function", "function", "code"),
        Column("type", "type", "code"),
        Column("library", "library", "text"),
        Column("max_ulp", "max ULP", "ulp"),
        Column("stratum", "stratum", "text"),
        Column("argument", "argument", "arguments"),
        Column("mismatches", "wrong kind", "count"),
    )
    caption = "Where each library errs most: maximum error in ULP with its argument, where there is an error at all."
    return Table("library_findings", caption, columns, tuple(rows))
