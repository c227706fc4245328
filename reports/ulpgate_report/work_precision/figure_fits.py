"""The law of the errors over the step: each integrator's max(C dt^p, B sqrt(n) u, D n u) beside the points it is fitted to."""
import math
from dataclasses import dataclass

from matplotlib import patheffects, pyplot
from matplotlib.lines import Line2D

from ulpgate_report.figures import figure_style, type_style
from ulpgate_report.work_precision import axes, drawing, figure_curves, settings

PART = "fits"
# Of the two errors that are fitted the first that a problem or scene has.
_ERRORS = (("energy_error", "energy_error"), ("final_error", "error"))
_CAPTION = (
    "%s %s: %s over the step, a point for each setting, and thin lines for the law max(C dt^p, B sqrt(n) u, D n u) of n steps "
    "and unit roundoff u that is fitted to them, a colour for each type; named: its branches. Star: the best step of a type. "
    "Dashed: where the law does not hold. %sBroken dark lines without marks: the roundoff u = 2^-p of the types. Integrators without a law of "
    "any type are left out; a type that lies on a more precise one is hidden by it.%s"
)
_OTHERS = {0: "", 1: "One other integrator is in the table. "}
_MANY = "%d other integrators are in the table. "
_FAILED = " Crosses: steps that failed."
_PANEL, _COLUMNS, _MOST_PANELS = (2.45, 1.95), 3, 9
_POINTS_OF_LINE = 120
# Errors of this size are not fitted, and a law does not reach there.
_MEANINGLESS = 1.0
_HALO = [patheffects.withStroke(linewidth=1.6, foreground="white")]
_STAR = {"marker": "*", "markersize": 8, "markeredgecolor": "black"}
_STAR.update(markeredgewidth=0.5, linestyle="none", zorder=5)


@dataclass(frozen=True)
class Law:
    """A fitted law: its branches over the step of a run that lasts `time`, in the unit of the step.

    `roundoff` is None of a type of unknown precision: its branches of rounding are not known then.
    """

    fit: dict
    roundoff: object
    time: float

    def branches(self, dt):
        """{name: error} of the branches that the law has."""
        n, fit = self.time / dt, self.fit
        found = {}
        if fit["order"] is not None:
            found["stepping"] = fit["constant"] * dt ** fit["order"]
        if fit["walk"] is not None and self.roundoff:
            found["walk"] = fit["walk"] * math.sqrt(n) * self.roundoff
        if fit["drift"] is not None and self.roundoff:
            found["drift"] = fit["drift"] * n * self.roundoff
        return found

    def pieces(self, first, last):
        """[(branch, [(dt, error)])] of the largest branch from the largest step to the smallest."""
        found = []
        for index in range(_POINTS_OF_LINE + 1):
            dt = first * (last / first) ** (index / _POINTS_OF_LINE)
            branches = self.branches(dt)
            if not branches:
                return []
            name = max(branches, key=branches.get)
            at = (dt, branches[name])
            if not found or found[-1][0] != name:
                # The lines of two branches meet.
                if found:
                    found[-1][1].append(at)
                found.append((name, []))
            found[-1][1].append(at)
        return found

    def words(self, branch):
        """The branch as a label has it."""
        if branch == "stepping":
            return rf"$dt^{{{self.fit['order']:.2g}}}$"
        return {"walk": r"$\sqrt{n}\,u$", "drift": r"$n\,u$"}[branch]


def laws(measured, kind, name):
    """(quantity, {(method, type): law}) of the first error that has any; None where none was fitted."""
    fits = [f for f in measured.fits if (f["subject"], f["name"]) == (kind, name)]
    for error, quantity in _ERRORS:
        found = {}
        for fit in fits:
            roundoff = measured.roundoff(fit["type"])
            rows = _rows_of(measured, kind, name, fit)
            if fit["error"] == error and rows:
                time = rows[0]["dt"] * rows[0]["steps"]
                found[settings.method(fit), fit["type"]] = Law(fit, roundoff, time)
        # Without a branch there is still a best step.
        if any(law.fit["residual"] is not None for law in found.values()):
            return quantity, found
    return None


