"""How fast RealHP<1> leaves RealHP<4>: error of the positions against step, a line for each type, a figure a scene."""
from matplotlib import pyplot

from ulpgate_report.figures import figure_style, type_style
from ulpgate_report.records import csv_columns

FAMILY = "divergence"
_CAPTION = (
    "Scene %s: largest difference of a position between a run in RealHP<1> and one in RealHP<4> from the same state, "
    "against the step, in ULP of the type (left) and in metres (right); both axes logarithmic. Steps without any "
    "difference are not drawn. Vertical dotted: from here on the two runs do not have the same contacts."
)
_PANELS = (
    ("max_position_ulp", "position error (ULP)"),
    ("max_position_error_m", "position error (m)"),
)
_CONTACTS = ("contacts_only_here", "contacts_only_in_reference")


def _contacts_differ_from(columns):
    if any(name not in columns for name in _CONTACTS):
        return None
    for step, *counts in zip(columns["step"], *(columns[n] for n in _CONTACTS)):
        if step > 0 and any(counts):
            return step
    return None


def _draw_panel(axes, lines, tokens, column):
    drawn = False
    for token, columns in lines:
        steps, errors = csv_columns.finite_pairs(columns["step"], columns[column], 0)
        if not steps:
            continue
        drawn = True
        colour, marker = type_style.line_style(token, tokens)
        axes.plot(
            steps,
            errors,
            color=colour,
            marker=marker,
            # Markers at some points: they tell the lines apart where colours do not.
            markevery=(0.02 * tokens.index(token), 0.15),
            markersize=3,
            label=token,
        )
        split = _contacts_differ_from(columns)
        if split is not None:
            axes.axvline(split, color=colour, linestyle=":", linewidth=0.8)
    if drawn:
        axes.set_xscale("log")
        figure_style.log_axis(axes.yaxis)
    return drawn


def draw(scenes):
    """Yield (name, caption, figure) for each scene that was compared."""
    for scene in scenes.names:
        lines = scenes.of(scenes.divergences, scene)
        if not lines:
            continue
        figure, panels = figure_style.panels(2, 7.0, 3.2)
        figure.subplots_adjust(wspace=0.3)
        drawn = [
            _draw_panel(axes, lines, scenes.type_tokens, column)
            for axes, (column, _) in zip(panels, _PANELS)
        ]
        for axes, (_, label) in zip(panels, _PANELS):
            axes.set_xlabel("step")
            axes.set_ylabel(label)
        if any(drawn):
            panels[drawn.index(True)].legend(
                loc="lower left",
                bbox_to_anchor=(0, 1.0),
                ncol=figure_style.legend_columns(7),
                columnspacing=1.0,
            )
            yield f"{FAMILY}_{scene}", _CAPTION % scene, figure
        else:
            pyplot.close(figure)
