"""How long each type stays true, at each time step: t_s against type, lower bounds as arrows, published values beside."""
from matplotlib import pyplot
from matplotlib.lines import Line2D

from ulpgate_report.figures import figure_style
from ulpgate_report.pendulum import published
from ulpgate_report.pendulum.drawing import (
    dodge,
    marker_handle,
    slug,
    step_handles,
    step_style,
)
from ulpgate_report.records.pendulum_records import HALF_STEP, OWN_REFERENCE
from ulpgate_report.values import time_step, type_order

FAMILY = "pendulum_t_s"
_CAPTION = (
    "%s: how long the angles correlate with the reference run, t_s, against type. Filled: limited by rounding; hollow: by "
    "time-stepping. An arrow, filled too: true to the end of the run, so that t_s is longer. The reference stands at its correlation "
    "with a run of four times its digits. Dotted, in the colour of its step: until then the reference agrees with its run "
    "of half the step.%s"
)
_PAPER = " Diamonds: published, %s (the end of the chunk, 0.05 s after its start)."


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
    hollow = row["limited_by"] == "time-stepping"
    face = "white" if hollow else style["color"]
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
    handles = step_handles(steps)
    handles.append(marker_handle("rounding"))
    handles.append(marker_handle("time-stepping", face="white"))
    if any(row["against"] == HALF_STEP for row in rows):
        handles.append(Line2D([], [], color="0.4", ls=":", label="half the step"))
    with_paper = _draw_published(axes, scene, variant, steps, tokens)
    if with_paper:
        handles.append(marker_handle("published", "white", "black", "D", 4.5))
    axes.set_xticks(range(len(tokens)), tokens, rotation=30, ha="right")
    axes.set_xlim(-0.5, len(tokens) - 0.5)
    # Room for the arrows.
    axes.set_ylim(0, 1.18 * max(row["t_s"] for row in rows) or 1.0)
    axes.set_ylabel("$t_s$ (s)")
    axes.legend(
        handles=handles,
        loc="lower left",
        bbox_to_anchor=(0, 1.0),
        ncol=figure_style.legend_columns(4),
        columnspacing=1.0,
        handletextpad=0.2,
    )
    return figure, with_paper


def draw(pendulum):
    """Yield (name, caption, figure) for each scene and variant that was correlated."""
    for (scene, variant), rows in by_scene_and_variant(pendulum.correlations).items():
        figure, with_paper = _draw(rows, scene, variant, pendulum.type_tokens)
        name = "_".join(filter(None, (FAMILY, scene, slug(variant))))
        paper = _PAPER % published.CITATION if with_paper else ""
        about = ", ".join(filter(None, (scene, variant)))
        yield name, _CAPTION % (about, paper), figure
