"""What the figures of the pendulum share: file names, what captions begin with, legends, what is drawn of which condition."""
import re

import numpy
from matplotlib.lines import Line2D

from ulpgate_report.figures import figure_style
from ulpgate_report.pendulum import published
from ulpgate_report.values import time_step


def slug(text):
    """A text as part of a file's name."""
    return re.sub(r"[^A-Za-z0-9_.+-]+", "-", text).strip("-")


def name_of(family, run, condition, conditions):
    """The name of a figure of one run directory; what tells conditions of one scene apart comes last."""
    parts = [family, condition.scene, slug(run.name)]
    if sum(other.scene == condition.scene for other in conditions) > 1:
        parts += [slug(condition.dt), slug(condition.variant)]
    return "_".join(filter(None, parts))


def each_condition(pendulum, what):
    """Yield (run, condition, [(type, what the run has of it)], all conditions) for each run and condition."""
    for run in pendulum.runs:
        found = run.by_condition(getattr(run, what))
        for condition, lines in found.items():
            yield run, condition, lines, list(found)


def subject(scene, dt, variant):
    """What a caption begins with: the scene, its step and its variant, each with what it means where that is known."""
    step = f"time step {dt} s" if dt else ""
    overrides = published.overrides(variant)
    told = [published.MEANINGS.get(one, "") for one in (scene, *overrides)]
    names = [scene, *overrides]
    texts = [f"{n} ({t})" if t else n for n, t in zip(names, told)]
    return ", ".join(filter(None, (texts[0], step, *texts[1:])))


def chunk_of(curves):
    """The length of the chunks of curves of correlation in s, None where they have one chunk or several lengths."""
    found = {
        f"{numpy.diff(curve['time_s'][:2])[0]:.4g}"
        for curve in curves
        if len(curve["time_s"]) > 1
    }
    return found.pop() if len(found) == 1 else None


def ends_text(ends):
    """When runs ended, of {step: times in s}: `12 s`, or `12 s at a time step of 1e-5 s, 4 s at 1e-6 s`."""
    texts = {}
    for dt in time_step.ordered(ends):
        times = sorted({f"{time:.4g}" for time in ends[dt]}, key=float)
        texts[dt] = f"{' to '.join(dict.fromkeys((times[0], times[-1])))} s"
    if len(set(texts.values())) == 1:
        return next(iter(texts.values()))
    of = "a time step of "
    parts = [
        f"{t} at {'' if n else of}{dt} s" for n, (dt, t) in enumerate(texts.items())
    ]
    return ", ".join(parts)


def legend_above(axes, handles, x=0.0, y=1.0, **style):
    """A legend above the axes in as few lines as their width holds, the lines of nearly one length."""
    renderer = axes.figure.canvas.get_renderer()
    # Of an entry of several marks the first has its label.
    firsts = [one[0] if isinstance(one, tuple) else one for one in handles]
    for lines in range(1, len(handles) + 1):
        legend = axes.legend(
            handles=handles,
            labels=[one.get_label() for one in firsts],
            loc="lower left",
            bbox_to_anchor=(x, y),
            ncol=-(-len(handles) // lines),
            columnspacing=1.0,
            **style,
        )
        room = axes.get_window_extent(renderer).width
        if legend.get_window_extent(renderer).width <= room:
            break
    return legend


def dodge(index, count):
    """How far beside its type the point of the step `index` of `count` is drawn; `count` is just right of the last."""
    width = min(0.14, 0.8 / (count + 1))
    return (index - (count - 1) / 2) * width


def step_style(index, count):
    """Colour and marker of the time step `index` of `count`."""
    return {
        "color": figure_style.step_colour(index, count),
        "marker": figure_style.marker(index),
        "markersize": 5,
    }


def step_handles(steps):
    """Entries of a legend: the time steps."""
    return [
        Line2D(
            [],
            [],
            linestyle="none",
            label=f"$\\Delta t$ = {time_step.label(dt)}",
            **step_style(index, len(steps)),
        )
        for index, dt in enumerate(steps)
    ]


def marker_handle(label, face="0.4", edge="0.4", marker="o", size=5.0):
    """An entry of a legend: a marker in grey."""
    style = {"markerfacecolor": face, "markeredgecolor": edge, "markersize": size}
    return Line2D([], [], marker=marker, linestyle="none", label=label, **style)
