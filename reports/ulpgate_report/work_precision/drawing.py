"""What the figures of error against run time share: file names, scales, floors of the types, fronts, failed settings."""
import re

from matplotlib.lines import Line2D

from ulpgate_report.figures import figure_style, type_style
from ulpgate_report.work_precision import axes, settings

FAMILY = "work_precision"
_FLOOR = {"linestyle": (0, (5, 3)), "linewidth": 0.7, "zorder": 1}
# A floor that is so far below the smallest error is named at the edge.
FAR = 1e-6
_FRONT = {"color": "0.82", "linewidth": 5, "solid_capstyle": "round", "zorder": 1.5}
CAPTION_FLOORS = "Broken lines: the roundoff u = 2^-p of the types. Light bands from edge to edge: a stretch of an axis without a mark, cut out."


def name_of(*parts):
    """The name of a figure's files."""
    plain = (re.sub(r"[^A-Za-z0-9_.+-]+", "-", part).strip("-") for part in parts)
    return "_".join((FAMILY, *filter(None, plain)))


def words_of(pair):
    """`error on x, time on y` for captions."""
    x, y = (axes.QUANTITIES[name].title for name in pair)
    return f"{x} on x, {y} on y, both logarithmic"


def failures_of(rows, pair):
    """A sentence for captions about the settings that failed."""
    failed = sum(map(settings.has_failed, rows))
    if not failed:
        return ""
    said = f" {failed:,} of {len(rows):,} settings failed: there the curves break"
    where = (
        "; crosses in 'failed' say at which cost" if failed_points(rows, pair) else ""
    )
    return f"{said}{where}."


def has_error_on(pair, index):
    """Whether the first or the second axis is that of an error."""
    return axes.QUANTITIES[pair[index]].is_error


def failed_points(rows, pair):
    """The values of the other quantity of settings whose error failed, where one of the two is an error."""
    errors = [name for name in pair if axes.QUANTITIES[name].is_error]
    if len(errors) != 1:
        return []
    other = pair[1 - pair.index(errors[0])]
    found = (axes.value(row, other) for row in rows if settings.has_failed(row))
    return [value for value in found if value]


def scales_of(rows, pair, floors):
    """The two scales that show all points of some settings, and floors near them; None where there is no point."""
    points = [at for at in (settings.point(row, pair) for row in rows) if at]
    if not points:
        return None
    failed = failed_points(rows, pair)
    found = []
    for index, name in enumerate(pair):
        values = [at[index] for at in points]
        is_error = axes.QUANTITIES[name].is_error
        if not is_error:
            values += failed
        near = _near(values, floors) if is_error else ()
        found.append(axes.scale_of(name, values, near, is_error and bool(failed)))
    return found


def _near(values, floors):
    """The floors that points come near to: room for others would be empty."""
    lowest = min((value for value in values if value > 0), default=1.0)
    return [unit for unit in floors if unit > lowest * FAR]


def positions(points, scales):
    """Where points are drawn: ([x], [y])."""
    return [[s.position(at[i]) for at in points] for i, s in enumerate(scales)]


def draw_axes(plot, rows, pair, scales, most=8):
    """Limits, ticks and titles of both axes of some settings."""
    of_scenes = bool(rows) and all(row["subject"] == "scene" for row in rows)
    for axis, name, scale in zip((plot.xaxis, plot.yaxis), pair, scales):
        # A problem has its own unit of time.
        unit = "s" if name == "dt" and of_scenes else None
        axes.label(axis, name, scale, most, unit)


def draw_failed(plot, rows, pair, scales, style):
    """Crosses in the column of what failed."""
    values = failed_points(rows, pair)
    if not values:
        return
    index = 0 if axes.QUANTITIES[pair[0]].is_error else 1
    at = [None, None]
    at[index] = [scales[index].failed] * len(values)
    at[1 - index] = [scales[1 - index].position(value) for value in values]
    cross = {"marker": "x", "markersize": 3, "markeredgewidth": 0.8, "alpha": 0.7}
    plot.plot(*at, linestyle="none", color=style, zorder=2, **cross)


def draw_front(plot, rows, pair, scales):
    """A broad grey band through the front of some settings; returns its settings."""
    best = settings.front(rows, pair)
    points = [settings.point(row, pair) for row in best]
    if len(points) > 1:
        plot.plot(*positions(points, scales), **_FRONT)
    return best


def floors_of(measured, tokens):
    """{roundoff: types that have it}, the largest first."""
    found = {}
    for token in tokens:
        unit = measured.roundoff(token)
        if unit is not None:
            found.setdefault(unit, []).append(token)
    return dict(sorted(found.items(), reverse=True))


def draw_floors(plot, measured, tokens, pair, scales, names=True):
    """Broken lines at the roundoff of each type, its name at the end of the line, on every axis of an error."""
    for index, name in enumerate(pair):
        if not axes.QUANTITIES[name].is_error:
            continue
        beyond = []
        for unit, of_unit in floors_of(measured, tokens).items():
            if not scales[index].shows(unit):
                beyond += of_unit
                continue
            at = scales[index].position(unit)
            colour = type_style.line_style(of_unit[0], tokens)[0] if names else "0.3"
            line = plot.axvline if index == 0 else plot.axhline
            line(at, color=colour, **_FLOOR)
            if names:
                _name_floor(plot, index, at, ", ".join(of_unit), colour)
        if beyond and names:
            _name_beyond(plot, index, beyond, pair)


def _name_beyond(plot, index, tokens, pair):
    """The types whose floors lie far beyond the lower end of an axis: below its title."""
    side = "left" if index == 0 else "down"
    below = 8 * index if has_error_on(pair, 0) else 0
    plot.annotate(
        f"further {side}, not shown: u of {', '.join(tokens)}",
        (0.5, 0),
        xycoords="axes fraction",
        xytext=(0, -31 - below),
        textcoords="offset points",
        size=6.3,
        color="0.3",
        ha="center",
        va="top",
    )


def _name_floor(plot, index, at, text, colour):
    style = {"size": 6.3, "color": colour, "clip_on": False}
    if index == 0:
        where = {
            "rotation": 38,
            "ha": "left",
            "va": "bottom",
            "rotation_mode": "anchor",
        }
        plot.annotate(
            text,
            (at, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0, 3),
            textcoords="offset points",
            **where,
            **style,
        )
    else:
        plot.annotate(
            f" {text}",
            (1.0, at),
            xycoords=("axes fraction", "data"),
            va="center",
            **style,
        )


def type_handle(token, tokens, label=None, linestyle="none"):
    """An entry of a legend: a type."""
    colour, marker = type_style.line_style(token, tokens)
    return Line2D(
        [],
        [],
        color=colour,
        marker=marker,
        markersize=4,
        linestyle=linestyle,
        linewidth=1.0,
        label=label or token,
    )


def draw_legend(plot, handles, pair):
    """A legend right of the plot, and of the names of floors there; the front's entry comes last."""
    front = Line2D([], [], label="Pareto front", **_FRONT)
    if figure_style.is_one_column():
        plot.legend(
            handles=[*handles, front],
            loc="lower left",
            bbox_to_anchor=(-0.1, 1.0 if not has_error_on(pair, 0) else 1.14),
            ncol=3,
            columnspacing=0.8,
            handlelength=1.8,
            fontsize=6.5,
        )
        return
    plot.legend(
        handles=[*handles, front],
        loc="center left",
        bbox_to_anchor=(1.2 if has_error_on(pair, 1) else 1.02, 0.5),
        handlelength=2.2,
        labelspacing=0.6,
    )
