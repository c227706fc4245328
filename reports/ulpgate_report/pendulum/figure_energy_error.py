"""The largest error of the energy against type, at each time step: with averaged velocities and with raw ones."""
import math

from matplotlib import pyplot

from ulpgate_report.figures import figure_style
from ulpgate_report.pendulum.drawing import (
    dodge,
    ends_text,
    legend_above,
    marker_handle,
    slug,
    step_handles,
    step_style,
    subject,
)
from ulpgate_report.pendulum.figure_t_s import by_scene_and_variant
from ulpgate_report.values import numbers, time_step, type_order

FAMILY = "pendulum_max_error"
_CAPTION = (
    "%s: largest distance of the energy from its start until the end of the run, %s, against type, for each time step. Filled: with the mean "
    "of the velocities of two half steps; hollow: raw, with one of them."
)
_SIZES = {False: 4, True: 7}
_NAMES = ("max_energy_error", "max_energy_error_raw")


def errors(rows):
    """[(dt, type, raw or not, error)] of what is finite and above 0."""
    found = []
    for row in rows:
        for name in _NAMES:
            value = numbers.signed(row.get(name))
            if value is not None and math.isfinite(value) and value > 0:
                found.append((str(row["dt"]), row["type"], name == _NAMES[1], value))
    return found


def _ends(rows):
    """{step: times}"""
    ends = {}
    for row in rows:
        ends.setdefault(str(row["dt"]), set()).add(numbers.signed(row["t_end"]))
    return ends


def _draw(found):
    steps = time_step.ordered(dt for dt, *_ in found)
    tokens = type_order.ordered(token for _, token, *_ in found)
    figure, axes = pyplot.subplots(figsize=(figure_style.width(5.6), 3.2))
    for index, dt in enumerate(steps):
        style = step_style(index, len(steps))
        for raw in (True, False):
            mine = sorted(
                (tokens.index(token) + dodge(index, len(steps)), value)
                for of_dt, token, is_raw, value in found
                if of_dt == dt and is_raw == raw
            )
            # The raw error is the larger one or nearly the same: its marker goes round the other.
            style["markersize"] = _SIZES[raw]
            axes.plot(
                [x for x, _ in mine],
                [value for _, value in mine],
                markerfacecolor="white" if raw else style["color"],
                # Between two types is nothing that a line could show.
                linestyle="none",
                **style,
            )
    handles = step_handles(steps)
    if any(raw for *_, raw, _ in found):
        handles.append(marker_handle("averaged", size=_SIZES[False]))
        handles.append(marker_handle("raw", face="white", size=_SIZES[True]))
    axes.set_xticks(range(len(tokens)), tokens, rotation=30, ha="right")
    axes.set_xlim(-0.5, len(tokens) - 0.5)
    figure_style.log_axis(axes.yaxis)
    axes.set_ylabel("largest error of the energy (J)")
    legend_above(axes, handles, x=-0.02, handletextpad=0.2)
    return figure


def draw(pendulum):
    """Yield (name, caption, figure) for each scene and variant with an energy error."""
    for (scene, variant), rows in by_scene_and_variant(pendulum.records).items():
        rows = [row for row in rows if errors([row])]
        found = errors(rows)
        if found:
            name = "_".join(filter(None, (FAMILY, scene, slug(variant))))
            about = (subject(scene, "", variant), ends_text(_ends(rows)))
            yield name, _CAPTION % about, _draw(found)
