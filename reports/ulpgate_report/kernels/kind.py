"""The report of the DEM kernels: its tables, figures, sections of the page and what goes to the terminal."""
from ulpgate_report.figures import heat_colours
from ulpgate_report.kernels import combine, figure_condition, figure_heatmap, tables
from ulpgate_report.page import page_views
from ulpgate_report.values import numbers

# What is tabled, and in which formats; a table has the name of its function.
TABLES = (
    (tables.kernel_stability, ("tex", "md", "csv")),
    (tables.kernel_ulp, ("tex", "md", "csv")),
    (tables.kernel_errors, ("tex", "md", "csv")),
    (tables.kernel_unstable, ("tex", "md", "csv")),
    (tables.kernel_mismatches, ("tex", "md", "csv")),
    (tables.kernel_records, ("md", "csv")),
)
FIGURES = (
    figure_heatmap.draw_types,
    figure_heatmap.draw_strata,
    figure_condition.draw,
)
FAMILIES = ("kernel",)


def of(run):
    """The combined kernels, None where no kernel was run."""
    return combine.combine_run(run) if run.kernels else None


def printed(combined):
    """Tables for the terminal."""
    found = [
        tables.kernel_stability(combined),
        tables.kernel_ulp(combined),
    ]
    for make in (tables.kernel_unstable, tables.kernel_mismatches):
        table = make(combined)
        if table.rows:
            found.append(table)
    return found


def headline(combined):
    """What stands above everything."""
    unstable = len(tables.kernel_unstable(combined).rows)
    mismatches = sum(cell.mismatches for cell in combined.cells.values())
    kernels = len({row.function for row in combined.rows})
    return [
        (f"{kernels} kernels, {len(combined.rows)} quantities,", False),
        (f"{len(combined.records):,} records:", False),
        (f"{unstable:,} unstable" if unstable else "none unstable", bool(unstable)),
        ("beyond their condition,", False),
        (f"{mismatches:,}" if mismatches else "no", bool(mismatches)),
        ("results of the wrong kind.", False),
    ]


def _hover(row, token, cell):
    short = numbers.short_ulp
    return "\n".join(
        [
            f"{row.label}, {token}: {cell.reading}",
            f"error / (condition u) {short(cell.max_normwise_over_condition)} ({cell.over_condition_stratum})",
            f"normwise {short(cell.max_normwise)} u at condition {short(cell.condition)} ({cell.normwise_stratum})",
            f"componentwise {short(cell.max_ulp)} ULP ({cell.ulp_stratum})",
        ]
    )


def _heat_view(combined):
    """The matrix of errors over condition with colours and hover text."""
    return page_views.heat_view(
        tables.kernel_stability(combined),
        page_views.cells_of(combined),
        lambda cell: cell[2].max_normwise_over_condition,
        lambda cell: _hover(*cell),
        heat_colours.ROUNDINGS,
    )


def sections(combined, drawn):
    """The sections of the page."""

    def table(make):
        return page_views.table(page_views.table_view(make(combined)))

    def figures(name, title):
        return page_views.figures(drawn, name, title, "There is nothing to draw.")

    records = page_views.table_view(tables.kernel_records(combined))
    return [
        page_views.section(
            "kernel-stability",
            "Kernels: error beyond the condition",
            page_views.table(_heat_view(combined)),
        ),
        page_views.section(
            "kernel-unstable", "Unstable", table(tables.kernel_unstable)
        ),
        page_views.section(
            "kernel-condition",
            "Bits lost and bits at risk",
            *figures("kernel_condition", "Bits lost and bits at risk"),
        ),
        page_views.section(
            "kernel-strata",
            "By stratum",
            *figures("kernel_strata", "Error beyond the condition by stratum"),
        ),
        page_views.section(
            "kernel-ulp", "Componentwise error", table(tables.kernel_ulp)
        ),
        page_views.section(
            "kernel-errors", "Error and condition", table(tables.kernel_errors)
        ),
        page_views.section(
            "kernel-mismatches",
            "Kernels: mismatches",
            table(tables.kernel_mismatches),
        ),
        page_views.section(
            "kernel-all",
            "Kernels: all records",
            page_views.details(records, "records"),
        ),
    ]
