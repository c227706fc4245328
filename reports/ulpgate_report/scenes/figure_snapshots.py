"""The bodies of a scene at up to four instants: spheres as circles sorted by depth, coloured by kinetic energy."""
import math

import matplotlib
import numpy
from matplotlib import pyplot
from matplotlib.collections import EllipseCollection

from ulpgate_report.figures import figure_style

FAMILY = "snapshots"
_CAPTION = (
    "Scene %s in %s, seen along the z axis: the spheres at the times above the panels, the nearer ones over the farther, "
    "coloured by their kinetic energy (logarithmic; %s)."
)
_PANEL_INCHES = 3.1
_COLOUR_MAP = "viridis"
# Kinetic energies further below the largest than this would use up the colours for what hardly moves.
_DECADES = 6
# A small pale disc in the upper left of each circle makes it a ball.
_GLEAM_OFFSET, _GLEAM_SIZE, _GLEAM_SHARE = 0.32, 0.36, 0.45


def spheres(columns):
    """Rows (x, y, radius, kinetic energy) of the spheres, the farthest first."""
    names = ("x_m", "y_m", "z_m", "radius_m", "kinetic_J")
    table = numpy.array([columns[name] for name in names], dtype=float).T
    is_sphere = numpy.array([shape == "sphere" for shape in columns["shape"]], bool)
    table = table[is_sphere] if len(table) else table.reshape(0, 5)
    table = table[numpy.isfinite(table[:, :4]).all(axis=1) & (table[:, 3] > 0)]
    # Stable: bodies of one depth stay in the order of the file.
    return table[numpy.argsort(table[:, 2], kind="stable")][:, [0, 1, 3, 4]]


def energy_range(panels):
    """(lowest, highest) kinetic energy of the colours, over all panels."""
    energies = numpy.concatenate([found[:, 3] for found in panels])
    energies = energies[numpy.isfinite(energies) & (energies > 0)]
    if not len(energies):
        return 1e-12, 1.0
    highest = float(energies.max())
    lowest = max(float(energies.min()), highest * 10.0**-_DECADES)
    return (lowest, highest) if lowest < highest else (highest / 10, highest)


def _draw_panel(axes, found, norm):
    energies = numpy.clip(numpy.nan_to_num(found[:, 3]), norm.vmin, norm.vmax)
    plain = matplotlib.colormaps[_COLOUR_MAP](norm(energies))
    gleam = plain + _GLEAM_SHARE * (1 - plain)
    # A ball and its gleam lie beside each other in the list, so that a nearer ball covers both.
    faces = numpy.stack([plain, gleam], axis=1).reshape(-1, 4)
    edges = numpy.stack([plain * [0.35, 0.35, 0.35, 1], gleam], axis=1).reshape(-1, 4)
    radius = found[:, 2:3]
    shift = radius * _GLEAM_OFFSET * numpy.array([[-1.0, 1.0]])
    centres = numpy.stack([found[:, :2], found[:, :2] + shift], axis=1).reshape(-1, 2)
    sizes = (2 * radius * [1.0, _GLEAM_SIZE]).reshape(-1)
    lines = numpy.tile([0.3, 0.0], len(found))
    axes.add_collection(
        EllipseCollection(
            sizes,
            sizes,
            numpy.zeros(len(sizes)),
            units="xy",
            offsets=centres,
            offset_transform=axes.transData,
            facecolors=faces,
            edgecolors=edges,
            linewidths=lines,
            # Ten thousand circles as curves would make files of many megabytes.
            rasterized=True,
        )
    )


def _limits(panels):
    """(x limits, y limits) that show every ball of every panel."""
    every = numpy.concatenate(panels)
    limits = []
    for axis in (0, 1):
        low = float((every[:, axis] - every[:, 2]).min())
        high = float((every[:, axis] + every[:, 2]).max())
        margin = 0.03 * (high - low)
        limits.append((low - margin, high + margin))
    return limits


def _draw(panels, times):
    columns = 2 if len(panels) > 1 else 1
    rows = math.ceil(len(panels) / columns)
    x_limits, y_limits = _limits(panels)
    aspect = (y_limits[1] - y_limits[0]) / (x_limits[1] - x_limits[0])
    panel = figure_style.width(columns * _PANEL_INCHES) / columns
    height = panel * min(2.0, max(0.4, aspect))
    figure, grid = pyplot.subplots(
        rows,
        columns,
        figsize=(columns * panel, rows * height),
        squeeze=False,
        sharex=True,
        sharey=True,
    )
    figure.subplots_adjust(wspace=0.08, hspace=0.16)
    lowest, highest = energy_range(panels)
    norm = matplotlib.colors.LogNorm(lowest, highest)
    for axes, found, time in zip(grid.flat, panels, times):
        axes.set_xlim(*x_limits)
        axes.set_ylim(*y_limits)
        axes.set_aspect("equal")
        axes.set_title(f"t = {time:.4g} s", size=8, pad=3)
        _draw_panel(axes, found, norm)
    for axes in list(grid.flat)[len(panels) :]:
        axes.remove()
    if figure_style.is_one_column():
        for axes in grid.flat[: len(panels)]:
            axes.locator_params(axis="x", nbins=3, prune="both")
    for axes in grid[-1]:
        axes.set_xlabel("x (m)")
    for axes in grid[:, 0]:
        axes.set_ylabel("y (m)")
    bar = figure.colorbar(
        matplotlib.cm.ScalarMappable(norm, _COLOUR_MAP),
        ax=list(grid.flat)[: len(panels)],
        fraction=0.035,
        pad=0.02,
    )
    bar.set_label("kinetic energy (J)")
    bar.outline.set_linewidth(0.4)
    return figure


def draw(scenes):
    """Yield (name, caption, figure) for each scene and type with snapshots."""
    for scene in scenes.names:
        for token, snapshots in scenes.of(scenes.snapshots, scene):
            shown = [(spheres(columns), columns) for _, columns in snapshots]
            shown = [(found, columns) for found, columns in shown if len(found)]
            if not shown:
                continue
            figure = _draw(
                [found for found, _ in shown],
                [columns["time_s"][0] for _, columns in shown],
            )
            below = f"more than {_DECADES} decades below the largest: the lowest colour"
            name = f"{FAMILY}_{scene}_{token}"
            yield name, _CAPTION % (scene, token, below), figure
