"""What the figures of the pendulum share: file names, and what is drawn of which condition."""
import re

from matplotlib.lines import Line2D

from ulpgate_report.figures import figure_style
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
