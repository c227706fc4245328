"""The report of the math functions: its tables, figures, sections of the page and what goes to the terminal."""
from ulpgate_report.figures import figure_style, heat_colours
from ulpgate_report.math import (
    combine,
    figure_distributions,
    figure_error_vs_time,
    figure_heatmap,
    reproducer,
    tables,
)
from ulpgate_report.page import page_views
from ulpgate_report.values import numbers

# What is tabled, and in which formats; a table has the name of its function.
TABLES = (
    (tables.type_table, ("tex", "md", "csv")),
    (tables.worst_table, ("md", "csv")),
    (tables.paper_table, ("tex", "md", "csv")),
    (tables.ulp_matrix, ("tex", "md", "csv")),
    (tables.ulp_table, ("tex", "md", "csv")),
    (tables.long_table, ("md", "csv")),
    (tables.mismatch_table, ("md", "csv")),
)
# What is drawn: each gives (name, caption, figure or None where there is nothing to draw).
FIGURES = (
    figure_heatmap.draw,
    figure_error_vs_time.draw,
    figure_distributions.draw_real,
    figure_distributions.draw_complex,
    figure_distributions.draw_special,
)
# Beginnings of the names of all figures that FIGURES may ever write.
FAMILIES = ("heatmap", "error_vs_time", "distributions")


def of(run):
    """The combined run, None where no function was run."""
    return combine.combine_run(run) if run.math else None


def printed(combined):
    """Tables for the terminal."""
    return [tables.ulp_matrix(combined)]


# Of what the two references differ in, so many functions are named.
_NAMED = 3


def _oracles(combined):
    """The second reference beside the exact value: where the wider type itself is wrong."""
    compared = sum(cell.oracle_compared for cell in combined.cells.values())
    of_function = {}
    for (row, _), cell in combined.cells.items():
        if cell.oracle_disagreed:
            of_function.setdefault(row.function, []).append(cell.oracle_disagreed)
    if not of_function:
        return f" RealHP<4> agrees with the exact value on all {compared:,} results that were compared."
    counts = sorted(((sum(n), name) for name, n in of_function.items()), reverse=True)
    named = ", ".join(f"{name} {count:,}" for count, name in counts[:_NAMED])
    more = f" and {len(counts) - _NAMED} more functions" * (len(counts) > _NAMED)
    total = sum(count for count, _ in counts)
    return (
        f" RealHP<4>, the same code in four times the digits, was compared with the exact value on {compared:,} results and is "
        f"itself wrong on {total:,}: {named}{more}."
    )


def _largest(judged):
    """The largest error that a number tells, after the count of those that none does."""
    finite = [one for one in judged if one[1].max_ulp != numbers.INFINITE]
    said = ""
    if len(finite) < len(judged):
        said = f"{len(judged) - len(finite):,} err by more ULP than a double can tell; "
    if not finite:
        return said.removesuffix("; ") + "."
    (row, token), cell = max(finite, key=lambda one: one[1].max_ulp)
    among = "of the others " if said else ""
    return f"{said}the largest error {among}is {numbers.short_ulp(cell.max_ulp)} ULP, of {row.label} in {token}."


def headline(combined):
    """What stands above everything."""
    cells = combined.cells.values()
    judged = [c for c in combined.cells.items() if c[1].max_ulp is not None]
    types = len(combined.type_tokens)
    said = (
        f"{len({row.function for row in combined.rows}):,} functions in {types} type{'s' * (types != 1)}, "
        f"{sum(cell.samples for cell in cells):,} samples."
    )
    if judged:
        # A result of the wrong kind is none that is rounded correctly, and has no part in the largest error.
        sound = [cell.max_ulp for _, cell in judged if not cell.mismatches]
        correct = sum(error <= 0.5 for error in sound)
        faithful = sum(error <= 1 for error in sound)
        said += (
            f" Of {len(judged):,} rows {correct:,} are rounded correctly at every sample and {faithful:,} err by at most 1 ULP; "
            + _largest(judged)
        )
    return [(said + _oracles(combined), False)]


def _hover(row, token, cell):
    lines = [f"{row.label}, {token}: {numbers.short_ulp(cell.max_ulp)} ULP"]
    if cell.argmax:
        lines.append(f"at {', '.join(cell.argmax)} ({cell.stratum})")
    lines.append(
        f"p99 {numbers.short_ulp(cell.p99_ulp)}, mean {numbers.short_ulp(cell.mean_ulp)}, "
        f"{cell.correctly_rounded} of {cell.judged} correctly rounded"
    )
    lines += [f"{name}: {count}" for name, count in cell.mismatch.items()]
    return "\n".join(lines)


def _heat_view(combined):
    """The matrix of maximum errors with colours and hover text."""
    return page_views.heat_view(
        tables.ulp_matrix(combined),
        page_views.cells_of(combined),
        lambda cell: cell[2].max_ulp,
        lambda cell: _hover(*cell),
        heat_colours.ULP,
        command=lambda cell: reproducer.command_of(
            combined.context, cell[0].function, cell[1], cell[2].argmax
        )
        if cell[2].argmax
        else None,
        row=lambda cell: cell[0].label,
    )


def distributions(combined):
    """What the page draws: per row and type the judged and exact counts and the buckets, types by index."""
    found = {}
    for row in combined.rows:
        curves = {}
        for index, token in enumerate(combined.type_tokens):
            cell = combined.cells.get((row, token))
            if cell is not None and cell.judged:
                curves[index] = [cell.judged, cell.exact_count, list(cell.buckets)]
        if curves:
            found[row.label] = curves
    types = [
        {"token": token, "colour": figure_style.colour(index)}
        for index, token in enumerate(combined.type_tokens)
    ]
    return {"types": types, "curves": found}


def sections(combined, drawn):
    """The sections of the page."""
    untimed = "Nothing was timed."
    if combined.time_ns:
        untimed = "No function was both timed and measured on the strata uniform and stratified."
    view = page_views.table_view
    return [
        page_views.section(
            "glance",
            "At a glance",
            page_views.table(view(tables.type_table(combined))),
            page_views.table(view(tables.worst_table(combined))),
        ),
        page_views.section(
            "heat", "Maximum error", page_views.table(_heat_view(combined))
        ),
        page_views.section(
            "time",
            "Error against time",
            *page_views.figures(drawn, "error_vs_time", "Error against time", untimed),
        ),
        page_views.section(
            "distribution", "Distribution of the error", {"kind": "distribution"}
        ),
        page_views.section(
            "paper",
            "The paper's table",
            page_views.table(view(tables.paper_table(combined))),
        ),
        page_views.section(
            "ulp",
            "Where it happens",
            page_views.table(view(tables.ulp_table(combined))),
        ),
        page_views.section(
            "mismatches",
            "Mismatches",
            page_views.table(view(tables.mismatch_table(combined))),
        ),
        page_views.section(
            "all",
            "All records",
            page_views.details(view(tables.long_table(combined)), "records"),
        ),
    ]
