"""Energy of the pendulum: its parts against time, and how far their sum is from its start, for a short and a long type."""
import numpy
from matplotlib import pyplot

from ulpgate_report.figures import figure_style
from ulpgate_report.pendulum import damping
from ulpgate_report.pendulum.drawing import (
    each_condition,
    legend_above,
    name_of,
    subject,
)
from ulpgate_report.records import chain_series

FAMILY = "pendulum_energy"
_CAPTION = (
    "%s: parts of the energy against time (left), and how far their sum is from its start (right, logarithmic), with the "
    "mean of the velocities of two half steps and, raw, with one of them. A line at the right shows the largest error of each of "
    "at most %d stretches. %s%s"
)
_ZERO = "Parts that are exactly 0 all the time are not drawn."
_SMALL = "Not drawn are parts that are exactly 0 all the time, and those too small to be seen, which are in the sum: %s."
# A part this far below the largest one is thinner than the line at 0 that it would be.
_VISIBLE = 1e-2
_ROW_INCHES = 1.72
_SHOWN_TYPES = ("float", "float128")
_DASHES = ("-", (0, (5, 2)), (0, (1.5, 1.5)), (0, (6, 2, 1.5, 2)))
_ERRORS = (
    (chain_series.RAW, "raw", "#D55E00", (0, (4, 1.5))),
    (chain_series.AVERAGED, "averaged", "#0072B2", "-"),
)


def shown_types(tokens):
    """The published two where both are there, else the first and the last."""
    if all(token in tokens for token in _SHOWN_TYPES):
        return list(_SHOWN_TYPES)
    return list(dict.fromkeys([tokens[0], tokens[-1]]))


def _largest(values):
    return float(numpy.abs(values[numpy.isfinite(values)]).max(initial=0.0))


def shown_parts(lines):
    """([names of parts that are drawn], {name of one that is not: [(type, its largest value)]}) of some runs."""
    shown, small = [], {}
    for token, series in lines:
        largest = {name: _largest(values) for name, values in series.parts.items()}
        limit = _VISIBLE * max(largest.values(), default=0.0)
        for name, value in largest.items():
            if value > limit:
                shown += [name] if name not in shown else []
            else:
                small.setdefault(name, []).append((token, value))
    return shown, {name: found for name, found in small.items() if name not in shown}


def _unseen(small):
    """What a caption says of the parts that are not drawn."""
    if not small:
        return _ZERO
    texts = []
    for name, found in small.items():
        most = ", ".join(f"{value:.2g} J in {token}" for token, value in found)
        texts.append(f"{_short(name)} (at most {most})")
    return _SMALL % ", ".join(texts)


def _short(name):
    return name.removesuffix("_on_step")


def _draw_parts(axes, series, names):
    for index, name in enumerate(names):
        # A part has one colour in all runs.
        if name not in series.parts:
            continue
        values = series.parts[name]
        finite = numpy.isfinite(values)
        axes.plot(
            series.part_times[finite],
            values[finite],
            color=figure_style.colour(index),
            linestyle=_DASHES[index % len(_DASHES)],
            linewidth=0.7,
            label=_short(name),
        )
    if series.parts:
        total = numpy.sum(list(series.parts.values()), axis=0)
        finite = numpy.isfinite(total)
        style = {"color": "0.35", "linewidth": 1.4, "label": "sum", "zorder": 3}
        axes.plot(series.part_times[finite], total[finite], **style)


def _draw_errors(axes, series):
    drawn = False
    for column, label, colour, dashes in _ERRORS:
        times, errors = series.errors.get(column, ((), ()))
        above = numpy.array(errors) > 0
        if above.any():
            drawn = True
            style = {"color": colour, "linestyle": dashes, "linewidth": 0.8}
            axes.plot(
                numpy.array(times)[above],
                numpy.array(errors)[above],
                label=label,
                **style,
            )
    if drawn:
        figure_style.log_axis(axes.yaxis)
    return drawn


def _draw(lines, names):
    across = figure_style.side_by_side(2)
    height = _ROW_INCHES * len(lines) * 2 / across + 0.4
    figure, grid = pyplot.subplots(
        len(lines) * 2 // across,
        across,
        figsize=(figure_style.width(7.0), height),
        squeeze=False,
        sharex=True,
    )
    figure.subplots_adjust(wspace=0.36, hspace=0.2)
    last = grid[-1]
    grid = grid.reshape(len(lines), 2)
    for (left, right), (token, series) in zip(grid, lines):
        _draw_parts(left, series, names)
        _draw_errors(right, series)
        left.set_ylabel(f"{token}: energy (J)")
        left.ticklabel_format(axis="y", useMathText=True)
        right.set_ylabel("error of the energy (J)")
    for axes in last:
        axes.set_xlabel("time (s)")
        axes.set_xlim(0, max(float(s.part_times[-1]) for _, s in lines))
    for column in grid.T:
        # What one of the rows has alone is in the legend too.
        handles = {n.get_label(): n for axes in reversed(column) for n in axes.lines}
        if handles:
            # Above the power of ten of the axis.
            style = {"handlelength": 1.8, "handletextpad": 0.5, "fontsize": 7}
            legend_above(column[0], _in_order(handles, names), -0.02, 1.07, **style)
    return figure


def _in_order(handles, names):
    """The lines of a legend by their labels: parts as they are drawn, the sum, the errors."""
    order = [*map(_short, names), "sum", *(label for _, label, *_ in _ERRORS)]
    return [handles[label] for label in order if label in handles]


def draw(pendulum):
    """Yield (name, caption, figure) for each run whose series have the error of the energy."""
    for run, condition, lines, conditions in each_condition(pendulum, "series"):
        of_type = {t: series for t, series in lines if series.errors and series.parts}
        if of_type:
            tokens = shown_types(list(of_type))
            lines = [(token, of_type[token]) for token in tokens]
            names, small = shown_parts(lines)
            caption = _CAPTION % (
                subject(condition.scene, condition.dt, condition.variant),
                chain_series.MOST_ERRORS,
                _unseen(small),
                damping.explanation(lines, pendulum.most_precise(tokens)),
            )
            name = name_of(FAMILY, run, condition, conditions)
            yield name, caption, _draw(lines, names)
