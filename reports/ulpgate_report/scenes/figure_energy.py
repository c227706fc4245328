"""The energy account of each scene: its parts against time, and how far their sum is from its start."""
import math

from matplotlib import pyplot

from ulpgate_report.figures import figure_style
from ulpgate_report.figures import type_style
from ulpgate_report.records import energy_account

FAMILY = "energy"
_CAPTION = (
    "Scene %s: parts of the energy account against time in %s (left); distance of their sum from its value at the start, "
    "a line for each type (right, logarithmic). Parts that stay 0, and instants "
    "without any distance, are not drawn."
)
_KINETIC_ONLY = (
    "Scene %s: kinetic energy against time, a line for each type; no account was kept."
)
_DASHES = ("-", (0, (5, 2)), (0, (1.5, 1.5)), (0, (6, 2, 1.5, 2)))
_SHOWN_TYPE = "double"
_MOST_POINTS = 4000


def _thinned(times, values):
    """At most about _MOST_POINTS: the largest of each stretch, so that no peak is lost."""
    stride = -(-len(times) // _MOST_POINTS)
    if stride <= 1:
        return times, values
    kept = [
        max(range(i, min(i + stride, len(values))), key=lambda j: abs(values[j]))
        for i in range(0, len(values), stride)
    ]
    return [times[i] for i in kept], [values[i] for i in kept]


def _plot(axes, times, values, least=-math.inf, **style):
    """Draw what is finite and above `least`; whether there was anything."""
    floats = map(float, values)
    pairs = [(t, v) for t, v in zip(times, floats) if math.isfinite(v) and v > least]
    if pairs:
        axes.plot(*_thinned([t for t, _ in pairs], [v for _, v in pairs]), **style)
    return bool(pairs)


def _legend(axes, columns):
    axes.legend(
        loc="lower left",
        # Above the power of ten of the axis.
        bbox_to_anchor=(-0.1, 1.05),
        ncol=columns,
        fontsize=6.5,
        columnspacing=0.8,
        handlelength=2.2,
        handletextpad=0.4,
    )


def _draw_parts(axes, columns):
    shown = {
        name: values
        for name, values in energy_account.parts(columns).items()
        if any(values)
    }
    for index, (name, values) in enumerate(shown.items()):
        _plot(
            axes,
            columns["time_s"],
            values,
            color=figure_style.colour(index),
            linestyle=_DASHES[index % len(_DASHES)],
            label=name.removesuffix("_on_step"),
        )
    total = columns.get("sum_J", columns.get("sum"))
    if total is not None:
        style = {"color": "0.45", "linewidth": 1.6, "label": "sum", "zorder": 1}
        _plot(axes, columns["time_s"], total, **style)
    axes.ticklabel_format(axis="y", useMathText=True)
    axes.set_xlabel("time (s)")
    axes.set_ylabel("energy (J)")
    _legend(axes, 3)


def _draw_types(axes, lines, tokens, label, log):
    drawn = 0
    for token, (times, values) in lines:
        colour, marker = type_style.line_style(token, tokens)
        style = {"color": colour, "marker": marker, "markersize": 3, "label": token}
        style["markevery"] = (tokens.index(token) * 0.02, 0.15)
        drawn += _plot(axes, times, values, 0.0 if log else -math.inf, **style)
    if log and drawn:
        figure_style.log_axis(axes.yaxis)
    axes.set_xlabel("time (s)")
    axes.set_ylabel(label)
    if drawn:
        _legend(axes, 3)


def draw(scenes):
    """Yield (name, caption, figure) for each scene with a series."""
    tokens = scenes.type_tokens
    for scene in scenes.names:
        series = [(t, c) for t, c in scenes.of(scenes.series, scene) if c["step"]]
        if not series:
            continue
        kept = [(token, energy_account.balance(columns)) for token, columns in series]
        kept = [(token, pair) for token, pair in kept if pair is not None]
        if kept:
            with_account = [token for token, _ in kept]
            shown = _SHOWN_TYPE if _SHOWN_TYPE in with_account else with_account[0]
            figure, (left, right) = figure_style.panels(2, 7.0, 3.2)
            figure.subplots_adjust(wspace=0.32)
            _draw_parts(left, dict(series)[shown])
            _draw_types(right, kept, tokens, "|sum - sum at the start| (J)", True)
            caption = _CAPTION % (scene, shown)
        else:
            figure, axes = pyplot.subplots(figsize=(figure_style.width(5.0), 3.2))
            held = [
                (t, c, next(n for n in energy_account.KINETIC if n in c))
                for t, c in series
            ]
            lines = [(t, (c["time_s"], c[name])) for t, c, name in held]
            _draw_types(axes, lines, tokens, "kinetic energy (J)", False)
            caption = _KINETIC_ONLY % scene
        yield f"{FAMILY}_{scene}", caption, figure
