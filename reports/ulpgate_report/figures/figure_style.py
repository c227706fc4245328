"""The look that all figures share, and their bytes: the same input gives the same file."""
import contextlib
import functools
import io
import math

import matplotlib

matplotlib.use("Agg")
# The backend has to be chosen first.
from matplotlib import mathtext, pyplot  # noqa: E402

SUFFIXES = ("pdf", "svg", "png")
# Widths of a page and of one of its two columns, as journals have them.
PAGE_INCHES, COLUMN_INCHES = 7.2, 3.5
_width = {"inches": PAGE_INCHES}
PNG_DOTS_PER_INCH = 200
PADDING_INCHES = 0.03
# Okabe and Ito's colours, told apart by colour-blind readers; yellow is left out, too pale on white.
_COLOURS = (
    "#0072B2",
    "#D55E00",
    "#009E73",
    "#CC79A7",
    "#000000",
    "#E69F00",
    "#56B4E9",
)
_MARKERS = ("o", "s", "^", "D", "v", "X", "P", "<", ">", "p", "*")
MISMATCH_COLOUR = "#D55E00"
_PARAMETERS = {
    "font.family": "DejaVu Sans",
    "font.size": 8,
    "axes.labelsize": 9,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5,
    "legend.fontsize": 7.5,
    "legend.frameon": False,
    "lines.linewidth": 1.0,
    # TrueType: publishers refuse Type 3 fonts.
    "pdf.fonttype": 42,
    "svg.fonttype": "path",
    "savefig.facecolor": "white",
}
# No dates and no versions in the files.
_METADATA = {
    "pdf": {"CreationDate": None, "Creator": "ulpgate", "Producer": "ulpgate"},
    "svg": {"Date": None, "Creator": "ulpgate"},
    "png": {"Software": "ulpgate"},
}


def _keep_parsed_texts():
    """Labels such as 10^-16 are parsed once each: matplotlib forgets them with every file, and parsing was an eighth of drawing."""
    parser = mathtext.MathTextParser
    parse = getattr(getattr(parser, "_parse_cached", None), "__wrapped__", None)
    if parse is None:  # another matplotlib: it parses as it does
        return

    of_output = {}

    @functools.lru_cache(maxsize=None)
    def kept(output, *text):
        return parse(of_output[output], *text)

    def parse_once(self, *text):
        output = self._output_type
        of_output.setdefault(output, self)
        return kept(output, *text)

    parser._parse_cached = parse_once


_keep_parsed_texts()
pyplot.rcdefaults()
matplotlib.rcParams.update(_PARAMETERS)


def colour(index):
    """Colour of the type at `index`."""
    return _COLOURS[index % len(_COLOURS)]


def step_colour(index, count):
    """Colour of one of `count` ordered things that are no types: dark to light, in order without colour vision too."""
    return matplotlib.colormaps["viridis"](0.78 * index / max(1, count - 1))


def marker(index):
    """Marker of the type at `index`; the colours repeat sooner than the markers."""
    return _MARKERS[index % len(_MARKERS)]


@contextlib.contextmanager
def one_column():
    """Figures drawn inside are as wide as one column: panels stand below each other where they stood side by side."""
    _width["inches"] = COLUMN_INCHES
    try:
        yield
    finally:
        _width["inches"] = PAGE_INCHES


def is_one_column():
    """Whether figures are drawn for one column."""
    return _width["inches"] < PAGE_INCHES


def width(inches):
    """The width of a plot that asks for so many inches; labels outside of it come on top."""
    return min(inches, COLUMN_INCHES - 0.5) if is_one_column() else inches


def side_by_side(count):
    """How many of `count` panels stand beside each other."""
    return 1 if is_one_column() else count


def legend_columns(count):
    """How many entries of a legend stand in a line."""
    return min(count, 3) if is_one_column() else count


def panels(count, inches, height):
    """A figure with `count` panels in a row of so many inches, or below each other; (figure, its axes)."""
    across = side_by_side(count)
    figure, grid = pyplot.subplots(
        count // across,
        across,
        figsize=(width(inches), height * (count // across)),
        squeeze=False,
    )
    figure.subplots_adjust(hspace=0.42)
    return figure, list(grid.flat)


def render(figure, name, suffixes=SUFFIXES):
    """The bytes of the figure by each of `suffixes`; the figure is closed."""
    # The salt makes the ids inside an SVG fixed, and different from those of another figure on the same page.
    matplotlib.rcParams["svg.hashsalt"] = name
    # Its layout and how far it reaches are the same in each format, which else would draw it once more to find them.
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    box = figure.get_tightbbox(figure.canvas.get_renderer()).padded(PADDING_INCHES)
    files = {}
    for suffix in suffixes:
        buffer = io.BytesIO()
        figure.savefig(
            buffer,
            format=suffix,
            dpi=PNG_DOTS_PER_INCH,
            bbox_inches=box,
            metadata=_METADATA[suffix],
        )
        files[suffix] = buffer.getvalue()
    pyplot.close(figure)
    return files


def power_of_ten(exponent):
    """A label such as 10^-16 for an axis whose values are decimal logarithms."""
    return rf"$10^{{{exponent}}}$"


def log_axis(axis):
    """Make an axis logarithmic, with ticks at multiples of a pleasant power of ten where it spans many."""
    axis.axes.set(**{f"{axis.axis_name}scale": "log"})
    low, high = axis.get_view_interval()
    low, high = math.log10(low), math.log10(high)
    step = log10_tick_step(high - low, 7)
    if step > 1:
        first = math.ceil(low / step)
        ticks = [step * n for n in range(first, math.floor(high / step) + 1)]
        axis.set_ticks([10.0**n for n in ticks], [power_of_ten(n) for n in ticks])
        axis.set_ticks([], minor=True)


def log10_tick_step(span_decades, most=8):
    """The smallest pleasant step that gives at most `most` ticks on `span_decades`."""
    for step in (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000):
        if span_decades / step <= most:
            return step
    return max(1, math.ceil(span_decades / most))
