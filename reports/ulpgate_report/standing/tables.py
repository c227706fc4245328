"""The tables of a standing: what the gate found, and what changed."""
from ulpgate_report.tables.table import Column, Table, columns_of
from ulpgate_report.values import numbers


def gate_findings(standing):
    """What the gate holds against the run, in its order: the worst first."""
    rows = [
        (
            one["function"],
            one["type"],
            one["kind"],
            one.get("stratum") or None,
            one.get("what") or None,
            numbers.measured(one.get("measured")),
            numbers.measured(one.get("budget")),
            one.get("reproduce") or None,
        )
        for one in standing.failures
    ]
    columns = (
        *columns_of("code", function="function", type="type"),
        Column("kind", "kind", "text"),
        Column("stratum", "stratum", "text"),
        Column("what", "what", "text"),
        *columns_of("real", measured="measured", budget="budget"),
        Column("command", "shown by", "command"),
    )
    caption = "Rows that are not within their budgets, or could not be judged, the worst first."
    return Table("gate_findings", caption, columns, tuple(rows))


def changed_rows(standing):
    """Rows that are others than in the earlier run."""
    rows = [
        (
            one.label,
            one.type,
            one.change,
            one.before,
            one.after,
            one.wrong_before,
            one.wrong_after,
            one.command,
        )
        for one in standing.changes or ()
    ]
    columns = (
        *columns_of("code", function="function", type="type"),
        Column("change", "change", "text"),
        *columns_of("ulp", before_ulp="before (ULP)", after_ulp="now (ULP)"),
        *columns_of("count", wrong_before="wrong kind before", wrong_after="now"),
        Column("command", "shown by", "command"),
    )
    caption = (
        "Rows whose largest error, or number of results of the wrong kind, is another than in the earlier run; "
        "worse ones first, then those that are gone, new ones and better ones."
    )
    return Table("changed_rows", caption, columns, tuple(rows))
