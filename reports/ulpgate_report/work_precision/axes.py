"""What error against run time can be drawn with: the quantities by name, their values, their logarithmic scales."""
import math
from dataclasses import dataclass

from ulpgate_report.figures import cut_scale, figure_style
from ulpgate_report.values import numbers


@dataclass(frozen=True)
class Quantity:
    """A quantity of a setting; `fields` are tried in turn. Of `dt` the larger one is the cheaper.

    Those `of_runs` are of a problem or scene: functions and kernels have none. `unit` is empty of a count, and of the
    step of a problem, which has its own.
    """

    name: str
    title: str
    fields: tuple
    is_error: bool = False
    larger_is_better: bool = False
    of_runs: bool = False
    unit: str = ""

    def label(self, unit=None):
        """What stands at an axis."""
        unit = self.unit if unit is None else unit
        return f"{self.title} ({unit})" if unit else self.title


QUANTITIES = {
    quantity.name: quantity
    for quantity in (
        Quantity(
            "error", "error", ("final_error", "largest_error"), True, unit="relative"
        ),
        Quantity(
            "largest_error", "largest error", ("largest_error",), True, unit="relative"
        ),
        Quantity(
            "energy_error", "energy error", ("energy_error",), True, unit="relative"
        ),
        Quantity("seconds", "time", ("seconds",), unit="s"),
        Quantity("steps", "steps", ("steps",), of_runs=True),
        Quantity("evaluations", "evaluations", ("evaluations",), of_runs=True),
        Quantity(
            "dt",
            "step",
            ("dt",),
            larger_is_better=True,
            of_runs=True,
            unit="the problem's time",
        ),
    )
}
DEFAULT = ("error", "seconds")
# Where nothing was timed: what is drawn instead, the first that there is.
INSTEAD_OF_SECONDS = ("evaluations", "steps")


def pair(text):
    """("error", "seconds") of `error,seconds`; ValueError says what is wrong."""
    names = tuple(text.split(","))
    wrong = [name for name in names if name not in QUANTITIES]
    if len(names) != 2 or wrong or names[0] == names[1]:
        known = ", ".join(QUANTITIES)
        raise ValueError(f"'{text}' is not two of {known}, with a comma between")
    return names


def value(row, name):
    """A quantity of a setting: positive, 0, inf where an error is infinite or no number, None where there is none."""
    quantity = QUANTITIES[name]
    if quantity.of_runs and not row.get("integrator"):
        return None
    for field in quantity.fields:
        found = numbers.signed(row.get(field))
        if found is not None:
            if quantity.is_error and not math.isfinite(found):
                return numbers.INFINITE
            usable = math.isfinite(found) and found >= 0
            return found if usable else None
    return None


@dataclass(frozen=True)
class Scale:
    """Where values of a quantity are drawn: decimal logarithms; of errors, empty stretches are cut out.

    Beside the scale of an error there is a column for exact results and one for failed settings.
    """

    cut: object
    low: float
    high: float
    exact: object = None
    failed: object = None

    def shows(self, found):
        """Whether a value lies in what is drawn."""
        found = math.log10(found)
        if self.cut is None:
            return self.low <= found <= self.high
        return any(low <= found <= high for low, high, _ in self.cut.stretches)

    def position(self, found):
        """Where a value is drawn; an infinite one in the column of what failed."""
        if found == 0:
            return self.exact
        if not math.isfinite(found):
            return self.failed
        found = math.log10(found)
        return found if self.cut is None else self.cut.position(found)


# Of labels such as 10^-150, on each axis.
_LABEL_INCHES = {"x": 0.33, "y": 0.15}
# Distance of the columns `exact` and `failed` from the scale, in decades.
_COLUMN = 1.0


def _error_scale(finite, floors, is_exact, has_failed):
    levels = [math.log10(found) for found in (*finite, *floors)] or [-16.0]
    cut = cut_scale.make(levels)
    share = _COLUMN * max(1.0, cut.length / 25)
    exact = -share if is_exact else None
    failed = cut.length + share if has_failed else None
    low = -0.4 * share if exact is None else exact - 0.6 * share
    high = cut.length if failed is None else failed + 0.6 * share
    return Scale(cut, low, high, exact, failed)


def scale_of(name, values, floors=(), has_failed=False):
    """The scale that shows all finite `values`, and of an error the `floors` too."""
    finite = [found for found in values if 0 < found < numbers.INFINITE]
    if QUANTITIES[name].is_error:
        has_failed = has_failed or numbers.INFINITE in values
        return _error_scale(finite, floors, 0 in values, has_failed)
    levels = [math.log10(found) for found in finite] or [0.0]
    low, high = min(levels), max(levels)
    if high - low < 4:
        # A decade at least, so that two ticks say what the scale is.
        low, high = math.floor(low - 0.02), math.ceil(high + 0.02)
    else:
        margin = 0.04 * (high - low)
        # Below the cheapest setting there is room for a name.
        low, high = low - 2 * margin, high + margin
    return Scale(None, low, high)


def _ticks(scale, most):
    if scale.cut is None:
        step = figure_style.log10_tick_step(scale.high - scale.low, most)
        first = math.ceil(scale.low / step)
        ticks = [step * n for n in range(first, math.floor(scale.high / step) + 1)]
        return {float(n): figure_style.power_of_ten(n) for n in ticks}
    step = figure_style.log10_tick_step(scale.cut.length, most)
    found = {scale.cut.position(n): int(n) for n in scale.cut.ticks(step)}
    return {at: figure_style.power_of_ten(n) for at, n in found.items()}


def _gap(axis, scale):
    """How far apart labels of an axis have to be, in its units."""
    box, (width, height) = axis.axes.get_position(), axis.figure.get_size_inches()
    is_x = axis.axis_name == "x"
    inches = box.width * width if is_x else box.height * height
    return (scale.high - scale.low) * _LABEL_INCHES[axis.axis_name] / inches


def _apart(ticks, columns, gap):
    """The ticks that are a gap away from those of the columns, which are words, and from each other."""
    kept = {}
    for at, text in sorted(ticks.items()):
        near_column = any(abs(at - column) < 1.15 * gap for column in columns)
        if not near_column and all(at - other >= gap for other in kept):
            kept[at] = text
    return {**kept, **columns}


def label(axis, name, scale, most=8, unit=None):
    """Limits, ticks and title of one axis of a plot, with its unit or another; cuts are grey bands."""
    axes = axis.axes
    ticks = _ticks(scale, most)
    if scale.cut is not None:
        columns = {scale.exact: "exact", scale.failed: "failed"}
        columns.pop(None, None)
        ticks = _apart(ticks, columns, _gap(axis, scale))
    axis.set_ticks(list(ticks), list(ticks.values()))
    limits = (scale.low, scale.high)
    axis.set_label_text(QUANTITIES[name].label(unit))
    if axis.axis_name == "x":
        axes.set_xlim(*limits)
    else:
        axes.set_ylim(*limits)
    if scale.cut is not None:
        band = axes.axvspan if axis.axis_name == "x" else axes.axhspan
        for low, high in scale.cut.cuts:
            band(low, high, facecolor="0.93", edgecolor="none", zorder=0)
    elif scale.high - scale.low < 3.5:
        decades = range(math.floor(scale.low), math.ceil(scale.high))
        minor = [n + math.log10(k) for n in decades for k in range(2, 10)]
        inside = [at for at in minor if scale.low < at < scale.high]
        axis.set_ticks(inside, minor=True)
