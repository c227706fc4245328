"""Energy of the pendulum: its parts against time, and how far their sum is from its start, for a short and a long type."""
import numpy
from matplotlib import pyplot

from ulpgate_report.figures import figure_style
from ulpgate_report.pendulum.drawing import each_condition, name_of
from ulpgate_report.records import chain_series

FAMILY = "pendulum_energy"
_CAPTION = (
    "%s: parts of the energy against time (left), and how far their sum is from its start (right, logarithmic), with the "
    "mean of the velocities of two half steps and, raw, with one of them. A line at the right shows the largest error of each of "
    "at most %d stretches. Parts that stay 0 are not drawn."
)
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


def _draw_parts(axes, series):
    for index, (name, values) in enumerate(series.parts.items()):
        finite = numpy.isfinite(values)
        axes.plot(
            series.part_times[finite],
            values[finite],
            color=figure_style.colour(index),
            linestyle=_DASHES[index % len(_DASHES)],
            linewidth=0.7,
            label=name.removesuffix("_on_step"),
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


def _draw(lines):
    across = figure_style.side_by_side(2)
    height = 2.1 * len(lines) * 2 / across + 0.4
    figure, grid = pyplot.subplots(
        len(lines) * 2 // across,
        across,
        figsize=(figure_style.width(7.0), height),
        squeeze=False,
        sharex=True,
    )
    figure.subplots_adjust(wspace=0.28, hspace=0.2)
    last = grid[-1]
    grid = grid.reshape(len(lines), 2)
    for (left, right), (token, series) in zip(grid, lines):
        _draw_parts(left, series)
        _draw_errors(right, series)
        left.set_ylabel(f"{token}: energy (J)")
        left.ticklabel_format(axis="y", useMathText=True)
        right.set_ylabel("error of the energy (J)")
    for axes in last:
        axes.set_xlabel("time (s)")
        axes.set_xlim(0, max(float(s.part_times[-1]) for _, s in lines))
    for axes in grid[0]:
        if axes.lines:
            axes.legend(
                loc="lower left",
                # Above the power of ten of the axis.
                bbox_to_anchor=(-0.02, 1.07),
                ncol=figure_style.legend_columns(4),
                columnspacing=0.8,
                handlelength=1.8,
                handletextpad=0.5,
                fontsize=7,
            )
    return figure


def draw(pendulum):
    """Yield (name, caption, figure) for each run whose series have the error of the energy."""
    for run, condition, lines, conditions in each_condition(pendulum, "series"):
        of_type = {t: series for t, series in lines if series.errors and series.parts}
        if of_type:
            tokens = shown_types(list(of_type))
            caption = _CAPTION % (condition.text, chain_series.MOST_ERRORS)
            name = name_of(FAMILY, run, condition, conditions)
            yield name, caption, _draw([(t, of_type[t]) for t in tokens])
