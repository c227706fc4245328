"""Collisions of a scene in all types: restitution over the speed of approach, steps inside, energy made against its bound."""
import math
import re
from collections import Counter

from matplotlib import pyplot
from matplotlib.lines import Line2D

from ulpgate_report.collisions import tables
from ulpgate_report.figures import figure_style, type_style

FAMILY = "collisions"
_CAPTION = (
    "Collisions of %s. Left: restitution over the speed of approach%s. Middle: steps inside each other, share of the collisions. "
    "Right: energy that the contact made over what rounding, time step and law together may make; on the line it is all of it, "
    "above beyond the condition (ringed). %sTypes that agree lie on each other, the more precise one on top and smaller.%s"
)
# Beyond this share restitutions stand at the edge of their axis.
_SHARE_SHOWN = 0.99
# Of each type so many are drawn, evenly over the run; those beyond their condition always.
MOST_POINTS = 1500
_SIZE = (7.4, 2.75)
_NONE_MADE = "No contact made energy. "


def chosen(found, most=MOST_POINTS):
    """At most `most` of a list, evenly over it."""
    if len(found) <= most:
        return found
    return [found[i * len(found) // most] for i in range(most)]


def _style(place, count):
    """Sizes by the place of a type: the first, least precise, is the largest and lies below."""
    share = place / max(1, count - 1)
    return {"markersize": 3.6 - 2.2 * share, "zorder": 2 + share}


def _points(found, xy):
    """The points of some collisions whose two values are finite and positive."""
    at = [xy(one) for one in found]
    usable = [
        point
        for point in at
        if None not in point and all(math.isfinite(one) for one in point)
    ]
    return [(x, y) for x, y in usable if x > 0]


def _speed_and_restitution(one):
    return one.speed, one.restitution


def _bound_and_gain(one):
    gained = one.gained_J if one.gained_J is not None and one.gained_J > 0 else None
    return one.bound_J, gained


def _draw_points(plot, runs, tokens, xy):
    """Points of all types; returns how many there are."""
    drawn = 0
    for place, (token, run) in enumerate(runs.items()):
        colour, marker = type_style.line_style(token, tokens)
        points = chosen(_points(run.ended, xy))
        drawn += len(points)
        style = {"color": colour, "marker": marker, "markeredgewidth": 0}
        style.update(_style(place, len(runs)), linestyle="none", alpha=0.7)
        plot.plot(*_split(points), rasterized=True, **style)
    return drawn


def _split(points):
    return [x for x, _ in points], [y for _, y in points]


def highest_shown(values):
    """The upper end of the axis of restitutions: neighbours that push on make a few many times larger than the rest."""
    most = tables.quantile(values, _SHARE_SHOWN) or 0.0
    return max(1.05, min(1.05 * max(values, default=0.0), 1.4 * most))


def _draw_restitution(plot, runs, tokens):
    """Restitution over the speed of approach; returns how many stand at the upper edge."""
    found = [_points(run.ended, _speed_and_restitution) for run in runs.values()]
    values = [y for points in found for _, y in points]
    top = highest_shown(values)

    def at_most_top(one):
        speed, restitution = _speed_and_restitution(one)
        return speed, restitution if restitution is None else min(restitution, top)

    if _draw_points(plot, runs, tokens, at_most_top):
        figure_style.log_axis(plot.xaxis)
    plot.set_ylim(min(0.0, 1.05 * min(values, default=0.0)), 1.03 * top)
    plot.set(xlabel="approach (m/s)", ylabel="restitution")
    return sum(value > top for value in values)


def bins(steps):
    """Edges of bins of whole steps, about equally wide, on a logarithmic axis where they span more than two decades."""
    low, high = min(steps), max(steps)
    if high > 100 * max(1, low):
        edges, edge = [], max(low, 1) - 0.5
        while edge < high + 0.5:
            edges.append(edge)
            edge = max(edge + 1, math.floor(edge * 1.15) + 0.5)
        return [*edges, edge], True
    width = max(1, math.ceil((high - low + 1) / 40))
    count = math.ceil((high - low + 1) / width)
    return [low - 0.5 + width * n for n in range(count + 1)], False


def _draw_steps(plot, runs, tokens):
    steps = {token: [one.steps for one in run.ended] for token, run in runs.items()}
    edges, is_logarithmic = bins([one for found in steps.values() for one in found])
    for place, (token, found) in enumerate(steps.items()):
        if not found:
            continue
        counts = Counter(_bin_of(one, edges) for one in found)
        shares = [counts[index] / len(found) for index in range(len(edges) - 1)]
        colour, _ = type_style.line_style(token, tokens)
        width = 3.2 - 2.5 * place / max(1, len(steps) - 1)
        plot.stairs(shares, edges, color=colour, linewidth=width, zorder=2 + place)
    if is_logarithmic:
        plot.set_xscale("log")
    plot.set(xlabel="steps inside", ylabel="share of the collisions")
    plot.set_ylim(bottom=0)


def _bin_of(value, edges):
    return sum(edge < value for edge in edges[1:])


def _draw_energy(plot, runs, tokens):
    """Gained energy over its bound; returns whether any was gained."""
    if not _draw_points(plot, runs, tokens, _bound_and_gain):
        plot.text(0.5, 0.5, "none was made", ha="center", transform=plot.transAxes)
        plot.set(xticks=[], yticks=[])
        plot.set(xlabel="bound (J)", ylabel="energy made (J)")
        return False
    for run in runs.values():
        beyond = _points([one for one in run.ended if one.beyond], _bound_and_gain)
        ring = {"marker": "o", "markersize": 6, "markerfacecolor": "none"}
        ring.update(markeredgecolor="black", markeredgewidth=0.7, linestyle="none")
        plot.plot(*_split(beyond[: tables.MOST_FINDINGS]), zorder=5, **ring)
    figure_style.log_axis(plot.xaxis)
    figure_style.log_axis(plot.yaxis)
    limits = plot.get_xlim()
    plot.plot(limits, limits, color="0.3", linewidth=0.8, zorder=1.5)
    plot.set_xlim(limits)
    plot.set(xlabel="bound (J)", ylabel="energy made (J)")
    return True


def _legend(figure, runs, tokens):
    handles = []
    for token in runs:
        colour, marker = type_style.line_style(token, tokens)
        style = {"color": colour, "marker": marker, "markersize": 4}
        handles.append(Line2D([], [], linewidth=1.2, label=token, **style))
    figure.legend(
        handles=handles, loc="lower center", bbox_to_anchor=(0.5, 0), ncol=len(handles)
    )


def _name(label):
    return f"{FAMILY}_{re.sub(r'[^A-Za-z0-9_.+-]+', '-', label).strip('-')}"


def draw(collisions):
    """Yield (name, caption, figure) for each scene, as it was run, in which a collision ended."""
    labels, tokens = tables.labels(collisions), collisions.type_tokens
    for key, of_type in tables.groups(collisions).items():
        runs = {t: of_type[t] for t in tokens if t in of_type and of_type[t].ended}
        if not runs:
            continue
        figure, plots = figure_style.panels(3, *_SIZE)
        beyond = _draw_restitution(plots[0], runs, tokens)
        _draw_steps(plots[1], runs, tokens)
        made = _draw_energy(plots[2], runs, tokens)
        if figure_style.is_one_column():
            figure.subplots_adjust(0.18, 0.12, 0.995, 0.99, hspace=0.3)
        else:
            figure.subplots_adjust(0.07, 0.29, 0.995, 0.97, wspace=0.36)
        _legend(figure, runs, tokens)
        most = max(len(run.ended) for run in runs.values())
        drawn = (
            f" Of {most:,} collisions {MOST_POINTS:,} are drawn as points."
            if most > MOST_POINTS
            else ""
        )
        edge = f"; {beyond:,} larger ones stand at the edge" if beyond else ""
        about = (labels[key], edge, "" if made else _NONE_MADE, drawn)
        caption = _CAPTION % about
        yield _name(labels[key]), caption, figure
