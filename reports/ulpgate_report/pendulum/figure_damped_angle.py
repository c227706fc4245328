"""The first angle of a damped pendulum against time, smoothed, a strip for each type; beside it the raw angle."""
import numpy
from matplotlib import pyplot

from ulpgate_report.figures import figure_style, type_style
from ulpgate_report.pendulum import damping, published, savitzky_golay
from ulpgate_report.pendulum.drawing import each_condition, name_of, subject

FAMILY = "pendulum_angle"
# Half the window in s, and the degree of its polynomial: the window is a chunk of the correlation.
HALF_WINDOW_S = 0.025
DEGREE = 3
_CAPTION = (
    "%s: angle between the rods 1 and 2 against time, a strip for each type, smoothed by a Savitzky-Golay filter (window "
    "%.4g s, degree %d; Savitzky, Golay, Anal. Chem. 36, 1964). At the right the angle as it is, around the time at which "
    "the type has parted by %.4g rad, or the same time as in the strip above where it has not parted; the grey band at the left shows "
    "where that is. All panels have one vertical scale, those at the right one horizontal scale too.%s%s"
)
_BEHIND = " Grey lines: the same in %s."
_MOST_POINTS = 4000
# Smoothed angles of two types have parted where they are this far from each other, in rad.
PARTED = 0.2
_RAW_S = 0.4
_STRIP_INCHES, _WIDTH_INCHES = 0.8, 7.0
_GREY = "0.7"


def is_damped(variant):
    """Whether a variant sets a damping other than 0."""
    for one in published.overrides(variant):
        name, _, value = one.partition("=")
        if name == "damping":
            try:
                return float(value) != 0
            except ValueError:
                return True
    return False


def smoothed(series):
    """(times, raw angle, smoothed angle); the window is of one length in s whatever the interval of the records."""
    times, angle = series.angle_times, series.angle
    finite = numpy.isfinite(angle)
    # From where a run broke down there is no angle to fit.
    count = len(angle) if finite.all() else int(numpy.argmin(finite))
    times, angle = times[:count], angle[:count]
    interval = float(numpy.median(numpy.diff(times))) if count > 1 else 1.0
    half = int(round(HALF_WINDOW_S / interval)) if interval > 0 else 0
    return times, angle, savitzky_golay.smooth(angle, half, DEGREE)


def parting_time(line, reference):
    """When the smoothed angle of a type parts from that of the reference, in s; None where it does not."""
    count = min(len(line[2]), len(reference[2]))
    apart = numpy.abs(line[2][:count] - reference[2][:count]) > PARTED
    return float(line[0][numpy.argmax(apart)]) if apart.any() else None


def _plot(axes, times, angle, **style):
    stride = max(1, len(times) // _MOST_POINTS)
    axes.plot(times[::stride], angle[::stride], **style)


def _draw_row(left, right, line, reference, window, colour):
    for axes, column in ((left, 2), (right, 1)):
        if reference is not line:
            grey = {"color": _GREY, "linewidth": 1.0, "zorder": 1}
            _plot(axes, reference[0], reference[column], **grey)
        _plot(axes, line[0], line[column], color=colour, linewidth=0.8, zorder=2)
        axes.set_ylim(-0.2, numpy.pi + 0.2)
        axes.set_yticks([0, numpy.pi / 2, numpy.pi], ["0", "π/2", "π"])
    left.axvspan(*window, facecolor="0.9", edgecolor="none", zorder=0)
    right.set_xlim(*window)
    right.set_yticklabels([])
    right.locator_params(axis="x", nbins=3)


def _draw(lines, tokens, behind):
    found = [(token, smoothed(series)) for token, series in lines]
    reference = dict(found)[behind]
    end = max(float(line[0][-1]) for _, line in found)
    figure, grid = pyplot.subplots(
        len(found),
        2,
        figsize=(figure_style.width(_WIDTH_INCHES), _STRIP_INCHES * len(found) + 0.5),
        squeeze=False,
        width_ratios=(3.4, 1),
    )
    figure.subplots_adjust(hspace=0.5, wspace=0.12)
    window = (0.0, min(_RAW_S, end))
    for (left, right), (token, line) in zip(grid, found):
        parted = parting_time(line, reference)
        if parted is not None:
            start = max(0.0, min(parted - _RAW_S / 2, end - _RAW_S))
            window = (start, min(start + _RAW_S, end))
        colour, _ = type_style.line_style(token, tokens)
        _draw_row(left, right, line, reference, window, colour)
        left.set_xlim(0, end)
        # Far enough from the ticks that nobody reads both as one.
        label = {"rotation": 0, "ha": "right", "va": "center", "size": 7.5}
        left.set_ylabel(token, labelpad=12, **label)
    for left, _ in grid[:-1]:
        left.set_xticklabels([])
    grid[0][0].set_title("smoothed", size=8, pad=4)
    grid[0][1].set_title("raw", size=8, pad=4)
    for axes in grid[-1]:
        axes.set_xlabel("time (s)")
    figure.text(
        -0.05,
        0.5,
        "angle between rods 1 and 2 (rad)",
        rotation=90,
        ha="right",
        va="center",
        size=9,
    )
    return figure


def _has_angle(series):
    angle = series.angle
    return angle is not None and len(angle) > 1 and numpy.isfinite(angle[:2]).all()


def draw(pendulum):
    """Yield (name, caption, figure) for each damped run with angles."""
    for run, condition, lines, conditions in each_condition(pendulum, "series"):
        lines = [(token, series) for token, series in lines if _has_angle(series)]
        if lines and is_damped(condition.variant):
            behind = pendulum.most_precise([token for token, _ in lines])
            said = _BEHIND % behind if len(lines) > 1 else ""
            why = damping.explanation(lines, behind)
            about = (2 * HALF_WINDOW_S, DEGREE, PARTED, said, why)
            begin = subject(condition.scene, condition.dt, condition.variant)
            caption = _CAPTION % (begin, *about)
            name = name_of(FAMILY, run, condition, conditions)
            yield name, caption, _draw(lines, pendulum.type_tokens, behind)
