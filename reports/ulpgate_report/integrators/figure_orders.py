"""Error against step of each integrator: the orders as slopes, the rounding floor of the type.

Of several types a panel for each; of one a panel for each range of orders, which as many curves need to be told apart.
"""
import math

from matplotlib import pyplot
from matplotlib.lines import Line2D

from ulpgate_report.figures import figure_style
from ulpgate_report.integrators import orders, slopes, wording
from ulpgate_report.values import type_order

FAMILY = "orders"
_CAPTION = (
    "Problem %s%s: global error against step, a line for each integrator%s; both axes logarithmic. %sDotted: slopes of the "
    "orders in theory, each with its number; one without a place for it is left out. Broken: the roundoff u = 2^-p of the type with p significand bits. In the "
    "legend: the order in theory, in brackets, and as measured%s; -: not measured, for want of two errors above %d u. "
)
_PANEL_INCHES = 3.3
# So many curves are told apart in one panel; more get panels up to each of these orders, and one for what is above.
_FEW = 8
_LAST_ORDERS = (3, 5, 8, math.inf)
# What a power of ten takes below an axis.
_TICK_INCHES = 0.36
_LEGEND_SIZE = 6.6
_DASHES = ("-", (0, (4, 1.5)), (0, (1.5, 1.2)), (0, (5, 1.5, 1.5, 1.5)))
# In inches, of panels of ranges: left of the first and between two, above, below, and a line of the legend.
_LEFT, _BETWEEN, _ABOVE, _BELOW, _LINE = 0.6, 0.6, 0.25, 0.45, 0.112
# What they and their legends come to at most in one column, and how high each of them is where there is room.
_MOST_INCHES, _HEIGHT_INCHES, _LEAST_INCHES = 9.2, 2.5, 0.9


