"""Bits lost against bits that the condition puts at risk: ill-conditioned lies on the diagonal, unstable above it."""
from matplotlib import pyplot
from matplotlib.lines import Line2D

from ulpgate_report.figures import figure_style
from ulpgate_report.kernels.combine import UNSTABLE
from ulpgate_report.values import numbers

NAME = "kernel_condition"
CAPTION = (
    "Bits lost, log2 of the largest normwise error in units of roundoff 2^-p, against bits that the condition number of "
    "that state puts at risk, both as a share of the p bits of the type; a point for each quantity, type and stratum "
    "with an error above half a unit. Line: all that is lost was at risk; points on or below it are ill-conditioned at "
    "most, and 1 is the loss of every bit. Ringed and named: what the verdict calls unstable."
)
_MOST_NAMES = 12
_LOG10_OF_2 = numbers.log10(2)
WIDTH_INCHES = 6.0


def points(combined):
    """[(type index, share at risk, share lost, record)] of all finite pairs."""
    found = []
    place = {entry["token"]: i for i, entry in enumerate(combined.types)}
    for record in combined.records:
        error = numbers.measured(record["max_normwise"])
        condition = numbers.measured(record["condition"])
        if error is None or condition is None or error < 0.5:
            continue
        if numbers.INFINITE in (error, condition):
            continue
        index = place[record["type"]]
        all_bits = combined.types[index]["significand_bits"] * _LOG10_OF_2
        # A condition below 1 excuses nothing.
        at_risk = numbers.log10(max(1, condition)) / all_bits
        found.append((index, at_risk, numbers.log10(error) / all_bits, record))
    return found


def _mark_unstable(axes, found):
    ringed = [point for point in found if point[3]["verdict"] == UNSTABLE]
    axes.plot(
        [p[1] for p in ringed],
        [p[2] for p in ringed],
        marker="o",
        markersize=8,
        markerfacecolor="none",
        markeredgecolor=figure_style.MISMATCH_COLOUR,
        linestyle="none",
    )
    named = sorted(ringed, key=lambda point: point[1] - point[2])[:_MOST_NAMES]
    # The names stand in a column beside the plot: the points themselves may lie on each other.
    low, high = axes.get_ylim()
    height = 1.0
    for _, x, y, r in sorted(named, key=lambda point: -point[2]):
        text = f"{r['function']} {r['part']},\n{r['type']}, {r['stratum']}"
        height = min(height - 0.085, (y - low) / (high - low))
        axes.annotate(
            text,
            (x, y),
            xytext=(1.03, height),
            textcoords="axes fraction",
            size=6,
            va="center",
            color="0.2",
            arrowprops={"arrowstyle": "-", "color": "0.6", "lw": 0.5, "shrinkB": 4},
        )


def draw(combined):
    """(name, caption, figure); no figure where no error is finite and above half a unit."""
    found = points(combined)
    if not found:
        return NAME, CAPTION, None
    figure, axes = pyplot.subplots(figsize=(figure_style.width(WIDTH_INCHES), 4.6))
    handles = []
    for index, token in enumerate(combined.type_tokens):
        mine = [point for point in found if point[0] == index]
        style = {
            "marker": figure_style.marker(index),
            "color": figure_style.colour(index),
            "linestyle": "none",
            "markersize": 3.5,
            "markeredgecolor": "white",
            "markeredgewidth": 0.25,
        }
        # Thousands of points: pixels inside the vector files keep them small.
        axes.plot([p[1] for p in mine], [p[2] for p in mine], rasterized=True, **style)
        handles.append(Line2D([], [], label=token, **style))
    low = min(p[2] for p in found)
    right = max(1.0, *(p[1] for p in found))
    axes.plot([low, right], [low, right], color="0.2", lw=0.8, zorder=1)
    _mark_unstable(axes, found)
    axes.set_xlabel("bits at risk, log2(condition) / p")
    axes.set_ylabel("bits lost, log2(error / u) / p")
    axes.legend(
        handles=handles,
        loc="lower left",
        bbox_to_anchor=(0, 1.0),
        ncol=figure_style.legend_columns(min(4, len(handles))),
        columnspacing=1.0,
        handletextpad=0.2,
    )
    return NAME, CAPTION, figure
