"""The pendulum at several instants, a row for each type; what the most precise type does lies behind in grey."""
import numpy
from matplotlib import pyplot, textpath, transforms

from ulpgate_report.figures import figure_style, type_style
from ulpgate_report.pendulum.drawing import each_condition, name_of, subject

FAMILY = "pendulum_snapshots"
_CAPTION = (
    "%s: the pendulum at the times above the columns, a row for each type; the square is the pivot, the dots are the "
    "nodes, larger than they are.%s"
)
_BEHIND = " Grey, broken: the same instant in %s."
_HEIGHT_INCHES = 8.0
_TYPE_POINTS = 7.5
# Between the names of the types and the panels, in points; as in the axis labels of all figures.
_PAD_POINTS = 4.0
_GREY = "0.72"
# Between panels, as a share of one.
_AIR = 0.05
# Around everything that is drawn, as a share of its larger extent.
_MARGIN = 0.07
# Two files are of one instant where their times agree to this share of the shortest gap.
_SAME = 1e-3


def nodes(columns):
    """Arrays (x, y) of the spheres in the order of the chain, None where a node is not finite."""
    spheres = numpy.array([shape == "sphere" for shape in columns["shape"]], bool)
    found = [numpy.array(columns[n], float)[spheres] for n in ("x_m", "y_m")]
    if len(found[0]) < 2 or not all(numpy.isfinite(v).all() for v in found):
        return None
    return tuple(found)


def _instants(lines):
    """{time: {type: nodes}} in the order of time; float's clock may be off by its roundings."""
    times = sorted(c["time_s"][0] for _, found in lines for _, c in found)
    gaps = [b - a for a, b in zip(times, times[1:])]
    near = _SAME * max(gaps, default=1.0)
    found = {}
    for token, snapshots in reversed(lines):
        for _, columns in snapshots:
            time, chain = columns["time_s"][0], nodes(columns)
            if chain is not None:
                same = [t for t in found if abs(t - time) <= near]
                found.setdefault(same[0] if same else time, {})[token] = chain
    return dict(sorted(found.items()))


def _limits(instants):
    every = [chain for of_type in instants.values() for chain in of_type.values()]
    limits = []
    for axis in (0, 1):
        low = min(float(chain[axis].min()) for chain in every)
        high = max(float(chain[axis].max()) for chain in every)
        limits.append((low, high))
    margin = _MARGIN * max(high - low for low, high in limits)
    return [(low - margin, high + margin) for low, high in limits]


def _draw_chain(axes, chain, colour, size, behind=False):
    x, y = chain
    order, dashes = (1, (0, (2.5, 1.5))) if behind else (2, "-")
    axes.plot(x, y, color=colour, linestyle=dashes, linewidth=1.1, zorder=order)
    # At their size the nodes, a hundredth of the chain, would not be seen.
    node = {"marker": "o", "linestyle": "none", "markersize": size}
    axes.plot(x[1:], y[1:], color=colour, zorder=order + 0.5, **node)
    axes.plot(x[:1], y[:1], marker="s", markersize=size, color="black", zorder=4)


def _side(tokens, count):
    """The width of one of `count` panels in inches that beside the names of the types takes all of the text's width."""
    longest = max(
        textpath.TextPath((0, 0), token, size=_TYPE_POINTS).get_extents().width
        for token in tokens
    )
    page = (
        figure_style.COLUMN_INCHES
        if figure_style.is_one_column()
        else figure_style.PAGE_INCHES
    )
    panels = page - (longest + 2 * _PAD_POINTS) / 72
    # Between the panels is some air.
    return panels / (max(3, count) * (1 + _AIR) - _AIR)


def _draw(lines, instants, tokens, limits, behind):
    (left, right), (low, high) = limits
    aspect = min(2.0, max(0.5, (high - low) / (right - left)))
    rows, columns = len(lines), len(instants)
    side = min(
        _side([token for token, _ in lines], columns), _HEIGHT_INCHES / aspect / rows
    )
    height = side * aspect
    size = min(2.6, 2 * side)
    figure, grid = pyplot.subplots(
        rows,
        columns,
        figsize=tuple(
            one * (count * (1 + _AIR) - _AIR)
            for one, count in ((side, columns), (height, rows))
        ),
        squeeze=False,
        sharex=True,
        sharey=True,
    )
    # The names and times are outside: the panels are all of the figure.
    figure.subplots_adjust(left=0, right=1, bottom=0, top=1, wspace=_AIR, hspace=_AIR)
    for row, (token, _) in zip(grid, lines):
        colour, _ = type_style.line_style(token, tokens)
        for axes, of_type in zip(row, instants.values()):
            axes.set_aspect("equal")
            axes.set(xlim=(left, right), ylim=(low, high), xticks=[], yticks=[])
            for spine in axes.spines.values():
                spine.set(visible=True, color="0.8")
            if behind in of_type and token != behind:
                _draw_chain(axes, of_type[behind], _GREY, size, behind=True)
            if token in of_type:
                _draw_chain(axes, of_type[token], colour, size)
        label = {"rotation": 0, "ha": "right", "va": "center", "size": _TYPE_POINTS}
        row[0].set_ylabel(token, labelpad=_PAD_POINTS, **label)
    for axes, time in zip(grid[0], instants):
        axes.set_title(f"t = {time:.4g} s", size=7.5, pad=3)
    _draw_scale(grid[-1][0], right - left, left, low)
    return figure


def _draw_scale(axes, width, left, low):
    """A bar of a round length below the first panel of the last row, from its left edge; its length stands below it."""
    exponent = numpy.floor(numpy.log10(width / 2))
    length = max(
        m * 10**exponent for m in (1, 2, 5) if m * 10**exponent <= width / 2
    )
    # In points below the frame, however high that is.
    bar, text = (
        transforms.offset_copy(
            axes.get_xaxis_transform(), axes.figure, y=below, units="points"
        )
        for below in (-5, -8.5)
    )
    axes.plot(
        [left, left + length],
        [0, 0],
        transform=bar,
        color="black",
        linewidth=1.2,
        clip_on=False,
    )
    axes.text(
        left,
        0,
        f"{length * 1000:g} mm",
        transform=text,
        ha="left",
        va="top",
        size=7,
    )


def draw(pendulum):
    """Yield (name, caption, figure) for each run with snapshots of a chain."""
    for run, condition, lines, conditions in each_condition(pendulum, "snapshots"):
        instants = _instants(lines)
        lines = [(t, s) for t, s in lines if any(t in of for of in instants.values())]
        if not lines:
            continue
        behind = pendulum.most_precise([token for token, _ in lines])
        tokens, limits = pendulum.type_tokens, _limits(instants)
        figure = _draw(lines, instants, tokens, limits, behind)
        caption = _CAPTION % (
            subject(condition.scene, condition.dt, condition.variant),
            _BEHIND % behind if len(lines) > 1 else "",
        )
        yield name_of(FAMILY, run, condition, conditions), caption, figure
