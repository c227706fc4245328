"""Relative error against time: what a digit costs, all functions and types, each type's rounding floor marked."""
import math
from dataclasses import dataclass

from matplotlib import pyplot
from matplotlib.lines import Line2D

from ulpgate_report.figures import cut_scale, figure_style
from ulpgate_report.values import numbers

NAME = "error_vs_time"
CAPTION = (
    "Largest relative error, max ULP over the strata uniform and stratified times 2^-(p-1) with p significand bits, "
    "against the time of one evaluation; a point for each function and type, of a complex function its worse part. "
    "Dashed: the rounding floor 2^-p (0.5 ULP) of each type. The vertical axis is cut where no type has a point "
    "(grey bands). Where there are such rows: 'exact', no sample had an error; 'infinite', more ULP than a double can tell. "
    "Named: the function of the largest error of each type above 4 ULP."
)
# Below this the largest error of a type is not worth a name.
NAMED_FROM_ULP = 4.0
WIDTH_INCHES = 7.0
# What names of types right of the plot take.
NAMES_INCHES = 0.6
INCHES_PER_DECADE = 0.11
# Distance of the rows `exact` and `infinite` from the scale, in decades.
ROW_OFFSET = 1.5


@dataclass(frozen=True)
class Point:
    """One function and type; the error is a decimal logarithm, -inf for exact and inf for infinite."""

    function: str
    type_index: int
    log10_time_ns: float
    max_ulp: object
    log10_error: float


def floor_log10(bits):
    """Decimal logarithm of half a ULP at 1."""
    return -bits * math.log10(2)


def points(combined):
    """A point for each function and type that has both an error and a time, in display order.

    Logarithms all the way: 2^-4000 of a long type is below the smallest double.
    """
    found = []
    functions = dict.fromkeys(row.function for row in combined.rows)
    for type_index, entry in enumerate(combined.types):
        worst = dict.fromkeys(functions)
        for row in combined.rows:
            cell = combined.paper_cells.get((row, entry["token"]))
            if cell and numbers.larger(cell.max_ulp, worst[row.function]):
                worst[row.function] = cell.max_ulp
        for function, max_ulp in worst.items():
            time_ns = combined.time_ns.get((function, entry["token"]))
            if time_ns is not None and max_ulp is not None:
                one_ulp = floor_log10(entry["significand_bits"] - 1)
                found.append(
                    Point(
                        function,
                        type_index,
                        math.log10(time_ns),
                        max_ulp,
                        numbers.log10(max_ulp) + one_ulp,
                    )
                )
    return found


def _drawn_y(point, scale):
    if point.log10_error == numbers.INFINITE:
        return scale.length + ROW_OFFSET
    if point.log10_error == -numbers.INFINITE:
        return -ROW_OFFSET
    return scale.position(point.log10_error)


def _draw_floors(axes, combined, scale, right):
    """Dashed lines; types of one precision share a line and its label."""
    tokens_of = {}
    for index, entry in enumerate(combined.types):
        tokens_of.setdefault(entry["significand_bits"], []).append((index, entry))
    for bits, entries in sorted(tokens_of.items()):
        y = scale.position(floor_log10(bits))
        axes.axhline(
            y,
            color=figure_style.colour(entries[0][0]),
            linestyle=(0, (5, 3)),
            linewidth=0.8,
            zorder=1,
        )
        names = ", ".join(entry["token"] for _, entry in entries)
        axes.text(
            right,
            y,
            f" {names}\n $2^{{-{bits}}}$",
            size=6.5,
            va="center",
            linespacing=1.15,
        )


def _draw_points(axes, combined, found, scale):
    handles = []
    for index, token in enumerate(combined.type_tokens):
        mine = [point for point in found if point.type_index == index]
        style = {
            "marker": figure_style.marker(index),
            "color": figure_style.colour(index),
            "linestyle": "none",
            "markersize": 4,
            "markeredgecolor": "white",
            "markeredgewidth": 0.3,
        }
        axes.plot(
            [p.log10_time_ns for p in mine], [_drawn_y(p, scale) for p in mine], **style
        )
        handles.append(Line2D([], [], label=token, **style))
        if not mine:
            continue
        worst = max(mine, key=lambda point: point.max_ulp)
        if worst.max_ulp > NAMED_FROM_ULP:
            axes.annotate(
                worst.function,
                (worst.log10_time_ns, _drawn_y(worst, scale)),
                xytext=(4, 2),
                textcoords="offset points",
                size=6.5,
                color="0.25",
            )
    return handles


def _label_axes(axes, found, scale):
    values = {value: scale.position(value) for value in scale.ticks(2)}
    labels = {y: figure_style.power_of_ten(int(v)) for v, y in values.items()}
    if any(point.log10_error == -numbers.INFINITE for point in found):
        labels[-ROW_OFFSET] = "exact"
    if any(point.log10_error == numbers.INFINITE for point in found):
        labels[scale.length + ROW_OFFSET] = "infinite"
    axes.set_yticks(list(labels), list(labels.values()))
    for low, high in scale.cuts:
        axes.axhspan(low, high, facecolor="0.92", edgecolor="none", zorder=0)
    axes.set_ylim(min([0.0, *labels]) - 0.6, max([scale.length, *labels]) + 0.6)
    times = [point.log10_time_ns for point in found]
    low, high = min(times) - 0.15, max(times) + 0.25
    axes.set_xlim(low, high)
    step = figure_style.log10_tick_step(high - low)
    ticks = [n for n in range(math.ceil(low), math.floor(high) + 1) if n % step == 0]
    axes.set_xticks(ticks, [figure_style.power_of_ten(n) for n in ticks])
    minor = [
        n + math.log10(k)
        for n in range(math.floor(low), math.ceil(high))
        for k in range(2, 10)
    ]
    axes.set_xticks([x for x in minor if low < x < high], minor=True)
    axes.set_xlabel("time of one evaluation (ns)")
    axes.set_ylabel("largest relative error")
    return high


def draw(combined):
    """(name, caption, figure); no figure where nothing was timed."""
    found = points(combined)
    if not found:
        return NAME, CAPTION, None
    floors = [floor_log10(entry["significand_bits"]) for entry in combined.types]
    finite = [p.log10_error for p in found if math.isfinite(p.log10_error)]
    scale = cut_scale.make(floors + finite)
    height = max(3.5, INCHES_PER_DECADE * (scale.length + 2 * ROW_OFFSET)) + 0.9
    width = figure_style.width(WIDTH_INCHES)
    if figure_style.is_one_column():
        width -= NAMES_INCHES
    figure, axes = pyplot.subplots(figsize=(width, height))
    handles = _draw_points(axes, combined, found, scale)
    right = _label_axes(axes, found, scale)
    _draw_floors(axes, combined, scale, right)
    axes.legend(
        handles=handles,
        loc="lower left",
        bbox_to_anchor=(0, 1.0),
        ncol=figure_style.legend_columns(min(7, len(handles))),
        columnspacing=1.0,
        handletextpad=0.2,
    )
    return NAME, CAPTION, figure
