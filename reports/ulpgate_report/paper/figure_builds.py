"""Bars of speed over all builds and numbers of threads that one scene was timed with, the published slowdowns beside."""
import math

from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ulpgate_report.figures import figure_style
from ulpgate_report.scenes import benchmark
from ulpgate_report.values import type_order

NAME = "builds"
CAPTION = (
    "Speed of the deposition of spheres by type, a bar for each build and number of threads (%s): iterations per second, and the slowdown "
    "against double of the same build and threads. Error bars: two standard deviations of the mean of the repeats that are within two of it. %s"
)
_PUBLISHED = "Diamonds: the published slowdowns on 16 threads. "
_HATCHES = ("", "////", "....")


def _label(key):
    """What a run of the suite was: its scene is named deposition_BUILD_THREADS."""
    scene, threads = key
    build = scene.partition("_")[2].removesuffix(f"_{threads}").replace("_", " ")
    many = f"{threads} thread" + "s" * (threads > 1)
    return f"{build}, {many}" if build else many


def _heights(bars, key):
    found = {}
    for bar in bars:
        value, deviation = key(bar)
        if value is not None:
            kept = bar.timing.get("kept", 1)
            found[bar.timing["type"]] = (value, 2 * deviation / math.sqrt(max(1, kept)))
    return found


def _draw_panel(axes, runs, tokens, key):
    width = 0.8 / len(runs)
    for place, bars in enumerate(runs.values()):
        heights = _heights(bars, key)
        xs = [tokens.index(t) + (place - (len(runs) - 1) / 2) * width for t in heights]
        axes.bar(
            xs,
            [value for value, _ in heights.values()],
            width * 0.92,
            yerr=[0.0 if e != e else e for _, e in heights.values()],
            color=figure_style.colour(place % 7),
            hatch=_HATCHES[place // 7 % len(_HATCHES)],
            edgecolor="white",
            linewidth=0.3,
            error_kw={"elinewidth": 0.7, "capsize": 1.5},
        )
    axes.set_xticks(range(len(tokens)), tokens, rotation=40, ha="right")
    axes.set_yscale("log")


def draw(scenes):
    """(name, caption, figure); no figure where nothing was timed."""
    runs = {}
    for bar in benchmark.bars(scenes):
        key = (bar.timing["scene"], bar.timing["threads"])
        runs.setdefault(key, []).append(bar)
    if not runs:
        return NAME, CAPTION % ("", ""), None
    tokens = type_order.ordered(
        b.timing["type"] for bars in runs.values() for b in bars
    )
    figure, (left, right) = figure_style.panels(2, 7.0, 3.2)
    figure.subplots_adjust(wspace=0.3, hspace=0.5)
    _draw_panel(
        left,
        runs,
        tokens,
        lambda b: (b.timing["iterations_per_s"], b.timing["deviation"]),
    )
    left.set_ylabel("iterations per second")
    _draw_panel(right, runs, tokens, lambda b: (b.slowdown, b.slowdown_deviation))
    right.set_ylabel("slowdown against double")
    right.axhline(1.0, color="0.4", linewidth=0.7, linestyle=":")
    published = {
        b.timing["type"]: b.paper_slowdown
        for bars in runs.values()
        for b in bars
        if b.paper_slowdown is not None
    }
    style = {"marker": "D", "linestyle": "none", "markeredgecolor": "black"}
    style |= {"markerfacecolor": "white", "markersize": 4.5, "zorder": 5}
    right.plot([tokens.index(t) for t in published], list(published.values()), **style)
    handles = [
        Patch(
            facecolor=figure_style.colour(place % 7),
            hatch=_HATCHES[place // 7 % len(_HATCHES)],
            edgecolor="white",
            label=_label(key),
        )
        for place, key in enumerate(runs)
    ]
    if published:
        handles.append(Line2D([], [], label="published", **style))
    left.legend(
        handles=handles,
        loc="lower left",
        bbox_to_anchor=(0, 1.0),
        ncol=figure_style.legend_columns(4),
        columnspacing=1.0,
    )
    about = ", ".join(map(_label, runs))
    return NAME, CAPTION % (about, _PUBLISHED * bool(published)), figure
