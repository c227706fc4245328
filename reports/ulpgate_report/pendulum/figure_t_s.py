"""How long each type stays true, at each time step: t_s against type, lower bounds as arrows, published values beside."""
from matplotlib import pyplot
from matplotlib.legend_handler import HandlerTuple
from matplotlib.lines import Line2D

from ulpgate_report.figures import figure_style
from ulpgate_report.pendulum import published
from ulpgate_report.pendulum.drawing import (
    chunk_of,
    dodge,
    ends_text,
    legend_above,
    marker_handle,
    slug,
    step_handles,
    step_style,
    subject,
)
from ulpgate_report.records.pendulum_records import HALF_STEP, OWN_REFERENCE
from ulpgate_report.values import time_step, type_order

FAMILY = "pendulum_t_s"
_CAPTION = (
    "%s: how long the angles correlate with the reference run, t_s, against type: the start of the first "
    "chunk%s whose correlation is below the limit. Filled: limited by rounding; hollow: by time-stepping, where rounding "
    "parts the type no earlier than half the step parts the reference itself.%s%s%s The reference stands at its correlation "
    "with a run of four times its digits.%s"
)
_DIGITS = " Grey: by the digits of the reference, which parts from its run of four times the digits no later."
_BOUND = " With an arrow: no chunk is below the limit to the end of the run, %s, so that t_s is longer."
_HALF = " Dotted, in the colour of its step: until then the reference agrees with its run of half the step."
_PAPER = " Diamonds: published, %s (the end of the chunk, 0.05 s after its start)."


# A face other than that of its step.
_FACES = {"time-stepping": "white", "the reference": "0.8", "not told": "0.5"}


def by_scene_and_variant(rows):
    """{(scene, variant): rows}."""
    found = {}
    for row in rows:
        found.setdefault((row["scene"], row.get("variant", "")), []).append(row)
    return found


def durations(rows, tokens):
    """{(dt, type): row}: against the reference of the most digits; of the reference itself against its RealHP<4>."""
    # A later row takes the place of an earlier one.
    rank = [OWN_REFERENCE, *tokens]
    rank += sorted({row["against"] for row in rows} - set(rank))
    of_types = [row for row in rows if row["against"] != HALF_STEP]
    of_types.sort(key=lambda row: rank.index(row["against"]))
    return {(str(row["dt"]), row["type"]): row for row in of_types}


def _draw_point(axes, x, row, style):
    face = _FACES.get(row["limited_by"], style["color"])
    if row["to_the_end"]:
        # Nothing of the two is known to limit it.
        face = "none"
    axes.plot([x], [row["t_s"]], markerfacecolor=face, linestyle="none", **style)
    if row["to_the_end"]:
        axes.annotate(
            "",
            (x, row["t_s"]),
            xytext=(0, 17),
            textcoords="offset points",
            arrowprops={
                "arrowstyle": "<-",
                "color": style["color"],
                "shrinkA": 0,
                "shrinkB": 3,
                "linewidth": 1.0,
            },
        )


def _draw_published(axes, scene, variant, steps, tokens):
    drawn = False
    for dt in steps:
        for place, token in enumerate(tokens):
            value = published.pendulum_t_s(scene, dt, variant, token)
            if value is not None:
                drawn = True
                axes.plot(
                    [place + dodge(len(steps), len(steps))],
                    [value],
                    marker="D",
                    markersize=4.5,
                    markerfacecolor="white",
                    markeredgecolor="black",
                    linestyle="none",
                    zorder=5,
                )
    return drawn


def _handles(steps, rows, shown, with_paper):
    """The entries of the legend: the steps, and what is drawn of the rest."""
    handles = step_handles(steps)
    handles.append(marker_handle("rounding"))
    handles.append(marker_handle("time-stepping", face="white"))
    if any(row["limited_by"] == "the reference" for row in shown):
        handles.append(marker_handle("digits of the reference", face="0.8"))
    if any(row["limited_by"] == "not told" for row in shown):
        handles.append(marker_handle("not told by what", face="0.5"))
    if any(row["to_the_end"] for row in shown):
        label = "at least (end of the run)"
        point = marker_handle(label, face="none")
        handles.append((point, marker_handle(label, marker=r"$\uparrow$", size=7)))
    if any(row["against"] == HALF_STEP for row in rows):
        handles.append(Line2D([], [], color="0.4", ls=":", label="half the step"))
    if with_paper:
        handles.append(marker_handle("published", "white", "black", "D", 4.5))
    return handles


def _draw(rows, scene, variant, all_tokens):
    found = durations(rows, all_tokens)
    steps = time_step.ordered(row["dt"] for row in rows)
    tokens = type_order.ordered(token for _, token in found)
    figure, axes = pyplot.subplots(figsize=(figure_style.width(5.6), 3.2))
    for index, dt in enumerate(steps):
        style = step_style(index, len(steps))
        for (of_dt, token), row in found.items():
            if of_dt == dt:
                x = tokens.index(token) + dodge(index, len(steps))
                _draw_point(axes, x, row, style)
        for row in rows:
            if row["against"] == HALF_STEP and str(row["dt"]) == dt:
                dotted = {"color": style["color"], "linestyle": ":", "linewidth": 1.0}
                axes.axhline(row["t_s"], zorder=1, **dotted)
    with_paper = _draw_published(axes, scene, variant, steps, tokens)
    axes.set_xticks(range(len(tokens)), tokens, rotation=30, ha="right")
    axes.set_xlim(-0.5, len(tokens) - 0.5)
    # Room for the arrows.
    axes.set_ylim(0, 1.18 * max(row["t_s"] for row in rows) or 1.0)
    axes.set_ylabel("$t_s$ (s)")
    legend_above(
        axes,
        _handles(steps, rows, found.values(), with_paper),
        handletextpad=0.2,
        handler_map={tuple: HandlerTuple(ndivide=None, pad=0)},
    )
    return figure, with_paper


def _caption(pendulum, scene, variant, rows, with_paper):
    curves = [
        curve
        for run in pendulum.runs
        for row in run.correlations
        if row in rows
        for key, curve in run.curves.items()
        if key == (scene, row["type"], row["against"])
    ]
    chunk = chunk_of(curves)
    shown = durations(rows, pendulum.type_tokens).values()
    ends = {}
    for row in shown:
        if row["to_the_end"]:
            ends.setdefault(str(row["dt"]), set()).add(row["t_s"])
    return _CAPTION % (
        subject(scene, "", variant),
        f" of {chunk} s" if chunk else "",
        _DIGITS if any(row["limited_by"] == "the reference" for row in shown) else "",
        _BOUND % ends_text(ends) if ends else "",
        _HALF if any(row["against"] == HALF_STEP for row in rows) else "",
        _PAPER % published.CITATION if with_paper else "",
    )


def draw(pendulum):
    """Yield (name, caption, figure) for each scene and variant that was correlated."""
    for (scene, variant), rows in by_scene_and_variant(pendulum.correlations).items():
        figure, with_paper = _draw(rows, scene, variant, pendulum.type_tokens)
        name = "_".join(filter(None, (FAMILY, scene, slug(variant))))
        yield name, _caption(pendulum, scene, variant, rows, with_paper), figure
