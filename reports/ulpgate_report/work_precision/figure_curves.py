"""Error against run time of a problem or a scene: all types in one plot, and a panel for each type with all integrators."""
import math

from matplotlib import pyplot
from matplotlib.lines import Line2D

from ulpgate_report.figures import figure_style, type_style
from ulpgate_report.work_precision import drawing, settings

KINDS = ("trajectory", "scene")
_CAPTION = (
    "%s %s: %s. %sGrey band through marks: the settings with an error below 1 that no other betters in both (Pareto front%s); a gain in error of less than "
    "2 %% is none. " + drawing.CAPTION_FLOORS
)
_PANELS = (
    "Above: every setting by its type, named where the front changes its integrator. Below: a panel for each type, a curve "
    "for each integrator over its steps; the axes differ from panel to panel. "
)
_SELDOM = "In grey integrators that are seldom on a front. "
_ONE_PLOT = "A curve for each type%s over its steps. "
# As many integrators as dashes tell apart in the colours of the types; more get a panel for each type.
_DASHES = ("-", (0, (4, 1.5)), (0, (1.2, 1.2)))
_COLOURS = 7
_OTHERS = {"color": "0.72", "linewidth": 0.6, "marker": ".", "markersize": 2.5}
_WIDTH, _TOP, _PANEL, _COLUMNS = 7.2, 3.6, 2.3, 3
_MOST_NAMES = 12


def ranked(rows, pair):
    """The integrators, those that are on the front of a type most often first."""
    names = list(dict.fromkeys(map(settings.method, rows)))
    counts = dict.fromkeys(names, 0)
    for token in {row["type"] for row in rows}:
        mine = [row for row in rows if row["type"] == token]
        for row in settings.front(mine, pair):
            counts[settings.method(row)] += 1
    return sorted(names, key=lambda name: (-counts[name], name))


def style_of(place):
    """The line of the integrator at a place of the ranking: colours, then the same dashed, then all the same grey."""
    if place >= 2 * _COLOURS:
        return {**_OTHERS, "zorder": 1.8}
    dashed = place >= _COLOURS
    colour = figure_style.colour(place)
    return {
        "color": colour,
        "marker": figure_style.marker(place % _COLOURS),
        "linestyle": (0, (3, 1.5)) if dashed else "-",
        "markerfacecolor": "white" if dashed else colour,
        "markeredgewidth": 0.7,
        "markersize": 2.8,
        "linewidth": 0.8,
        "zorder": 2.2 if dashed else 2.5,
    }


def _name_front(plot, best, pair, scales, most):
    """The integrators beside the front, each where it begins."""
    named, before, places = 0, None, []
    for row in best:
        name = settings.method(row)
        at = settings.point(row, pair)
        x, y = (s.position(one) for s, one in zip(scales, at))
        near = any(
            abs(x - a) < 0.13 * (scales[0].high - scales[0].low)
            and abs(y - b) < 0.045 * (scales[1].high - scales[1].low)
            for a, b in places
        )
        if name == before or near or named == most:
            continue
        before, named = name, named + 1
        places.append((x, y))
        # Below the front there is room; at the left edge to the right alone.
        at_edge = x < scales[0].low + 0.2 * (scales[0].high - scales[0].low)
        plot.annotate(
            name,
            (x, y),
            xytext=(-2 if at_edge else -4, -6 if at_edge else -4),
            textcoords="offset points",
            ha="left" if at_edge else "right",
            va="top",
            size=5.8,
            color="0.15",
            zorder=5,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.3, "alpha": 0.75},
        )


def _draw_curves(plot, rows, pair, scales, style):
    for points in settings.segments(rows, pair):
        plot.plot(*drawing.positions(points, scales), **style)


def _draw_overview(plot, measured, rows, pair, dashes):
    """All types in one plot: their settings, or where integrators are few the curves."""
    tokens = measured.type_tokens
    here = [token for token in tokens if any(row["type"] == token for row in rows)]
    floors = drawing.floors_of(measured, here)
    scales = drawing.scales_of(rows, pair, floors)
    drawing.draw_axes(plot, rows, pair, scales)
    best = drawing.draw_front(plot, rows, pair, scales)
    drawing.draw_floors(plot, measured, here, pair, scales)
    for (token, method), mine in settings.curves(rows).items():
        colour, marker = type_style.line_style(token, tokens)
        style = {"color": colour, "marker": marker, "markeredgecolor": "white"}
        style.update(markeredgewidth=0.25, markersize=3.6, zorder=3)
        if "seconds" not in pair:
            # Types of the same error and count lie on each other: the more precise is the larger, below.
            place = here.index(token)
            style.update(markersize=3.2 + place, zorder=3 - 0.05 * place)
        if dashes:
            # What failed at every setting has crosses and no place among the dashes.
            style.update(linestyle=dashes.get(method, "-"), linewidth=0.9)
        else:
            # Thousands of points: pixels inside the vector files keep them small.
            style.update(linestyle="none", alpha=0.75, rasterized=True)
            style["markersize"] -= 0.6
        _draw_curves(plot, mine, pair, scales, style)
        drawing.draw_failed(plot, mine, pair, scales, colour)
    if len(dashes) != 1:
        _name_front(plot, best, pair, scales, _MOST_NAMES)
    return here


