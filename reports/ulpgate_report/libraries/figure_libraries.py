"""Error against time of several libraries: a panel a type, a mark for each function and library."""
import math

from matplotlib import pyplot
from matplotlib.lines import Line2D

from ulpgate_report.figures import figure_style
from ulpgate_report.values import numbers

NAME = "libraries"
CAPTION = (
    "Maximum error in ULP, all strata that were run, against the time of one evaluation; a mark for each function and library, "
    "the marks of a function joined by a thin line. Dashed: half a ULP, the error of correct rounding. "
    "Errors above 10^6 ULP stand at the upper edge with their function's name, those of 0 at the lower edge."
)
WIDTH_INCHES = 7.0
HEIGHT_INCHES = 3.1
LARGEST_DRAWN_ULP = 1e6
LEAST_DRAWN_ULP = 0.25


def points(beside, token):
    """{function: [(library index, time in ns, max ULP)]}; of functions with several parts the worst."""
    found = {}
    for index, run in enumerate(beside.runs):
        worst = {}
        for row in run.rows:
            cell = run.cells.get((row, token))
            if cell and numbers.larger(cell.max_ulp, worst.get(row.function)):
                worst[row.function] = cell.max_ulp
        for function, max_ulp in worst.items():
            time_ns = run.time_ns.get((function, token))
            if time_ns is not None:
                found.setdefault(function, []).append((index, time_ns, max_ulp))
    return found


def _y(max_ulp):
    return min(max(float(max_ulp), LEAST_DRAWN_ULP), LARGEST_DRAWN_ULP)


def _time_axis(axes, times):
    """Logarithmic, with plain numbers at 1, 2 and 5 times powers of ten."""
    low, high = min(times) / 1.15, max(times) * 1.15
    axes.set_xscale("log")
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    ticks = [k * 10.0**n for n in decades for k in (1, 2, 5)]
    ticks = [tick for tick in ticks if low <= tick <= high]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.set_xticks([], minor=True)
    axes.set_xlim(low, high)


def _draw_panel(axes, beside, token, found):
    for function, marks in sorted(found.items()):
        axes.plot(
            [time for _, time, _ in marks],
            [_y(ulp) for _, _, ulp in marks],
            color="0.8",
            linewidth=0.5,
            zorder=1,
        )
        for index, time, ulp in marks:
            axes.plot(
                [time],
                [_y(ulp)],
                marker=figure_style.marker(index),
                color=figure_style.colour(index),
                linestyle="none",
                markersize=4,
                markeredgecolor="white",
                markeredgewidth=0.3,
                zorder=2,
            )
            if ulp > LARGEST_DRAWN_ULP or not math.isfinite(ulp):
                axes.annotate(
                    function,
                    (time, LARGEST_DRAWN_ULP),
                    xytext=(3, -7),
                    textcoords="offset points",
                    size=6.5,
                    color="0.25",
                )
    axes.axhline(0.5, color="0.5", linestyle=(0, (5, 3)), linewidth=0.8, zorder=0)
    axes.set_title(token, loc="left", size=8.5)
    axes.set_ylabel("largest error (ULP)")
    axes.set_xlabel("time of one evaluation (ns)")
    largest = max(_y(ulp) for marks in found.values() for _, _, ulp in marks)
    axes.set_ylim(LEAST_DRAWN_ULP / 1.2, max(10.0, 2 * largest))
    _time_axis(axes, [time for marks in found.values() for _, time, _ in marks])
    figure_style.log_axis(axes.yaxis)


def draw(beside):
    """(name, caption, figure); no figure where nothing was timed."""
    panels = [(token, points(beside, token)) for token in beside.type_tokens]
    panels = [(token, found) for token, found in panels if found]
    if not panels:
        return NAME, CAPTION, None
    figure, all_axes = pyplot.subplots(
        len(panels),
        1,
        figsize=(figure_style.width(WIDTH_INCHES) + 0.4, HEIGHT_INCHES * len(panels)),
        squeeze=False,
    )
    for axes, (token, found) in zip(all_axes[:, 0], panels):
        _draw_panel(axes, beside, token, found)
    handles = [
        Line2D(
            [],
            [],
            marker=figure_style.marker(i),
            color=figure_style.colour(i),
            linestyle="none",
            markersize=4,
            label=label,
        )
        for i, label in enumerate(beside.labels)
    ]
    figure.legend(
        handles=handles, loc="lower left", bbox_to_anchor=(0.08, 0.99), ncol=3
    )
    figure.tight_layout()
    return NAME, CAPTION, figure
