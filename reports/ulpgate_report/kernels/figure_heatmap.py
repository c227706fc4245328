"""Two heat maps of the kernels: roundings lost beyond the condition, quantity by type and quantity by stratum."""
from ulpgate_report.figures import heat_colours, heat_grid
from ulpgate_report.kernels.combine import STABILITY_LIMIT, UNSTABLE

_LABEL_INCHES = 2.45
_TICKS = {
    heat_colours.ROUNDINGS.lowest_log10: "0.5",
    0.0: "1",
    1.0: "10",
    2.0: "100",
}
_CAPTION = (
    "Largest normwise error / (condition number times unit roundoff 2^-p) of each quantity and %s, printed; the colour is "
    "its decimal logarithm. 0: no result was off by more than half a ULP. inf, hatched: an infinite quotient. "
    f"-: nothing was judged. Triangle: unstable, above {STABILITY_LIMIT}."
)


def _draw(combined, name, columns, cells, what):
    def cell_of(row, column):
        cell = cells.get((row, column))
        return cell and (
            cell.max_normwise_over_condition,
            cell.verdict == UNSTABLE,
        )

    grid = heat_grid.Grid(
        rows=combined.rows,
        columns=tuple(columns),
        cell_of=cell_of,
        function_of=lambda row: row.function,
        group_of=lambda row: row.function,
        scale=heat_colours.ROUNDINGS,
        ticks=_TICKS,
        bar_label="error / (condition u), log scale",
        mark_text="unstable",
        label_inches=_LABEL_INCHES,
    )
    return name, _CAPTION % what, heat_grid.draw(grid)


def draw_types(combined):
    """(name, caption, figure): all strata together, by type."""
    return _draw(
        combined,
        "kernel_heatmap",
        combined.type_tokens,
        combined.cells,
        "type over all strata",
    )


def draw_strata(combined):
    """(name, caption, figure): all types together, by stratum."""
    return _draw(
        combined,
        "kernel_strata",
        combined.strata,
        combined.stratum_cells,
        "stratum over all types",
    )