def _rows_of(measured, kind, name, fit):
    """The settings that a fit is of."""
    return [
        row
        for row in measured.of_kind(kind, name)
        if (row["type"], settings.method(row)) == (fit["type"], settings.method(fit))
    ]


def _visible(points, scales):
    """Where points of a line are drawn: not a number where the scale is cut, and where the law says nothing."""
    x, y = [], []
    for dt, error in points:
        shown = 0 < error < _MEANINGLESS and scales[1].shows(error)
        x.append(scales[0].position(dt))
        y.append(scales[1].position(error) if shown else math.nan)
    return x, y


class _Labels:
    """Names of branches, each where there is room."""

    def __init__(self, plot, scales):
        self._plot, self._taken = plot, []
        self._apart = [(s.high - s.low) * part for s, part in zip(scales, (0.16, 0.1))]
        self._top = scales[1].high - self._apart[1]

    def add(self, x, y, text, colour, beside=False):
        """Write at a place unless another stands near: above it, at the upper edge below, or below and to the right."""
        near = (
            all(abs(a - b) < room for a, b, room in zip((x, y), at, self._apart))
            for at in self._taken
        )
        if any(near):
            return
        self._taken.append((x, y))
        style = {"size": 6.3, "color": colour, "zorder": 6, "path_effects": _HALO}
        side, shift = ("top", -2.5) if beside or y > self._top else ("bottom", 2.5)
        place = {"ha": "left" if beside else "center", "va": side}
        at = {"xytext": (3 if beside else 0, shift), "textcoords": "offset points"}
        self._plot.annotate(text, (x, y), **at, **place, **style)