def _style(index, is_under=False):
    """What tells a curve; of one that lies under another the markers stand out."""
    style = {
        "color": figure_style.colour(index),
        "marker": figure_style.marker(index),
        "linestyle": _DASHES[index // 7 % len(_DASHES)],
        "markersize": 3.0,
        "linewidth": 0.8,
    }
    if is_under:
        style |= {"markersize": 5.5, "markerfacecolor": "none", "markeredgewidth": 0.7}
    return style


def _limits(convergences, unit):
    points = [point for one in convergences for point in one.drawn]
    xs = [math.log10(dt) for dt, _ in points]
    ys = [math.log10(error) for _, error in points]
    if unit is not None:
        ys.append(math.log10(unit))
    margin = 0.05 * (max(ys) - min(ys)) + 0.3
    aside = 0.05 * (max(xs) - min(xs)) + 0.05
    # Below and at the right, room for the numbers of the slopes.
    return (min(xs) - aside, max(xs) + 2 * aside), (
        min(ys) - 2.4 * margin,
        max(ys) + margin,
    )


def _ticks(axis, low, high, most):
    """Powers of ten; of fewer than two decades their multiples too."""
    step = figure_style.log10_tick_step(high - low, most)
    first = math.ceil(low / step)
    ticks = [step * n for n in range(first, math.floor(high / step) + 1)]
    if high - low < 2:
        decades = range(math.floor(low), math.ceil(high))
        every = [n * 10.0**ten for ten in decades for n in (1, 2, 5)]
        shown = [value for value in every if low <= math.log10(value) <= high]
        axis.set_ticks([math.log10(v) for v in shown], [f"{v:g}" for v in shown])
    else:
        axis.set_ticks(ticks, [figure_style.power_of_ten(n) for n in ticks])


def _slopes(convergences):
    """Of each order the first that has an error clear of the roundings: no slope says anything of the others."""
    found = {}
    for one in convergences:
        if one.clear:
            found.setdefault(one.order, one)
    return list(found.values())


def _draw_panel(axes, convergences, unit, styles, title):
    limits = _limits(convergences, unit)
    box, (width, height) = axes.get_position(), axes.figure.get_size_inches()
    inches = (box.width * width, box.height * height)
    panel = slopes.Panel(axes, limits, inches)
    for one in convergences:
        points = [(math.log10(dt), math.log10(error)) for dt, error in one.drawn]
        panel.keep_clear(points)
        label = one.integrator
        axes.plot(*zip(*points), zorder=2, label=label, **styles[label])
    if unit is not None:
        y = math.log10(unit)
        axes.axhline(y, color="0.3", linestyle=(0, (5, 3)), linewidth=0.8, zorder=1)
        panel.keep_clear([(limits[0][0], y), (limits[0][1], y)])
        beside = axes.get_yaxis_transform()
        axes.text(1.01, y, "u", size=slopes.SIZE, va="center", transform=beside)
    panel.draw(_slopes(convergences))
    axes.set(xlim=limits[0], ylim=limits[1])
    _ticks(axes.xaxis, *limits[0], int(inches[0] / _TICK_INCHES))
    _ticks(axes.yaxis, *limits[1], 7)
    axes.set_title(title, size=8, pad=3)


def _styles(of_type):
    """{integrator: style}, by order; what lies under another in any of the types has the markers for it."""
    found = [one for convergences in of_type.values() for one in convergences]
    found.sort(key=lambda c: c.order)
    under = {
        one.integrator
        for convergences in of_type.values()
        for group in wording.coinciding(convergences)
        for one in group[:-1]
    }
    names = dict.fromkeys(c.integrator for c in found)
    return {name: _style(i, name in under) for i, name in enumerate(names)}


def _handles(styles, of_type, longest):
    """A line of the legend for each integrator, with its order in theory and as measured in the longest type."""
    measured = {one.integrator: one.measured for one in of_type[longest]}
    order = {one.integrator: one.order for all in of_type.values() for one in all}
    handles = []
    for name, style in styles.items():
        found = measured.get(name)
        told = "-" if found is None else f"{found:.2f}"
        label = f"{name} ({order[name]:g}): {told}"
        handles.append(Line2D([], [], label=label, **style))
    return handles


def _draw_types(of_type, bits, longest):
    """A panel for each type and a legend for all."""
    columns = min(figure_style.side_by_side(3), len(of_type))
    rows = math.ceil(len(of_type) / columns)
    figure, grid = pyplot.subplots(
        rows,
        columns,
        figsize=(figure_style.width(min(7.2, _PANEL_INCHES * columns)), 3.0 * rows),
        squeeze=False,
    )
    figure.subplots_adjust(wspace=0.38, hspace=0.35)
    styles = _styles(of_type)
    for axes, (token, convergences) in zip(grid.flat, of_type.items()):
        unit = orders.unit_roundoff(token, bits)
        _draw_panel(axes, convergences, unit, styles, token)
    for axes in list(grid.flat)[len(of_type) :]:
        axes.remove()
    for axes in grid[-1]:
        axes.set_xlabel("step (dimensionless time)")
    for axes in grid[:, 0]:
        axes.set_ylabel("global error (dimensionless)")
    figure.legend(
        handles=_handles(styles, of_type, longest),
        loc="upper center",
        bbox_to_anchor=(0.5, -0.03 / rows),
        ncol=2 if figure_style.is_one_column() else 3,
        columnspacing=1.2,
        handlelength=2.6,
        fontsize=_LEGEND_SIZE,
    )
    return figure


def _ranges(convergences):
    """The convergences by ranges of their orders; all in one where they are few."""
    if len(convergences) <= _FEW:
        return [convergences]
    found, above = [], 0
    for last in _LAST_ORDERS:
        found.append([c for c in convergences if above < c.order <= last])
        above = last
    return [mine for mine in found if mine]


def _title(convergences):
    found = list(dict.fromkeys(one.order for one in convergences))
    if len(found) < 3:
        return (
            f"order{'s' * (len(found) > 1)} {wording.listed([f'{o:g}' for o in found])}"
        )
    return f"orders {found[0]:g} to {found[-1]:g}"


def _boxes(ranges, columns, width):
    """(size of the figure in inches, height of a panel, where each is), legends below the panels."""
    rows = [ranges[i : i + columns] for i in range(0, len(ranges), columns)]
    lines = [max(math.ceil(len(mine) / 2) for mine in row) for row in rows]
    around = [_ABOVE + _BELOW + _LINE * count for count in lines]
    height = min(_HEIGHT_INCHES, (_MOST_INCHES - sum(around)) / len(rows))
    height = max(height, _LEAST_INCHES)
    wide = _LEFT + columns * width + (columns - 1) * _BETWEEN
    high = sum(around) + len(rows) * height
    boxes, top = [], high
    for row, more in zip(rows, around):
        for place in range(len(row)):
            left = _LEFT + place * (width + _BETWEEN)
            low = top - _ABOVE - height
            boxes.append((left / wide, low / high, width / wide, height / high))
        top -= height + more
    return (wide, high), height, boxes


def _draw_ranges(convergences, unit):
    """A panel for each range of orders, each with axes and a legend of its own."""
    ranges = _ranges(convergences)
    columns = min(figure_style.side_by_side(2), len(ranges))
    # As wide together as the text.
    size, height, boxes = _boxes(ranges, columns, figure_style.width(2.93) - 0.06)
    figure = pyplot.figure(figsize=size)
    for place, (mine, box) in enumerate(zip(ranges, boxes)):
        axes = figure.add_axes(box)
        token = mine[0].type
        styles = _styles({token: mine})
        _draw_panel(axes, mine, unit, styles, _title(mine))
        axes.set_xlabel("step (dimensionless time)", size=8, labelpad=1)
        if place % columns == 0:
            label = "global error (dimensionless)" if height > 1.5 else "global error"
            axes.set_ylabel(label, size=8)
        axes.legend(
            handles=_handles(styles, {token: mine}, token),
            loc="upper center",
            bbox_to_anchor=(0.46, -(_BELOW - 0.07) / height),
            ncol=2,
            borderpad=0,
            borderaxespad=0,
            labelspacing=0.2,
            columnspacing=1.0,
            handlelength=2.6,
            handletextpad=0.5,
            fontsize=_LEGEND_SIZE,
        )
    return figure


def _caption(problem, of_type, rows, longest):
    """What the figure shows; of several types and of one the panels are others."""
    one = len(of_type) == 1
    panels = ", a panel for each type"
    if one:
        many = len(_ranges(_drawn(of_type)[longest])) > 1
        panels = ", a panel for each range of orders, with axes of its own" * many
    said = _CAPTION % (
        problem,
        f" in {longest}" * one,
        panels,
        wording.ends(rows),
        f" in {longest}" * (not one),
        orders.CLEAR,
    )
    return (said + wording.hidden(of_type) + wording.zeros(of_type)).strip()


def _drawn(of_type):
    """What of it has a curve."""
    drawn = {t: [one for one in mine if one.drawn] for t, mine in of_type.items()}
    return {token: mine for token, mine in drawn.items() if mine}


def draw(pendulum):
    """Yield (name, caption, figure) for each problem that integrators were tried on."""
    bits, rows = pendulum.bits, pendulum.orders
    found = [one for one in orders.convergences(rows, bits) if one.points]
    for problem in dict.fromkeys(one.problem for one in found):
        mine = [one for one in found if one.problem == problem]
        tokens = type_order.ordered(one.type for one in mine)
        of_type = {t: [one for one in mine if one.type == t] for t in tokens}
        drawn = _drawn(of_type)
        if not drawn:
            continue
        longest = pendulum.most_precise(list(drawn))
        if len(drawn) > 1:
            figure = _draw_types(drawn, bits, longest)
        else:
            unit = orders.unit_roundoff(longest, bits)
            figure = _draw_ranges(drawn[longest], unit)
        told = [row for row in rows if row["problem"] == problem]
        yield f"{FAMILY}_{problem}", _caption(problem, of_type, told, longest), figure