def _overview_legend(plot, measured, here, dashes, pair):
    line = "-" if dashes else "none"
    tokens = measured.type_tokens
    handles = [drawing.type_handle(t, tokens, linestyle=line) for t in here]
    if len(dashes) > 1:
        handles += [
            Line2D([], [], color="0.3", linewidth=0.9, linestyle=dash, label=name)
            for name, dash in dashes.items()
        ]
    drawing.draw_legend(plot, handles, pair)


def _draw_panel(plot, measured, rows, pair, places):
    """One type: a curve for each integrator."""
    token = rows[0]["type"]
    scales = drawing.scales_of(rows, pair, drawing.floors_of(measured, [token]))
    if scales is None:
        plot.text(0.5, 0.5, "every setting failed", ha="center", va="center", size=7)
        plot.set(xticks=[], yticks=[])
        plot.set_title(token, size=8, pad=3)
        return
    drawing.draw_axes(plot, rows, pair, scales, most=5)
    drawing.draw_front(plot, rows, pair, scales)
    drawing.draw_floors(plot, measured, [token], pair, scales, names=False)
    for (_, method), mine in settings.curves(rows).items():
        style = style_of(places.get(method, len(places)))
        _draw_curves(plot, mine, pair, scales, style)
        drawing.draw_failed(plot, mine, pair, scales, style["color"])
    plot.set_title(token, size=8, pad=3)


def _panel_legend(figure, ranking, bottom):
    shown = ranking[: 2 * _COLOURS]
    handles = [
        Line2D([], [], label=name or "(none)", **style_of(place))
        for place, name in enumerate(shown)
    ]
    others = len(ranking) - len(shown)
    if others:
        handles.append(Line2D([], [], label=f"{others} others", **_OTHERS))
    figure.legend(
        handles=handles,
        loc="upper center",
        bbox_to_anchor=(0.5, bottom),
        ncol=2 if figure_style.is_one_column() else 4,
        columnspacing=1.4,
        handlelength=2.8,
        fontsize=6.8,
    )


def _draw_with_panels(measured, rows, pair, ranking):
    tokens = [t for t in measured.type_tokens if any(r["type"] == t for r in rows)]
    narrow = figure_style.is_one_column()
    columns = 2 if narrow else _COLUMNS
    panel_rows = math.ceil(len(tokens) / columns)
    height = _TOP + _PANEL * panel_rows
    width = figure_style.COLUMN_INCHES if narrow else _WIDTH
    figure = pyplot.figure(figsize=(width, height))
    # In one column the legend stands above the plot, right of it else.
    shape = [0.14, 0.62, 0.80] if narrow else [0.09, 0.75, 0.68]
    plot = figure.add_axes(
        [shape[0], 1 - (_TOP - shape[1]) / height, shape[2], (_TOP - 1.35) / height]
        if narrow
        else [shape[0], 1 - (_TOP - shape[1]) / height, shape[2], (_TOP - 1.0) / height]
    )
    here = _draw_overview(plot, measured, rows, pair, {})
    _overview_legend(plot, measured, here, {}, pair)
    places = {name: place for place, name in enumerate(ranking)}
    each = 0.91 / columns
    for index, token in enumerate(tokens):
        bottom = height - _TOP - _PANEL * (index // columns + 1) + 0.62
        left = 0.09 + each * (index % columns)
        shape = [
            left,
            bottom / height,
            each - (0.1 if narrow else 0.065),
            (_PANEL - 0.75) / height,
        ]
        panel = figure.add_axes(shape)
        mine = [row for row in rows if row["type"] == token]
        _draw_panel(panel, measured, mine, pair, places)
        if index % columns:
            panel.set_ylabel("")
        if index < len(tokens) - columns:
            panel.set_xlabel("")
    _panel_legend(figure, ranking, 0.2 / height)
    return figure


def _draw(measured, rows, pair):
    """(figure, whether it has panels); None where every setting failed."""
    if not any(settings.point(row, pair) for row in rows):
        return None, False
    # What failed at every setting has no curve, and no entry in the legend.
    ranking = ranked([row for row in rows if settings.point(row, pair)], pair)
    if len(ranking) > len(_DASHES):
        return _draw_with_panels(measured, rows, pair, ranking), True
    figure, plot = pyplot.subplots(figsize=(figure_style.width(5.6), 3.8))
    dashes = dict(zip(ranking, _DASHES))
    here = _draw_overview(plot, measured, rows, pair, dashes)
    _overview_legend(plot, measured, here, dashes, pair)
    return figure, False


def draw(measured):
    """Yield (name, caption, figure) for each problem and scene, and each pair of axes."""
    for kind, name in measured.subjects(KINDS):
        rows = measured.of_kind(kind, name)
        for pair, suffix, said in settings.drawn_pairs(measured, rows):
            figure, has_panels = _draw(measured, rows, pair)
            methods = {settings.method(row) for row in rows} - {""}
            each = " and integrator" if len(methods) > 1 else ""
            alone = f", integrator {min(methods)}" if len(methods) == 1 else ""
            how = _PANELS if has_panels else _ONE_PLOT % each
            if has_panels and len(methods) > 2 * _COLOURS:
                how += _SELDOM
            within = ", of all types above, of each below" if has_panels else ""
            about = (kind.capitalize(), name + alone, drawing.words_of(pair))
            caption = _CAPTION % (*about, how, within)
            caption += drawing.failures_of(rows, pair) + said
            yield drawing.name_of(kind, name, suffix), caption, figure
