"""Error distributions as small multiples, one figure a class of functions, all types overlaid."""
import math

from matplotlib import pyplot
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, MaxNLocator

from ulpgate_report.figures import figure_style
from ulpgate_report.math.combine import BUCKETS_PER_OCTAVE

COLUMNS = 6
PANEL_INCHES = (1.35, 1.05)
# Errors below 2^-6 ULP are drawn in the lowest bucket: nobody tells them apart.
LOWEST_LOG2_ULP = -6
# A single huge error would press all else into a line.
HIGHEST_LOG2_ULP = 40


def shares(cell):
    """[(upper edge in log2 ULP, share of the judged samples)], every bucket between the first and the last.

    What lies beyond the drawn range is counted in the bucket at its end.
    """
    found = {}
    for index, count in cell.buckets:
        edge = min(
            max(index, BUCKETS_PER_OCTAVE * LOWEST_LOG2_ULP),
            BUCKETS_PER_OCTAVE * HIGHEST_LOG2_ULP,
        )
        found[edge] = found.get(edge, 0) + count
    if not found or not cell.judged:
        return []
    return [
        (index / BUCKETS_PER_OCTAVE, found.get(index, 0) / cell.judged)
        for index in range(min(found), max(found) + 1)
    ]


def _draw_panel(axes, row, combined):
    width = 1 / BUCKETS_PER_OCTAVE
    highest, lowest_share = 2.0, 1e-3
    for index, token in enumerate(combined.type_tokens):
        cell = combined.cells.get((row, token))
        if cell is None or not cell.judged:
            continue
        colour = figure_style.colour(index)
        found = shares(cell)
        if found:
            edges = [found[0][0] - width, *(edge for edge, _ in found)]
            heights = [share or math.nan for _, share in found]
            axes.stairs(heights, edges, color=colour, linewidth=0.8, baseline=None)
            # Colours alone do not tell seven curves apart: a marker stands where the curve ends.
            axes.plot(
                [found[-1][0] - width / 2],
                [found[-1][1]],
                marker=figure_style.marker(index),
                color=colour,
                markersize=2.5,
                markeredgewidth=0,
            )
            highest = max(highest, found[-1][0])
            lowest_share = min([lowest_share, *(s for _, s in found if s)])
        if cell.exact_count:
            axes.plot(
                [LOWEST_LOG2_ULP - 1],
                [cell.exact_count / cell.judged],
                marker=figure_style.marker(index),
                color=colour,
                markersize=3,
                clip_on=False,
            )
    axes.set_yscale("log")
    axes.set_ylim(lowest_share / 2, 2)
    axes.yaxis.set_major_locator(LogLocator(numticks=5))
    axes.yaxis.set_major_formatter(lambda share, _: f"{math.log10(share):.0f}")
    axes.set_xlim(LOWEST_LOG2_ULP - 1, highest + 0.5)
    axes.xaxis.set_major_locator(MaxNLocator(3, integer=True))
    axes.axvline(-1, color="0.7", linewidth=0.6, linestyle=":", zorder=0)
    axes.tick_params(labelsize=6.5, length=2, pad=1.5)
    axes.tick_params(which="minor", length=0)
    axes.set_title(row.label, size=7, pad=2)


def _caption(kind):
    return (
        f"Distribution of the error, {kind} functions, all strata: share of the judged samples in each quarter of an "
        "octave of ULP (logarithmic axes). Dotted: 0.5 ULP, the limit of correct rounding. "
        f"Errors below 2^{LOWEST_LOG2_ULP} ULP are counted in the lowest step, above 2^{HIGHEST_LOG2_ULP} in the highest. "
        "Marker at a curve's end: its largest error. Marker at the left edge: share of the samples that were exact."
    )


def _draw_class(combined, kind):
    name = f"distributions_{kind}"
    rows = [
        row
        for row in combined.rows
        if row.function_class == kind
        and any((row, token) in combined.cells for token in combined.type_tokens)
    ]
    if not rows:
        return name, _caption(kind), None
    columns = min(3 if figure_style.is_one_column() else COLUMNS, len(rows))
    lines = math.ceil(len(rows) / columns)
    width, height = PANEL_INCHES
    # Labels stand outside: what is wider than the page would be printed smaller.
    inches = min(columns * width + 0.5, figure_style.PAGE_INCHES - 0.45)
    width = (figure_style.width(inches) - 0.5) / columns
    figure, grid = pyplot.subplots(
        lines,
        columns,
        figsize=(columns * width + 0.5, lines * height + 0.6),
        squeeze=False,
    )
    figure.subplots_adjust(
        left=0.0, right=1.0, bottom=0.0, top=1.0, wspace=0.32, hspace=0.42
    )
    panels = list(grid.flat)
    for axes, row in zip(panels, rows):
        _draw_panel(axes, row, combined)
    for axes in panels[len(rows) :]:
        axes.remove()
    inches = figure.get_figheight()
    figure.text(0.5, -0.33 / inches, "error (log2 ULP)", ha="center", size=9)
    figure.text(
        -0.36 / figure.get_figwidth(),
        0.5,
        "log10(share of judged samples)",
        va="center",
        ha="right",
        rotation=90,
        size=9,
    )
    handles = [
        Line2D(
            [],
            [],
            color=figure_style.colour(i),
            marker=figure_style.marker(i),
            markersize=3,
            label=token,
        )
        for i, token in enumerate(combined.type_tokens)
    ]
    figure.legend(
        handles=handles,
        loc="lower center",
        bbox_to_anchor=(0.5, 1 + 0.2 / inches),
        ncol=figure_style.legend_columns(min(len(handles), columns + 2)),
        columnspacing=1.0,
    )
    return name, _caption(kind), figure


def draw_real(combined):
    """(name, caption, figure) of the real functions."""
    return _draw_class(combined, "real")


def draw_complex(combined):
    """(name, caption, figure) of the complex functions, their parts apart."""
    return _draw_class(combined, "complex")


def draw_special(combined):
    """(name, caption, figure) of the special functions."""
    return _draw_class(combined, "special")
