"""Error against run time of all functions, or of all kernels: a point for each and type, the median of each type."""
import math
import statistics

from matplotlib import pyplot

from ulpgate_report.figures import figure_style, type_style
from ulpgate_report.values import numbers
from ulpgate_report.work_precision import axes, drawing, settings

_CAPTION = (
    "All %ss by type: %s; a point for each %s and type, thin lines join the types of one. Large: the median of a type, "
    "joined along the front of the medians (grey band); named: the largest error of a type above %g u. "
    + drawing.CAPTION_FLOORS
)
_NAMED_FROM_ROUNDOFFS = 16.0
_WIDTH = 6.2
_THIN = {"color": "0.6", "linewidth": 0.4, "alpha": 0.35, "zorder": 1.2}


def _median(values):
    """The middle of the logarithms; 0 where more than half of them are exact."""
    logarithms = sorted(numbers.log10(value) for value in values)
    middle = statistics.median_low(logarithms)
    return 10.0 ** middle if math.isfinite(middle) else 0.0


def medians(rows, pair):
    """{type: (x, y)} of the middle of a type's points."""
    found = {}
    for row in rows:
        at = settings.point(row, pair)
        if at is not None:
            found.setdefault(row["type"], []).append(at)
    return {token: tuple(map(_median, zip(*at))) for token, at in found.items()}


def _draw_lines(plot, rows, pair, scales):
    of_name = {}
    for row in rows:
        of_name.setdefault(row["name"], []).append(row)
    for mine in of_name.values():
        for points in settings.segments(mine, pair):
            plot.plot(*drawing.positions(points, scales), **_THIN)


def _name_worst(plot, measured, rows, pair, scales):
    width, height = (s.high - s.low for s in scales)
    places = []
    for token in dict.fromkeys(row["type"] for row in rows):
        found = [
            (error, row)
            for row in rows
            if row["type"] == token and settings.point(row, pair)
            for error in [axes.value(row, "error")]
            if error is not None
        ]
        error, row = max(found, key=lambda one: one[0], default=(0, None))
        unit = measured.roundoff(token)
        if unit is None or not error > _NAMED_FROM_ROUNDOFFS * unit:
            continue
        x, y = (s.position(v) for s, v in zip(scales, settings.point(row, pair)))
        # Away from the edge: a name at the right one would run into the legend.
        right = x > scales[0].low + 0.8 * width
        taken = {
            side
            for a, b, side in places
            if abs(x - a) < 0.35 * width and abs(y - b) < 0.08 * height
        }
        side = next((one for one in ("bottom", "top") if one not in taken), None)
        if side is None:
            continue
        places.append((x, y, side))
        plot.annotate(
            row["name"],
            (x, y),
            xytext=(-4 if right else 4, -4 if side == "top" else 3),
            textcoords="offset points",
            ha="right" if right else "left",
            va=side,
            size=6.2,
            color="0.2",
            zorder=6,
        )


def _draw_medians(plot, rows, pair, scales, tokens):
    found = medians(rows, pair)
    made = [
        {"type": token, "name": "", **dict.fromkeys(axes.QUANTITIES)} for token in found
    ]
    for row in made:
        for name, value in zip(pair, found[row["type"]]):
            row[axes.QUANTITIES[name].fields[0]] = value
    drawing.draw_front(plot, made, pair, scales)
    for token, at in found.items():
        colour, marker = type_style.line_style(token, tokens)
        style = {"markersize": 8, "markeredgecolor": "black", "markeredgewidth": 0.8}
        x, y = drawing.positions([at], scales)
        plot.plot(x, y, color=colour, marker=marker, zorder=5, **style)


def _draw(measured, rows, pair):
    tokens = measured.type_tokens
    here = [token for token in tokens if any(row["type"] == token for row in rows)]
    scales = drawing.scales_of(rows, pair, drawing.floors_of(measured, here))
    if scales is None:
        return None
    figure, plot = pyplot.subplots(figsize=(figure_style.width(_WIDTH), 4.2))
    drawing.draw_axes(plot, rows, pair, scales)
    drawing.draw_floors(plot, measured, here, pair, scales)
    _draw_lines(plot, rows, pair, scales)
    for token in here:
        mine = [row for row in rows if row["type"] == token]
        points = [at for at in (settings.point(row, pair) for row in mine) if at]
        colour, marker = type_style.line_style(token, tokens)
        style = {"color": colour, "marker": marker, "markersize": 3.4, "alpha": 0.8}
        style.update(linestyle="none", markeredgecolor="white", markeredgewidth=0.2)
        plot.plot(*drawing.positions(points, scales), zorder=3, **style)
        drawing.draw_failed(plot, mine, pair, scales, colour)
    _draw_medians(plot, rows, pair, scales, tokens)
    _name_worst(plot, measured, rows, pair, scales)
    handles = [drawing.type_handle(token, tokens) for token in here]
    drawing.draw_legend(plot, handles, pair)
    return figure


def draw(measured):
    """Yield (name, caption, figure) of the functions and of the kernels, for each pair of axes."""
    for kind in settings.OF_SUBJECTS:
        rows = measured.of_kind(kind)
        for pair, suffix, said in settings.drawn_pairs(measured, rows):
            about = (kind, drawing.words_of(pair), kind, _NAMED_FROM_ROUNDOFFS)
            figure = _draw(measured, rows, pair)
            caption = _CAPTION % about + drawing.failures_of(rows, pair) + said
            yield drawing.name_of(kind, suffix), caption, figure
