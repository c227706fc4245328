"""The report of a run's standing: what stands above everything else on the page."""
from ulpgate_report.page import page_views
from ulpgate_report.standing import standing as standings, tables

# What is tabled, and in which formats; a table has the name of its function.
TABLES = (
    (tables.gate_findings, ("md", "csv")),
    (tables.changed_rows, ("md", "csv")),
)
FIGURES = ()
FAMILIES = ()


def of(run):
    """The standing, None of a run that budgets say nothing of."""
    if run.gate is None and run.before is None:
        return None
    return standings.of(run)


def printed(standing):
    """Tables for the terminal."""
    made = [make(standing) for make, _ in TABLES]
    return [table for table in made if table.rows]


def _failed(standing):
    """What the gate holds against the run; rows that were not judged are no failures of the code."""
    failures = standing.failures
    by_kind = {}
    for one in failures:
        by_kind[one["kind"]] = by_kind.get(one["kind"], 0) + 1
    counts = ", ".join(f"{kind.lower()} {count:,}" for kind, count in by_kind.items())
    first = failures[0]
    shown = f"{first['function']} {first['type']}: {first['message']}"
    many = "s" * (len(failures) > 1)
    if standing.wrong:
        text = f"FAILED: {len(failures):,} finding{many} ({counts})."
        return [(text, True), (f"The worst: {shown}", False)]
    text = f"NOT PASSED: nothing that was judged failed, and {len(failures):,} row{many} could not be judged ({counts})."
    return [(text, True), (f"The first: {shown}", False)]


def _verdict(standing):
    if standing.gate is None:
        return [("Not held to budgets.", False)]
    wrong = standing.wrong_kind
    known = f" {wrong:,} results of the wrong kind are known of the libraries: the budgets have them."
    failures = standing.failures
    if not failures and not standing.complete:
        text = "NOT PASSED: the run is incomplete, and what is missing was not judged."
        return [(text, True)]
    if not failures and standing.gate.exit_code != 0:
        why = "; ".join(standing.gate.remarks) or standing.gate.verdict
        return [
            ("NOT PASSED: nothing failed, and there is no verdict.", True),
            (why, False),
        ]
    if not failures:
        text = f"PASSED: all {standing.rows:,} rows are within their budgets."
        return [(text + known * bool(wrong), False)]
    return _failed(standing)


def _since(standing):
    if standing.changes is None:
        return []
    when = standing.before.get("seed")
    counts = [
        f"{len(found):,} {change}"
        for change in (
            standings.WORSE,
            standings.GONE,
            standings.NEW,
            standings.BETTER,
        )
        if (found := standing.of_change(change))
    ]
    said = ", ".join(counts) if counts else "no row"
    worse = bool(standing.of_change(standings.WORSE))
    about = f"of {standing.rows:,} rows (seed {when})" if when is not None else ""
    return [("Changed since the earlier run:", False), (said, worse), (about, False)]


def headline(standing):
    """Passed or not, and what changed."""
    return _verdict(standing) + _since(standing)


def sections(standing, _):
    """The section of the page."""
    view = page_views.table_view
    blocks = []
    if standing.failures:
        blocks.append(page_views.table(view(tables.gate_findings(standing))))
    if standing.changes:
        blocks.append(page_views.table(view(tables.changed_rows(standing))))
    return [page_views.section("standing", "Standing", *blocks)] if blocks else []
