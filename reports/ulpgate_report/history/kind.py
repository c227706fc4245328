"""The report of a history: its tables, its figure, its section of the page and what goes to the terminal."""
from ulpgate_report.history import figure_trends, tables
from ulpgate_report.page import page_views

# What is tabled, and in which formats; a table has the name of its function.
TABLES = (
    (tables.history_steps, ("md", "csv")),
    (tables.history_runs, ("md", "csv")),
)
FIGURES = (figure_trends.draw,)
FAMILIES = (figure_trends.FAMILY,)


def of(run):
    """The history, None where none was asked for."""
    return run.history


def printed(history):
    """Tables for the terminal."""
    table = tables.history_steps(history)
    return [table] if table.rows else []


def headline(history):
    """What stands above everything."""
    worse = sum(step.change == "worse" for step in history.steps)
    words = f"History of {len(history.runs):,} runs: {len(history.steps):,} steps, "
    return [
        (words, False),
        (f"{worse:,} for the worse" if worse else "none for the worse", bool(worse)),
        (".", False),
    ]


def sections(history, drawn):
    """The section of the page."""
    return [
        page_views.section(
            "history",
            "History",
            *page_views.figures(
                drawn, figure_trends.FAMILY, "Trends", "No row stepped."
            ),
            page_views.table(
                page_views.table_view(tables.history_steps(history)), "No row stepped."
            ),
            page_views.details(
                page_views.table_view(tables.history_runs(history)), "runs"
            ),
        )
    ]
