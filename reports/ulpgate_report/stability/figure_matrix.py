"""Case by type, a letter and a colour for each verdict; one figure for each kind of case."""
import math

from matplotlib import pyplot
from matplotlib.patches import Polygon, Rectangle

from ulpgate_report.figures import figure_style
from ulpgate_report.figures.heat_grid import ROW_INCHES as _ROW
from ulpgate_report.stability import verdicts

FAMILY = "stability"
_CAPTION = (
    "%s, case by type: %s. Triangle: not as known of the case, or where nothing is known neither stable nor "
    "ill-conditioned. No letter: not run."
)
_COLUMN, _ABOVE = 0.24, 0.95
# Of a name at the size of the labels, inches a character.
_CHARACTER = 0.056
_ROWS_OF_ONE_BLOCK = 45
# What a page has room for at full size.
_BLOCKS_OF_ONE_FIGURE, _MOST_ROWS = 2, 48
# A name longer than this is cut, its end kept, where names differ: the table has it whole.
_LONGEST, _END = 44, 16


def _shortened(name):
    if len(name) <= _LONGEST:
        return name
    return name[: _LONGEST - _END - 3] + "..." + name[-_END:]


def blocks(cases):
    """The cases in columns of at most _ROWS_OF_ONE_BLOCK, about equally long."""
    rows = len(cases) if figure_style.is_one_column() else _ROWS_OF_ONE_BLOCK
    # Two where one would do with a few rows more.
    count = min(math.ceil(len(cases) / rows), _BLOCKS_OF_ONE_FIGURE)
    each = math.ceil(len(cases) / count)
    return [cases[start : start + each] for start in range(0, len(cases), each)]


def figures_of(cases):
    """The cases in as many parts as need a figure of their own, about equally long."""
    most = (
        _MOST_ROWS
        if figure_style.is_one_column()
        else _MOST_ROWS * _BLOCKS_OF_ONE_FIGURE
    )
    count = math.ceil(len(cases) / most)
    each = math.ceil(len(cases) / count)
    return [cases[start : start + each] for start in range(0, len(cases), each)]


def _draw_mark(axes, x, y):
    """A triangle in the upper right corner of the cell at (x, y)."""
    corner = [(x + 0.6, y + 0.04), (x + 0.97, y + 0.04), (x + 0.97, y + 0.5)]
    axes.add_patch(Polygon(corner, facecolor="black", edgecolor="white", linewidth=0.5))


def _draw_cell(axes, x, y, letter, is_new):
    verdict = verdicts.BY_LETTER[letter]
    axes.add_patch(
        Rectangle(
            (x, y), 1, 1, facecolor=verdict.back, edgecolor="white", linewidth=0.6
        )
    )
    axes.text(
        x + 0.5,
        y + 0.54,
        letter,
        ha="center",
        va="center",
        size=6.5,
        weight="normal" if verdict.name in verdicts.GOOD else "bold",
        color=verdict.front,
    )
    if is_new:
        _draw_mark(axes, x, y)


def _draw_block(axes, cases, tokens, cut):
    axes.set_xlim(0, len(tokens))
    axes.set_ylim(len(cases), 0)
    before = None
    for y, (key, of_type) in enumerate(cases):
        for x, token in enumerate(tokens):
            row = of_type.get(token)
            if row is not None:
                letter = verdicts.BY_NAME[row["verdict"]].letter
                _draw_cell(axes, x, y, letter, not row["as_known"])
        # The forms of one case stand together.
        case = next(iter(of_type.values()))["case"]
        if before not in (None, case):
            axes.axhline(y, color="0.75", linewidth=0.4, zorder=0)
        before = case
    axes.set_yticks(
        [y + 0.5 for y in range(len(cases))],
        [_shortened(key[cut:]) for key, _ in cases],
        size=6.5,
    )
    axes.xaxis.tick_top()
    axes.set_xticks(
        [x + 0.5 for x in range(len(tokens))], tokens, size=6.5, rotation=90
    )
    axes.tick_params(length=0, pad=2)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _legend_rows(width):
    """In how many lines the letters and words fit."""
    return 1 if width > 7.6 else 2 if width > 3.6 else 3


def _draw_legend(figure, left, width):
    """The letters in lines below, samples of the cells."""
    total, height = figure.get_size_inches()
    rows = _legend_rows(width)
    key = figure.add_axes(
        [left / total, 0.1 / height, width / total, rows * _ROW / height]
    )
    columns = math.ceil((len(verdicts.ALL) + 1) / rows)
    each = min(1.3, width / columns) / _COLUMN
    key.set_xlim(0, width / _COLUMN)
    key.set_ylim(rows, 0)
    key.axis("off")
    for index, verdict in enumerate(verdicts.ALL):
        x, y = index % columns * each, index // columns
        _draw_cell(key, x, y, verdict.letter, False)
        key.text(x + 1.2, y + 0.54, verdict.words, size=6.5, va="center")
    x, y = len(verdicts.ALL) % columns * each, len(verdicts.ALL) // columns
    _draw_mark(key, x, y)
    key.text(x + 1.2, y + 0.54, "not as known", size=6.5, va="center")


def _draw(cases, tokens, cut):
    parts = blocks(cases)
    longest = max(len(_shortened(key[cut:])) for key, _ in cases)
    label = 0.15 + _CHARACTER * longest
    block = label + len(tokens) * _COLUMN
    height = max(map(len, parts)) * _ROW
    legend = max(2.0, block * len(parts) - 0.1)
    below = 0.3 + _ROW * _legend_rows(legend)
    size = (max(block * len(parts), legend + 0.1), height + _ABOVE + below)
    figure = pyplot.figure(figsize=size)
    for index, mine in enumerate(parts):
        inches = len(mine) * _ROW
        left, bottom = index * block + label, below + height - inches
        axes = figure.add_axes(
            [
                left / size[0],
                bottom / size[1],
                len(tokens) * _COLUMN / size[0],
                inches / size[1],
            ]
        )
        _draw_block(axes, mine, tokens, cut)
    _draw_legend(figure, 0.1, legend)
    return figure


def draw(stress):
    """Yield (name, caption, figure) for each kind of case."""
    for kind in stress.kinds:
        cases = list(stress.of_kind(kind).items())
        words = kind.replace("_", " ").capitalize()
        parts = figures_of(cases)
        for place, mine in enumerate(parts, 1):
            name = f"{FAMILY}_{kind}" + (f"_{place}" if place > 1 else "")
            part = f", part {place} of {len(parts)}" if len(parts) > 1 else ""
            figure = _draw(mine, stress.type_tokens, len(kind) + 1)
            yield name, _CAPTION % (words + part, verdicts.LEGEND), figure
