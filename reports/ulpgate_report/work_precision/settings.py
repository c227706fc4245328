"""What the measured settings say together: curves that break where a setting failed, and the front of the best."""
import math
from dataclasses import dataclass

from ulpgate_report.values import numbers, time_step, type_order
from ulpgate_report.work_precision import axes

KINDS = ("function", "kernel", "trajectory", "scene")
# Of these a line of the records is a subject by itself; of the others one setting out of many.
OF_SUBJECTS = ("function", "kernel")
# So the step of a setting begins whose steps are a plan, made to a tolerance.
PLAN = "plan:"
_KNOWN_BITS = {"float": 24, "double": 53, "long_double": 64, "float128": 113}
_SMALLEST_DOUBLE_BITS = 1074
# Types share the error of a step in all but its last digits: a dearer type that gains no more than this is no better.
GAIN = 0.02


@dataclass(frozen=True)
class Measured:
    """The settings in display order, fits, bits of the types, and the pairs of axes that were asked for."""

    rows: tuple
    fits: tuple
    bits: dict
    pairs: tuple
    untold: int = 0

    @property
    def type_tokens(self):
        """All types in display order."""
        return type_order.ordered(row["type"] for row in self.rows)

    def subjects(self, kinds):
        """[(kind, name)] of some kinds in display order."""
        found = ((row["subject"], row["name"]) for row in self.rows)
        return [key for key in dict.fromkeys(found) if key[0] in kinds]

    def of_kind(self, kind, name=None):
        """The settings of one problem, scene, kernel or function, or of all of a kind."""
        return [
            row
            for row in self.rows
            if row["subject"] == kind and name in (None, row["name"])
        ]

    def roundoff(self, token):
        """u = 2^-p of a type with p significand bits; None where p is not known or u below a double."""
        bits = self.bits.get(token)
        return 2.0**-bits if bits and bits < _SMALLEST_DOUBLE_BITS else None


def tolerance(row):
    """The tolerance of the plan that a setting's steps follow, `plan:1e-6`; None where its steps are equal."""
    text = row.get("dt_text") or ""
    return time_step.seconds(text.removeprefix(PLAN)) if text.startswith(PLAN) else None


def method(row):
    """What is one curve over its steps: the integrator, with planned steps another one than with equal ones."""
    name = row.get("integrator") or ""
    is_planned = row.get("planned") or tolerance(row) is not None
    return f"{name}, planned" if is_planned else name


def _place(row, tokens):
    steps = row.get("steps")
    size = tolerance(row) or row.get("dt")
    return (
        KINDS.index(row["subject"]),
        row["name"],
        tokens.index(row["type"]),
        method(row),
        # From cheap to expensive: the largest step or tolerance first, then by the number of steps.
        -size if size is not None else 0.0,
        steps if steps is not None else 0,
    )


def made_of(found, pairs=()):
    """The settings of a run."""
    tokens = type_order.ordered(row["type"] for row in found.rows)
    rows = sorted(found.rows, key=lambda row: _place(row, tokens))
    return Measured(
        tuple(rows),
        tuple(sorted(found.fits, key=fit_key)),
        {**_KNOWN_BITS, **found.bits},
        tuple(pairs),
        found.untold,
    )


def fit_key(fit):
    """Display order of fits."""
    known = type_order.KNOWN
    token = fit["type"]
    place = known.index(token) if token in known else len(known)
    return (
        KINDS.index(fit["subject"]),
        fit["name"],
        method(fit),
        place,
        token,
        fit["error"],
    )


def has_failed(row):
    """Whether a setting came to nothing that could be compared."""
    error = axes.value(row, "error")
    return bool(row.get("failure")) or error == numbers.INFINITE


def point(row, pair):
    """(x, y) of a setting that did not fail, None where it did or a value is missing."""
    if has_failed(row):
        return None
    found = tuple(axes.value(row, name) for name in pair)
    usable = all(one is not None and math.isfinite(one) for one in found)
    # A logarithm of no seconds or steps does not exist; an error may be exactly 0.
    zeros = (
        one == 0 and not axes.QUANTITIES[name].is_error
        for one, name in zip(found, pair)
    )
    return found if usable and not any(zeros) else None


def curves(rows):
    """{(type, method): its settings}, in display order."""
    found = {}
    for row in rows:
        found.setdefault((row["type"], method(row)), []).append(row)
    return found


def segments(rows, pair):
    """The pieces of a curve: lists of points, broken where a setting failed or has no value."""
    found, piece = [], []
    for row in rows:
        at = point(row, pair)
        if at is not None:
            piece.append(at)
        elif piece:
            found.append(piece)
            piece = []
    return [*found, piece] if piece else found


def front(rows, pair):
    """The settings that no other betters in both quantities (Pareto), by the first of them; of equal ones the first.

    A dearer setting is on it where it lowers the error, of the two the first quantity that is one, by more than GAIN;
    one with an error of 1 and more never is.
    """
    gain = next((i for i, name in enumerate(pair) if axes.QUANTITIES[name].is_error), 0)
    cheaper_is_less = not axes.QUANTITIES[pair[1 - gain]].larger_is_better
    better_is_less = not axes.QUANTITIES[pair[gain]].larger_is_better
    found = []
    for index, row in enumerate(rows):
        at = point(row, pair)
        if at is not None and not (
            axes.QUANTITIES[pair[gain]].is_error and at[gain] >= 1
        ):
            cost, error = at[1 - gain], at[gain]
            cost = cost if cheaper_is_less else 1 / cost
            found.append((cost, error if better_is_less else 1 / error, index))
    best, lowest = [], numbers.INFINITE
    for _, error, index in sorted(found):
        if error < lowest * (1 - GAIN):
            best.append(rows[index])
            lowest = error
    return sorted(best, key=lambda row: point(row, pair)[0])


def drawn_pairs(measured, rows):
    """[(pair, what is added to a figure's name, sentence)] that settings are drawn with.

    Where nothing was asked for and nothing was timed, counts stand for the seconds.
    """
    if measured.pairs:
        return [
            (pair, "" if pair == axes.DEFAULT else "_".join(pair), "")
            for pair in measured.pairs
        ]
    if any(axes.value(row, "seconds") for row in rows):
        return [(axes.DEFAULT, "", "")]
    for name in axes.INSTEAD_OF_SECONDS:
        if any(axes.value(row, name) for row in rows):
            said = f" Nothing was timed: {name} stand for the time."
            return [((axes.DEFAULT[0], name), "", said)]
    return []
