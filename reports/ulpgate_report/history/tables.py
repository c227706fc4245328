"""The tables of a history as plain data."""
import datetime

from ulpgate_report.tables.table import Column, Table

_HASH = 40


def short_commit(commit):
    """The first 12 characters of a hash, with what stands behind it; other words whole."""
    plain = commit[:_HASH]
    is_hash = len(plain) == _HASH and set(plain) <= set("0123456789abcdef")
    return plain[:12] + commit[_HASH:] if is_hash else commit


def date_of(run):
    """The day of a run."""
    when = datetime.datetime.fromtimestamp(run.time_s, datetime.timezone.utc)
    return when.strftime("%Y-%m-%d")


def history_steps(history):
    """Every step: row, commit, what changed; worse ones first within a run."""
    order = ("worse", "better", "another")
    found = sorted(
        history.steps,
        key=lambda s: (-s.run, order.index(s.change) if s.change in order else 3),
    )
    rows = []
    for step in found:
        series, run = history.series[step.series], history.runs[step.run]
        rows.append(
            (
                step.change,
                step.what,
                series.title,
                short_commit(run.commit),
                date_of(run),
                short_commit(history.runs[step.before].commit),
                step.text,
                step.platform or None,
            )
        )
    columns = (
        Column("change", "change", "text"),
        Column("what", "of", "text"),
        Column("row", "row", "prose"),
        Column("commit", "at commit", "code"),
        Column("date", "date", "text"),
        Column("before", "before it", "code"),
        Column("text", "figures", "prose"),
        Column("platform", "platform, with it", "prose"),
    )
    caption = (
        "Steps of the history, the latest first. Accuracy is deterministic, so any change is one; a step of speed is a change by "
        "5 % and by five standard errors between levels of at least three runs."
    )
    return Table("history_steps", caption, columns, tuple(rows))


def _differences(before, after):
    names = sorted({*before, *after})
    return "; ".join(
        f"{name} {before.get(name, 'none')} -> {after.get(name, 'none')}"
        for name in names
        if before.get(name) != after.get(name)
    )


def history_runs(history):
    """Every run: commit, date, number of rows, and what its platform has otherwise than the run before."""
    rows, before = [], None
    for run in history.runs:
        changed = before and _differences(before.platform, run.platform)
        rows.append(
            (
                short_commit(run.commit),
                date_of(run),
                run.verb,
                run.rows,
                changed or None,
            )
        )
        before = run
    columns = (
        Column("commit", "commit", "code"),
        Column("date", "date", "text"),
        Column("verb", "verb", "text"),
        Column("rows", "rows", "count"),
        Column("platform", "platform, unlike the run before", "prose"),
    )
    return Table("history_runs", "Runs of the history, by time.", columns, tuple(rows))
