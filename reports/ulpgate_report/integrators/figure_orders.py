"""Error against step of each integrator, a panel for each type: the orders as slopes, the rounding floor of the type."""
import math

from matplotlib import pyplot
from matplotlib.lines import Line2D

from ulpgate_report.figures import figure_style
from ulpgate_report.integrators import orders
from ulpgate_report.values import type_order

FAMILY = "orders"
_CAPTION = (
    "Problem %s: global error against step, a line for each integrator, a panel for each type; both axes logarithmic. "
    "Dotted: slopes of the orders in theory, the number beside. Broken: the roundoff u = 2^-p of the type with p "
    "significand bits. In the legend: the order in theory, in brackets, and as measured in %s."
)
_PANEL_INCHES = 3.3
# Of the width, how far from the left edge a number stands; of the height, how much higher every second one at the bottom.
_FROM_LEFT, _STAGGER = 0.14, 0.045
# What a number takes, as shares of a panel.
_NUMBER_WIDTH, _NUMBER_HEIGHT = 0.055, 0.05
_DASHES = ("-", (0, (4, 1.5)), (0, (1.5, 1.2)), (0, (5, 1.5, 1.5, 1.5)))


def _style(index):
    colours = 7
    return {
        "color": figure_style.colour(index),
        "marker": figure_style.marker(index),
        "linestyle": _DASHES[index // colours % len(_DASHES)],
        "markersize": 3.2,
    }


def anchor(found):
    """The point (log10 dt, log10 error) that a slope is drawn through: the middle of those before the floor."""
    points = found.clear or found.points[:1]
    dt, error = points[len(points) // 2]
    return math.log10(dt), math.log10(error)


def _draw_slope(axes, found, limits, taken):
    """A line of the order in theory over the panel, its number on it: at the bottom, else near the left edge.

    At the bottom, below the floor, there is no curve; the numbers stand at two heights, since the steep lines are close, and
    one that would lie on another is left out: `taken` are the places of those there are.
    """
    (left, right), (bottom, top) = limits
    x, y = anchor(found)

    def height(at):
        return y + found.order * (at - x)

    low = max(left, x - (y - bottom) / found.order)
    high = min(right, x + (top - y) / found.order)
    style = {"color": "0.45", "linestyle": ":", "linewidth": 0.7, "zorder": 1}
    axes.plot([low, high], [height(low), height(high)], **style)
    heights = [
        low + (0.2 + n) * _STAGGER * (top - bottom) / found.order for n in (0, 1)
    ]
    if height(left) > bottom:
        heights = [left + _FROM_LEFT * (right - left)]
    # As shares of the panel, what two digits take.
    places = [
        ((at - left) / (right - left), (height(at) - bottom) / (top - bottom))
        for at in heights
    ]
    free = [
        (at, place)
        for at, place in zip(heights, places)
        if all(
            abs(place[0] - x) > _NUMBER_WIDTH or abs(place[1] - y) > _NUMBER_HEIGHT
            for x, y in taken
        )
    ]
    if not free:
        return
    at, place = free[0]
    taken.append(place)
    axes.text(
        at,
        height(at),
        f"{found.order:g}",
        size=6.5,
        ha="center",
        va="center" if height(left) > bottom else "bottom",
        zorder=3,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.4, "alpha": 0.85},
    )


def _limits(convergences, unit):
    xs = [math.log10(dt) for one in convergences for dt, _ in one.points]
    ys = [math.log10(error) for one in convergences for _, error in one.points]
    if unit is not None:
        ys.append(math.log10(unit))
    margin = 0.05 * (max(ys) - min(ys)) + 0.3
    # Below, room for the numbers of the slopes.
    return (min(xs) - 0.15, max(xs) + 0.15), (min(ys) - 2 * margin, max(ys) + margin)


def _ticks(axis, low, high):
    step = figure_style.log10_tick_step(high - low, 7)
    first = math.ceil(low / step)
    ticks = [step * n for n in range(first, math.floor(high / step) + 1)]
    axis.set_ticks(ticks, [figure_style.power_of_ten(n) for n in ticks])


def _draw_panel(axes, convergences, unit, names):
    limits = _limits(convergences, unit)
    drawn, taken = set(), []
    for one in convergences:
        points = [(math.log10(dt), math.log10(error)) for dt, error in one.points]
        style = _style(names.index(one.integrator))
        axes.plot(*zip(*points), linewidth=0.8, zorder=2, **style)
        if one.order not in drawn:
            _draw_slope(axes, one, limits, taken)
            drawn.add(one.order)
    if unit is not None:
        y = math.log10(unit)
        axes.axhline(y, color="0.3", linestyle=(0, (5, 3)), linewidth=0.8, zorder=1)
    axes.set(xlim=limits[0], ylim=limits[1])
    _ticks(axes.xaxis, *limits[0])
    _ticks(axes.yaxis, *limits[1])
    axes.set_title(convergences[0].type, size=8, pad=3)


def _handles(of_type, names, longest):
    """A line of the legend for each integrator, with its order in theory and as measured in the longest type."""
    measured = {one.integrator: one for one in of_type[longest]}
    order = {one.integrator: one.order for all in of_type.values() for one in all}
    handles = []
    for index, name in enumerate(names):
        one = measured.get(name)
        found = "-" if one is None or one.measured is None else f"{one.measured:.2f}"
        label = f"{name} ({order[name]:g}): {found}"
        handles.append(Line2D([], [], linewidth=0.8, label=label, **_style(index)))
    return handles


def _draw(of_type, bits, longest):
    found = [one for convergences in of_type.values() for one in convergences]
    names = list(
        dict.fromkeys(c.integrator for c in sorted(found, key=lambda c: c.order))
    )
    columns = min(figure_style.side_by_side(3), len(of_type))
    rows = math.ceil(len(of_type) / columns)
    figure, grid = pyplot.subplots(
        rows,
        columns,
        figsize=(figure_style.width(min(7.2, _PANEL_INCHES * columns)), 3.0 * rows),
        squeeze=False,
    )
    figure.subplots_adjust(wspace=0.3, hspace=0.35)
    for axes, (token, convergences) in zip(grid.flat, of_type.items()):
        unit = orders.unit_roundoff(token, bits)
        _draw_panel(axes, convergences, unit, names)
    for axes in list(grid.flat)[len(of_type) :]:
        axes.remove()
    for axes in grid[-1]:
        axes.set_xlabel("step (dimensionless time)")
    for axes in grid[:, 0]:
        axes.set_ylabel("global error (dimensionless)")
    figure.legend(
        handles=_handles(of_type, names, longest),
        loc="upper center",
        bbox_to_anchor=(0.5, -0.03 / rows),
        ncol=2 if figure_style.is_one_column() else 3,
        columnspacing=1.2,
        handlelength=2.6,
        fontsize=6.8,
    )
    return figure


def draw(pendulum):
    """Yield (name, caption, figure) for each problem that integrators were tried on."""
    found = [one for one in orders.convergences(pendulum.orders) if one.points]
    for problem in dict.fromkeys(one.problem for one in found):
        mine = [one for one in found if one.problem == problem]
        tokens = type_order.ordered(one.type for one in mine)
        of_type = {t: [one for one in mine if one.type == t] for t in tokens}
        longest = pendulum.most_precise(tokens)
        figure = _draw(of_type, pendulum.bits, longest)
        yield f"{FAMILY}_{problem}", _CAPTION % (problem, longest), figure
