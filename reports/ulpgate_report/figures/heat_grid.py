"""A heat map as a grid: rows by columns, the number in the cell, some cells marked; figures of it differ in their data."""
import math
from collections.abc import Callable
from dataclasses import dataclass

import matplotlib
from matplotlib import pyplot
from matplotlib.patches import Polygon, Rectangle

from ulpgate_report.figures import figure_style, heat_colours
from ulpgate_report.values import numbers

ROW_INCHES = 0.165
COLUMN_INCHES = 0.56
LABEL_INCHES = 1.25
# More rows than these go to a second block beside the first.
ROWS_OF_ONE_BLOCK = 30
# The least that a cell and a row take.
LEAST_CELL_INCHES, LOW_ROW_INCHES = 0.33, 0.098
# More rows than these in one block are low ones.
MOST_FULL_ROWS = 46


@dataclass(frozen=True)
class Grid:
    """What is drawn; `cell_of(row, column)` gives (value, whether it is marked), or None where nothing was measured.

    `function_of` and `group_of` tell which rows stay in one block and where a line stands between rows.
    """

    rows: tuple
    columns: tuple
    cell_of: Callable
    function_of: Callable
    group_of: Callable
    scale: heat_colours.Scale
    ticks: dict
    bar_label: str
    mark_text: str
    label_inches: float = LABEL_INCHES


def _cell_inches(grid, blocks):
    """What is left for a cell where so many blocks share the width, at most COLUMN_INCHES."""
    room = figure_style.width(figure_style.PAGE_INCHES) / blocks - grid.label_inches
    return min(COLUMN_INCHES, room / len(grid.columns))


def _blocks(grid):
    rows = grid.rows
    if len(rows) <= ROWS_OF_ONE_BLOCK or figure_style.is_one_column():
        return [rows]
    # Two that do not fit beside each other would be drawn too small to read.
    if _cell_inches(grid, 2) < LEAST_CELL_INCHES:
        return [rows]
    half = math.ceil(len(rows) / 2)
    # The parts of one function stay together.
    while half < len(rows) and (
        grid.function_of(rows[half - 1]) == grid.function_of(rows[half])
    ):
        half += 1
    return [rows[:half], rows[half:]]


def _draw_mismatch(axes, x, y):
    """A triangle in the upper right corner of the cell at (x, y)."""
    corner = [(x + 0.8, y + 0.04), (x + 0.98, y + 0.04), (x + 0.98, y + 0.6)]
    axes.add_patch(
        Polygon(
            corner,
            facecolor=figure_style.MISMATCH_COLOUR,
            edgecolor="white",
            linewidth=0.5,
            zorder=3,
            clip_on=False,
        )
    )


def _draw_cell(axes, x, y, cell, scale):
    value, marked = cell or (None, False)
    if value is None:
        axes.text(x + 0.5, y + 0.5, "-", ha="center", va="center", color="0.5", size=6)
    else:
        infinite = value == numbers.INFINITE
        axes.add_patch(
            Rectangle(
                (x, y),
                1,
                1,
                facecolor=scale.background(value),
                edgecolor="0.3" if infinite else "white",
                hatch="/////" if infinite else None,
                linewidth=0.4,
            )
        )
        shown = numbers.cell_of_map(value)
        # The hatch of an infinite error would run through its text.
        box = {"facecolor": "white", "edgecolor": "none", "pad": 0.6}
        axes.text(
            # Beside the mark there is less room.
            x + (0.43 if marked else 0.5),
            y + 0.53,
            shown,
            ha="center",
            va="center",
            size=6,
            color=scale.foreground(value),
            bbox=box if infinite else None,
        )
    if marked:
        _draw_mismatch(axes, x, y)


def _draw_block(axes, rows, grid):
    tokens = grid.columns
    axes.set_xlim(0, len(tokens))
    axes.set_ylim(len(rows), 0)
    for y, row in enumerate(rows):
        for x, token in enumerate(tokens):
            _draw_cell(axes, x, y, grid.cell_of(row, token), grid.scale)
        if y and grid.group_of(row) != grid.group_of(rows[y - 1]):
            axes.axhline(y, color="black", linewidth=0.8, zorder=4)
    axes.set_yticks(
        [y + 0.5 for y in range(len(rows))], [row.label for row in rows], size=6.5
    )
    axes.xaxis.tick_top()
    # Slanted heads of long names would run out of the last column; upright ones fit above every cell.
    axes.set_xticks(
        [x + 0.5 for x in range(len(tokens))], tokens, size=6.5, rotation=90
    )
    axes.tick_params(length=0, pad=2)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _signs(grid):
    """What the signs mean that occur beside numbers."""
    cells = [grid.cell_of(row, column) for row in grid.rows for column in grid.columns]
    values = [cell and cell[0] for cell in cells]
    signs = {"- nothing judged": None, "hatched: infinite error": numbers.INFINITE}
    return "; ".join(told for told, value in signs.items() if value in values)


def _draw_legend(figure, grid, left, bottom, width):
    """The colour bar and the mark below the blocks; sizes in shares of the figure."""
    height = 0.11 / figure.get_figheight()
    bar = figure.add_axes([left, bottom, width, height])
    scale = matplotlib.colors.Normalize(
        grid.scale.lowest_log10, grid.scale.highest_log10
    )
    colour_bar = figure.colorbar(
        matplotlib.cm.ScalarMappable(scale, heat_colours.COLOUR_MAP),
        cax=bar,
        orientation="horizontal",
        ticks=list(grid.ticks),
    )
    colour_bar.ax.set_xticklabels(list(grid.ticks.values()), size=6.5)
    colour_bar.outline.set_linewidth(0.4)
    colour_bar.set_label(grid.bar_label, size=7.5)
    # Samples of the cells' marks, drawn as the cells are.
    key = figure.add_axes(
        [
            left + width + 0.35 / figure.get_figwidth(),
            bottom - 0.6 * height,
            3 * COLUMN_INCHES / figure.get_figwidth(),
            2 * ROW_INCHES / figure.get_figheight(),
        ]
    )
    key.set_xlim(0, 3)
    key.set_ylim(2, 0)
    key.axis("off")
    _draw_mismatch(key, -0.8, 0.15)
    key.text(0.3, 0.5, grid.mark_text, size=6.5, va="center")
    key.text(0.3, 1.5, _signs(grid), size=6.5, va="center")


def draw(grid):
    """The figure."""
    blocks = _blocks(grid)
    columns = len(grid.columns)
    least = 0.3 if figure_style.is_one_column() else LEAST_CELL_INCHES
    cell = max(least, _cell_inches(grid, len(blocks)))
    block_width = grid.label_inches + columns * cell
    longest = max(map(len, blocks))
    row_inches = ROW_INCHES if longest <= MOST_FULL_ROWS else LOW_ROW_INCHES
    height = longest * row_inches
    below, above = 0.65, 1.0
    figure = pyplot.figure(figsize=(block_width * len(blocks), height + below + above))
    total_width, total_height = figure.get_size_inches()
    for index, rows in enumerate(blocks):
        left = index * block_width + grid.label_inches
        top = below + height
        inches = len(rows) * row_inches
        axes = figure.add_axes(
            [
                left / total_width,
                (top - inches) / total_height,
                columns * cell / total_width,
                inches / total_height,
            ]
        )
        _draw_block(axes, rows, grid)
    _draw_legend(
        figure,
        grid,
        grid.label_inches / total_width,
        0.35 / total_height,
        (1.2 if figure_style.is_one_column() else 2.6) / total_width,
    )
    return figure
