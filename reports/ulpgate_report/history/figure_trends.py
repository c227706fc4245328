"""Each row that stepped over the runs, a panel for a row, with the commit at every step."""
import math
import statistics

from matplotlib import pyplot

from ulpgate_report.figures import figure_style
from ulpgate_report.history import tables

FAMILY = "history"
_CAPTION = (
    "Rows that stepped, over the runs by time: largest error, or time of an evaluation (lower quartile of the repeats, a bar over "
    "all of them). A broken line is a step, with its commit. %s"
)
_PANELS = 12
_WIDTH, _HEIGHT = 6.6, 1.25


def lower_quartile(times):
    """The time of a row from its repeats, as the program takes it."""
    return sorted(times)[(len(times) - 1) // 4]


def _scaled(times):
    """(factor, unit) that times in seconds read well in."""
    least = min(lower_quartile(repeats) for _, repeats in times)
    for unit, factor in (("s", 1), ("ms", 1e3), ("µs", 1e6)):
        if least * factor >= 1:
            return factor, unit
    return 1e9, "ns"


def _draw_times(axes, series):
    factor, unit = _scaled(series.times)
    places = [place for place, _ in series.times]
    middle = [factor * lower_quartile(repeats) for _, repeats in series.times]
    low = [factor * min(repeats) for _, repeats in series.times]
    high = [factor * statistics.median(repeats) for _, repeats in series.times]
    axes.vlines(places, low, high, color=figure_style.colour(1), linewidth=0.8)
    axes.plot(places, middle, color=figure_style.colour(1), marker="s", markersize=3)
    axes.set_ylabel(f"time ({unit})", size=7)


def _draw_errors(axes, series):
    finite = [(p, v) for p, v in series.values if v is not None and math.isfinite(v)]
    axes.plot(*zip(*finite), color=figure_style.colour(0), marker="o", markersize=3)
    # What is no number stands at the top, where nobody takes it for one.
    others = [p for p, v in series.values if v is None or not math.isfinite(v)]
    style = {"color": figure_style.MISMATCH_COLOUR, "marker": "x", "linestyle": ""}
    axes.plot(
        others, [0.96] * len(others), transform=axes.get_xaxis_transform(), **style
    )
    axes.set_ylabel("error", size=7)


def _draw_panel(axes, history, place):
    series = history.series[place]
    if series.times:
        _draw_times(axes, series)
    elif any(v is not None and math.isfinite(v) for _, v in series.values):
        _draw_errors(axes, series)
    axes.set_title(series.title, size=7.5, loc="left", pad=9)
    axes.margins(y=0.2)
    for step in history.steps:
        if step.series != place:
            continue
        axes.axvline(step.run - 0.5, color="0.4", linestyle="--", linewidth=0.7)
        axes.text(
            step.run - 0.5,
            1.01,
            tables.short_commit(history.runs[step.run].commit),
            transform=axes.get_xaxis_transform(),
            ha="center",
            va="bottom",
            size=6,
        )
    axes.set_xlim(-0.7, len(history.runs) - 0.3)


def draw(history):
    """(name, caption, figure): the latest steps first; no figure where no row stepped."""
    latest = sorted(history.steps, key=lambda step: -step.run)
    places = list(dict.fromkeys(step.series for step in latest))
    shown = places[:_PANELS]
    left_out = len(places) - len(shown)
    caption = _CAPTION % (
        f"The {left_out} rows whose steps are older are in the table."
        if left_out
        else ""
    )
    if not shown:
        return FAMILY, caption, None
    size = (
        figure_style.width(_WIDTH) + 0.4 * figure_style.is_one_column(),
        _HEIGHT * len(shown) + 0.4,
    )
    figure, panels = pyplot.subplots(
        len(shown), 1, sharex=True, squeeze=False, figsize=size, layout="constrained"
    )
    for axes, place in zip(panels[:, 0], shown):
        _draw_panel(axes, history, place)
    count = len(history.runs)
    ticks = range(0, count, max(1, math.ceil(count / 12)))
    labels = [tables.date_of(history.runs[place]) for place in ticks]
    panels[-1, 0].set_xticks(list(ticks), labels, rotation=30, ha="right")
    return FAMILY, caption.strip(), figure