def _draw_law(plot, law, dts, scales, colour):
    """The branches as lines; returns [(branch, x, y)] of their middles."""
    style = {"color": colour, "linewidth": 0.8, "zorder": 2.5}
    style["linestyle"] = (0, (3, 2)) if law.fit["bad"] else "-"
    middles = []
    for branch, points in law.pieces(max(dts), min(dts)):
        x, y = _visible(points, scales)
        plot.plot(x, y, **style)
        usable = [at for at in zip(x, y) if not math.isnan(at[1])]
        if len(usable) > _POINTS_OF_LINE / 12:
            middles.append((branch, *usable[len(usable) // 2]))
    return middles


def _draw_best(plot, law, scales, colour):
    error, dt = law.fit["best_error"], law.fit["best_dt"]
    if not dt or error is None or (error == 0 and scales[1].exact is None):
        return
    at = scales[0].position(dt), scales[1].position(error)
    plot.plot(*at, color=colour, **_STAR)


def _draw_panel(plot, measured, rows, found, quantity):
    """One integrator: points, laws and best steps of all types; without a point a sentence."""
    tokens, pair = measured.type_tokens, ("dt", quantity)
    here = [token for token in tokens if any(row["type"] == token for row in rows)]
    scales = drawing.scales_of(rows, pair, drawing.floors_of(measured, here))
    if scales is None:
        plot.text(0.5, 0.5, "every setting failed", ha="center", va="center", size=7)
        plot.set(xticks=[], yticks=[])
        return
    drawing.draw_axes(plot, rows, pair, scales, most=5)
    drawing.draw_floors(plot, measured, here, pair, scales, names=False)
    labels, middles = _Labels(plot, scales), []
    for token in here:
        colour, marker = type_style.line_style(token, tokens)
        mine = [row for row in rows if row["type"] == token]
        points = [at for at in (settings.point(row, pair) for row in mine) if at]
        style = {"color": colour, "marker": marker, "markersize": 2.6, "zorder": 3}
        style.update(markeredgewidth=0, linestyle="none", alpha=0.8)
        plot.plot(*drawing.positions(points, scales), **style)
        drawing.draw_failed(plot, mine, pair, scales, colour)
        law = found.get(token)
        if law is None or len(points) < 2:
            continue
        dts = [dt for dt, _ in points]
        for branch, x, y in _draw_law(plot, law, dts, scales, colour):
            middles.append((branch, x, y, law.words(branch), colour))
        _draw_best(plot, law, scales, colour)
    # The order is that of all types: the last, most precise one shows it over the longest stretch.
    stepping = [one for one in middles if one[0] == "stepping"][-1:]
    rounding = [one for one in middles if one[0] != "stepping"]
    for branch, x, y, words, colour in [*stepping, *rounding]:
        labels.add(x, y, words, colour, beside=branch == "stepping")


def _handles(measured, here):
    tokens = measured.type_tokens
    found = [drawing.type_handle(t, tokens, linestyle="-") for t in here]
    return [*found, Line2D([], [], color="white", label="best step", **_STAR)]


def _shown(measured, rows, found):
    """The integrators that get a panel, those most often on a front first, and how many others were fitted."""
    pairs = settings.drawn_pairs(measured, rows) or [(axes.DEFAULT, "", "")]
    ranking = figure_curves.ranked(rows, pairs[0][0])
    with_law = {
        name for (name, _), law in found.items() if law.fit["residual"] is not None
    }
    fitted = [one for one in ranking if one in with_law]
    most = _MOST_PANELS - figure_style.is_one_column()
    return fitted[:most], max(0, len(fitted) - most)


def _draw(measured, rows, found, quantity, shown):
    columns = min(2 if figure_style.is_one_column() else _COLUMNS, len(shown))
    lines = math.ceil(len(shown) / columns)
    here = [t for t in measured.type_tokens if any(r["type"] == t for r in rows)]
    # One panel alone is large enough for a legend beside it.
    size = (3.6, 3.0) if len(shown) == 1 else _PANEL
    if figure_style.is_one_column():
        size = (figure_style.COLUMN_INCHES / columns, size[1])
    below = 0.75
    width, height = columns * size[0], lines * size[1] + below
    figure = pyplot.figure(figsize=(max(width, figure_style.width(5.0)), height))
    width = figure.get_size_inches()[0]
    for index, integrator in enumerate(shown):
        left = (index % columns) * size[0] + 0.55
        bottom = height - (index // columns + 1) * size[1] + 0.2
        shape = [left / width, bottom / height]
        shape += [(size[0] - 0.65) / width, (size[1] - 0.45) / height]
        plot = figure.add_axes(shape)
        mine = [row for row in rows if settings.method(row) == integrator]
        laws_here = {t: law for (one, t), law in found.items() if one == integrator}
        _draw_panel(plot, measured, mine, laws_here, quantity)
        plot.set_title(integrator, size=8, pad=3)
        if index % columns:
            plot.set_ylabel("")
        if index < len(shown) - columns:
            plot.set_xlabel("")
    figure.legend(
        handles=_handles(measured, here),
        loc="upper center",
        bbox_to_anchor=(0.5, (below - 0.2) / height),
        ncol=figure_style.legend_columns(4),
        columnspacing=1.4,
        handlelength=2.2,
    )
    return figure


def draw(measured):
    """Yield (name, caption, figure) for each problem and scene whose errors were fitted."""
    for kind, name in measured.subjects(figure_curves.KINDS):
        fitted = laws(measured, kind, name)
        if fitted is None:
            continue
        quantity, found = fitted
        rows = measured.of_kind(kind, name)
        shown, others = _shown(measured, rows, found)
        if not any(settings.point(row, ("dt", quantity)) for row in rows):
            continue
        figure = _draw(measured, rows, found, quantity, shown)
        title = axes.QUANTITIES[quantity].title
        failed = drawing.failed_points(rows, ("dt", quantity))
        about = (kind.capitalize(), name, title, _OTHERS.get(others, _MANY % others))
        said = _FAILED if failed else ""
        yield drawing.name_of(PART, kind, name), _CAPTION % (*about, said), figure
