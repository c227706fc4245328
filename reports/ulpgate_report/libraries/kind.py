"""The report of several libraries: its tables, its figure, its section of the page and what goes to the terminal."""
from ulpgate_report.libraries import figure_libraries, tables
from ulpgate_report.page import page_views

# What is tabled, and in which formats; a table has the name of its function.
TABLES = (
    (tables.library_ulp, ("tex", "md", "csv")),
    (tables.library_time, ("tex", "md", "csv")),
    (tables.library_findings, ("md", "csv")),
)
FIGURES = (figure_libraries.draw,)
FAMILIES = (figure_libraries.NAME,)


def of(run):
    """The libraries, None where one run alone is reported."""
    return run.libraries


def printed(beside):
    """Tables for the terminal."""
    times = tables.library_time(beside)
    return [tables.library_ulp(beside), *([times] if times.rows else [])]


def headline(beside):
    """What stands above everything."""
    return [(f"{len(beside.labels)} libraries: {', '.join(beside.labels)}.", False)]


def sections(beside, drawn):
    """The section of the page."""
    view = page_views.table_view
    return [
        page_views.section(
            "libraries",
            "Libraries side by side",
            page_views.table(view(tables.library_ulp(beside))),
            *page_views.figures(
                drawn, figure_libraries.NAME, "Error against time", "Nothing was timed."
            ),
            page_views.table(view(tables.library_time(beside)), "Nothing was timed."),
            page_views.details(view(tables.library_findings(beside)), "rows"),
        )
    ]
