"""What the errors of an integrator at falling steps say together: its measured order, and the floor that it reaches."""
import math
import statistics
from dataclasses import dataclass

from ulpgate_report.values import numbers, type_order

# Where the last step lowers the error by less than this share of the order, the floor is reached.
_FALLING = 0.5
# A point is clear of the floor where its error is this many times the smallest.
_CLEAR = 100
# The order is the median of so many of the smallest steps before the floor; at larger ones the limit is not yet reached.
_POINTS = 4


@dataclass(frozen=True)
class Convergence:
    """One integrator, type and problem: (dt, error) with the largest step first, finite errors alone.

    `clear` are the points before the rounding floor. `measured` is None where fewer than two points are clear of the
    floor; `floor` where none was reached.
    """

    problem: str
    integrator: str
    order: float
    type: str
    points: tuple
    clear: tuple
    measured: object
    smallest: object
    floor: object


def _clear(rows, floor):
    """The rows before the floor: beyond it roundings grow again with the number of steps."""
    if floor is None:
        return rows
    lowest = next(i for i, row in enumerate(rows) if row["error"] == floor)
    return [row for row in rows[:lowest] if row["error"] > _CLEAR * floor]


def _measured(clear):
    """The median of the recorded orders next to the limit."""
    found = [numbers.signed(row["measured_order"]) for row in clear]
    found = [order for order in found if order is not None and math.isfinite(order)]
    return statistics.median(found[-_POINTS:]) if found else None


def _floor(points, order):
    """The smallest error where the steps went so far down that the error stopped falling, else None."""
    if len(points) < 2:
        return None
    smallest = min(error for _, error in points)
    (dt, error), (next_dt, next_error) = points[-2:]
    demanded = (next_dt / dt) ** (_FALLING * order)
    stopped = next_error > smallest or next_error > error * demanded
    return smallest if stopped else None


def _convergence(rows):
    rows = sorted(rows, key=lambda row: -row["dt"])
    kept = [
        row
        for row in rows
        if isinstance(row["error"], (int, float)) and row["error"] > 0
    ]
    points = tuple((row["dt"], float(row["error"])) for row in kept)
    floor = _floor(points, rows[0]["order"])
    clear = _clear(kept, floor)
    first = rows[0]
    return Convergence(
        problem=first["problem"],
        integrator=first["integrator"],
        order=first["order"],
        type=first["type"],
        points=points,
        clear=tuple((row["dt"], float(row["error"])) for row in clear),
        measured=_measured(clear),
        smallest=min((error for _, error in points), default=None),
        floor=floor,
    )


def convergences(rows):
    """All of them, by problem, order and integrator, the types in display order."""
    grouped = {}
    for row in rows:
        key = (row["problem"], row["integrator"], row["type"])
        grouped.setdefault(key, []).append(row)
    types = type_order.ordered(row["type"] for row in rows)
    found = map(_convergence, grouped.values())
    key = lambda c: (c.problem, c.order, c.integrator, types.index(c.type))
    return sorted(found, key=key)


def unit_roundoff(token, bits):
    """Half a ULP at 1 of a type, None where its significand is not known."""
    if token not in bits:
        return None
    # Below the smallest double no error in a record can be either.
    return 2.0 ** -bits[token] or None
