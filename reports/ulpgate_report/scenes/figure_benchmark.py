"""Speed of each scene: iterations per second and slowdown against double by type, the published slowdowns beside."""
import math

from matplotlib import pyplot
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ulpgate_report.figures import figure_style, type_style
from ulpgate_report.scenes import benchmark
from ulpgate_report.values import type_order

FAMILY = "benchmark"
_CAPTION = (
    "Scene %s: iterations per second (left, logarithmic) and slowdown against double on as many threads (right) by type. "
    "Bars: mean of the repeats within two standard deviations; lines on them: their standard deviation.%s"
)
_PAPER = (
    " Diamonds: the slowdowns that were published for YADE on 16 threads "
    "(Kozicki, Gladky, Thoeni, CPC 2022), of another machine and another program."
)
_HATCHES = ("", "////", "....", "xxxx", "\\\\\\\\")
_ERROR_BARS = {"elinewidth": 0.8, "ecolor": "black"}


def _place(index, count):
    """Offset and width of the bar `index` of `count` that stand side by side."""
    width = 0.8 / count
    return (index - (count - 1) / 2) * width, width


def _draw_bars(axes, bars, tokens, threads, value_of, beside):
    for bar in bars:
        value, deviation = value_of(bar)
        if value is None:
            continue
        colour, _ = type_style.line_style(bar.timing["type"], tokens)
        which = threads.index(bar.timing["threads"])
        offset, width = _place(which, len(threads))
        x = tokens.index(bar.timing["type"]) + offset
        axes.bar(
            x,
            value,
            width,
            color=colour,
            hatch=_HATCHES[which % len(_HATCHES)],
            edgecolor="white",
            linewidth=0.5,
            yerr=deviation if math.isfinite(deviation) else None,
            capsize=2.5,
            error_kw=_ERROR_BARS,
        )
        top = value + (deviation if math.isfinite(deviation) else 0)
        axes.annotate(
            f"{value:.3g}",
            (x, max(top, beside(bar) or 0)),
            xytext=(0, 5),
            textcoords="offset points",
            ha="center",
            va="bottom",
            size=6,
            # Side by side the numbers would run into each other.
            rotation=90 if len(threads) > 1 else 0,
        )
    axes.set_xticks(range(len(tokens)), tokens, rotation=40, ha="right")


def _draw_paper(axes, bars, tokens):
    published = {
        bar.timing["type"]: bar.paper_slowdown
        for bar in bars
        if bar.paper_slowdown is not None
    }
    axes.plot(
        [tokens.index(token) for token in published],
        list(published.values()),
        marker="D",
        markersize=5,
        markerfacecolor="white",
        markeredgecolor="black",
        linestyle="none",
        zorder=5,
    )
    return published


def _legend_handles(threads, published):
    handles = []
    if len(threads) > 1:
        for which, count in enumerate(threads):
            hatch = _HATCHES[which % len(_HATCHES)]
            text = f"{count} thread" + ("s" if count > 1 else "")
            handles.append(Patch(fc="0.6", ec="white", hatch=hatch, label=text))
    if published:
        style = {"marker": "D", "linestyle": "none", "markeredgecolor": "black"}
        handles.append(
            Line2D([], [], markerfacecolor="white", label="published", **style)
        )
    return handles


def draw(scenes):
    """Yield (name, caption, figure) for each scene that was timed."""
    all_bars = benchmark.bars(scenes)
    for scene in dict.fromkeys(bar.timing["scene"] for bar in all_bars):
        bars = [bar for bar in all_bars if bar.timing["scene"] == scene]
        tokens = type_order.ordered(bar.timing["type"] for bar in bars)
        threads = sorted({bar.timing["threads"] for bar in bars})
        figure, (left, right) = figure_style.panels(2, 7.0, 3.0)
        figure.subplots_adjust(wspace=0.3)

        def speed(bar):
            return bar.timing["iterations_per_s"], bar.timing["deviation"]

        def slowdown(bar):
            return bar.slowdown, bar.slowdown_deviation

        _draw_bars(left, bars, tokens, threads, speed, lambda bar: None)
        left.set_yscale("log")
        left.set_ylabel("iterations per second")
        _draw_bars(
            right, bars, tokens, threads, slowdown, lambda bar: bar.paper_slowdown
        )
        right.set_ylabel("slowdown against double")
        if any(bar.slowdown is not None for bar in bars):
            right.axhline(1.0, color="0.4", linewidth=0.7, linestyle=":")
        published = _draw_paper(right, bars, tokens)
        handles = _legend_handles(threads, published)
        if handles:
            right.legend(handles=handles, loc="upper left")
        yield f"{FAMILY}_{scene}", _CAPTION % (scene, _PAPER * bool(published)), figure
