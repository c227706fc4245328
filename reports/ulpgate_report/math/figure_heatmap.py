"""The heat map: maximum ULP error, function by type, with the number in the cell and mismatches marked."""
from ulpgate_report.figures import figure_style, heat_colours, heat_grid

NAME = "heatmap"


def _caption(combined):
    strata = ", ".join(combined.strata)
    return (
        "Maximum error in ULP (printed) of each function and type over the strata "
        f"{strata}; the colour is its decimal logarithm, from 0.5 ULP (correct rounding) to 1e6 ULP, "
        "the same colour below and above. 0: every sample exact. inf, hatched: more ULP than a double can tell. "
        "-: nothing was judged. Triangle: samples of the wrong kind "
        "(NaN, infinity, sign of zero, overflow, underflow) occurred."
    )


def _ticks():
    powers = {float(n): figure_style.power_of_ten(n) for n in range(2, 7)}
    return {heat_colours.ULP.lowest_log10: "0.5", 1.0: "10", **powers}


def draw(combined):
    """(name, caption, figure)."""

    def cell_of(row, token):
        cell = combined.cells.get((row, token))
        return cell and (cell.max_ulp, cell.mismatches > 0)

    grid = heat_grid.Grid(
        rows=combined.rows,
        columns=combined.type_tokens,
        cell_of=cell_of,
        function_of=lambda row: row.function,
        group_of=lambda row: row.function_class,
        scale=heat_colours.ULP,
        ticks=_ticks(),
        bar_label="maximum error (ULP), log scale",
        mark_text="wrong kind of result occurred",
    )
    return NAME, _caption(combined), heat_grid.draw(grid)
