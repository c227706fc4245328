"""Correlation with the reference run against time: a strip for each type, the limit and the duration t_s marked."""
import numpy
from matplotlib import pyplot

from ulpgate_report.figures import figure_style, type_style
from ulpgate_report.pendulum.drawing import chunk_of, name_of, subject
from ulpgate_report.records.pendulum_records import (
    HALF_STEP,
    OWN_REFERENCE,
    condition_of,
)

FAMILY = "pendulum_correlation"
LIMIT = 0.9
_CAPTION = (
    "%s: correlation of the product of the angles between the rods with a reference run, chunk by chunk%s. Broken: the "
    "limit %s. The vertical line is t_s, the start of the first chunk below the limit; from there on the strip is grey. "
    "Strips named RealHP<4> and half the step judge the reference: against a run of four times its digits, and against "
    "one of half its step. At the right: t_s and what limits it. It is rounding that parts a type from the reference; but "
    "where that happens no earlier than half the step parts the reference itself, time-stepping is named: by then the step "
    "has spoilt the reference, and more digits would not bring the angles nearer to the true ones.%s"
)
_DIGITS = (
    " The reference is named where the type parts from it no earlier than the reference from its run of four times the "
    "digits."
)
_STRIP_INCHES = 0.5
_WIDTH_INCHES = 7.0
_OF_REFERENCE = {OWN_REFERENCE: "RealHP<4>", HALF_STEP: "half the step"}


def _label(row):
    against = _OF_REFERENCE.get(row["against"])
    return f"{row['type']},\n{against}" if against else row["type"]


def _edges(curve):
    """The times at which chunks begin, and the end of the last one."""
    times = curve["time_s"]
    # Of a single chunk nobody tells the length; any is as good.
    chunk = times[1] - times[0] if len(times) > 1 else 1.0
    return numpy.append(times, times[-1] + chunk)


def _draw_strip(axes, row, curve, colour, end):
    times = _edges(curve)
    values = numpy.append(curve["correlation"], curve["correlation"][-1])
    if not row["to_the_end"]:
        axes.axvspan(row["t_s"], end, facecolor="0.93", edgecolor="none", zorder=0)
        axes.axvline(row["t_s"], color="black", linewidth=0.9, zorder=3)
    axes.step(times, values, where="post", color=colour, linewidth=0.9)
    axes.axhline(LIMIT, color="0.35", linestyle=(0, (4, 3)), linewidth=0.7, zorder=1)
    axes.set_ylim(-1.1, 1.15)
    axes.set_yticks([-1, 0, 1])
    axes.set_ylabel(_label(row), rotation=0, ha="right", va="center", size=7.5)
    sign = r"\geq" if row["to_the_end"] else "="
    limit = "to the end" if row["to_the_end"] else row["limited_by"]
    axes.text(
        1.01,
        0.5,
        f"$t_s {sign} {row['t_s']:.2f}$ s\n{limit}",
        transform=axes.transAxes,
        size=7,
        va="center",
        linespacing=1.3,
    )


def _draw(rows, tokens):
    end = max(max(_edges(curve)[-1], row["t_s"]) for row, curve in rows)
    height = _STRIP_INCHES * len(rows) + 0.5
    width = figure_style.width(_WIDTH_INCHES) - figure_style.is_one_column()
    figure, strips = pyplot.subplots(
        len(rows),
        1,
        figsize=(width, height),
        sharex=True,
        squeeze=False,
    )
    figure.subplots_adjust(hspace=0.25)
    for axes, (row, curve) in zip(strips[:, 0], rows):
        colour, _ = type_style.line_style(row["type"], tokens)
        if row["against"] in _OF_REFERENCE:
            colour = "black"
        _draw_strip(axes, row, curve, colour, end)
    strips[-1, 0].set_xlim(0, end)
    strips[-1, 0].set_xlabel("time (s)")
    # Left of the types' names, in the middle of the strips.
    figure.text(-0.05, 0.5, "correlation", rotation=90, ha="right", va="center", size=9)
    return figure


def draw(pendulum):
    """Yield (name, caption, figure) for each run and condition that was correlated."""
    tokens = pendulum.type_tokens
    for run in pendulum.runs:
        grouped = {}
        for row in run.correlations:
            curve = run.curves.get((row["scene"], row["type"], row["against"]))
            if curve is not None and curve["time_s"]:
                grouped.setdefault(condition_of(row), []).append((row, curve))
        for condition, rows in grouped.items():
            rows.sort(
                key=lambda pair: (
                    pair[0]["against"] in _OF_REFERENCE,
                    tokens.index(pair[0]["type"]),
                )
            )
            chunk = chunk_of(curve for _, curve in rows)
            by_digits = any(row["limited_by"] == "the reference" for row, _ in rows)
            caption = _CAPTION % (
                subject(condition.scene, condition.dt, condition.variant),
                f" of {chunk} s" if chunk else "",
                LIMIT,
                _DIGITS if by_digits else "",
            )
            name = name_of(FAMILY, run, condition, list(grouped))
            yield name, caption, _draw(rows, tokens)
