"""What the errors of an integrator at falling steps say together: its measured order, and the floor that it reaches."""
import math
import statistics
from dataclasses import dataclass

from ulpgate_report.values import numbers, type_order

# Where the last step lowers the error by less than this share of the order, the floor is reached.
_FALLING = 0.5
# An error of so few u is made of the last roundings alone: the floor is reached, whatever the steps before say.
ROUNDINGS = 4
# A point is clear where its error is this many times the floor and u: a rounding of u changes the order there by 0.015.
CLEAR = 100
# The order is the median of so many of the smallest steps before the floor; at larger ones the limit is not yet reached.
POINTS = 4


@dataclass(frozen=True)
class Convergence:
    """One integrator, type and problem: (dt, error) with the largest step first, finite errors alone.

    `clear` are the points before the rounding floor. `measured` is the median of `pairs` orders, None where fewer than two
    points are clear; `smallest` is the least error and `smallest_dt` the largest step that has it; `floor` is None where
    none was reached.
    """

    problem: str
    integrator: str
    order: float
    type: str
    points: tuple
    clear: tuple
    measured: object
    pairs: int
    smallest: object
    smallest_dt: object
    floor: object

    @property
    def drawn(self):
        """The points that a logarithmic axis has a place for."""
        return tuple(point for point in self.points if point[1] > 0)


def _points(rows):
    return tuple((row["dt"], float(row["error"])) for row in rows)


def _level(floor, unit):
    """The size of the roundings: the floor, but of so few u that it is luck, u."""
    unit, floor = unit or 0, floor or 0
    return floor if floor > ROUNDINGS * unit else unit


def _is_clear(points, floor, unit):
    """For each point whether it is before the floor: beyond it roundings grow again with the number of steps."""
    errors = [error for _, error in points]
    end = len(errors) if floor is None else errors.index(floor)
    limit = CLEAR * _level(floor, unit)
    return [i < end and error > limit for i, error in enumerate(errors)]


def _recorded(rows, clear):
    """The recorded orders next to the limit, of steps that are clear together with the one before."""
    found = [
        numbers.signed(row["measured_order"])
        for row, before, is_clear in zip(rows[1:], clear, clear[1:])
        if before and is_clear
    ]
    finite = [one for one in found if one is not None and math.isfinite(one)]
    return finite[-POINTS:]


def _floor(points, order, unit):
    """The smallest error where it is 0, a few u, or the error stopped falling at the smallest steps, else None."""
    smallest = min((error for _, error in points), default=None)
    if smallest is None or smallest <= ROUNDINGS * (unit or 0):
        return smallest
    if len(points) < 2:
        return None
    (dt, error), (next_dt, next_error) = points[-2:]
    demanded = (next_dt / dt) ** (_FALLING * order)
    stopped = next_error > smallest or next_error > error * demanded
    return smallest if stopped else None


def _convergence(rows, bits):
    rows = sorted(rows, key=lambda row: -row["dt"])
    kept = [row for row in rows if isinstance(row["error"], (int, float))]
    first, points = rows[0], _points(kept)
    unit = unit_roundoff(first["type"], bits)
    floor = _floor(points, first["order"], unit)
    clear = _is_clear(points, floor, unit)
    recorded = _recorded(kept, clear)
    # Of several such steps the largest, which is the first.
    dt, smallest = min(points, key=lambda point: point[1], default=(None, None))
    return Convergence(
        problem=first["problem"],
        integrator=first["integrator"],
        order=first["order"],
        type=first["type"],
        points=points,
        clear=tuple(point for point, is_clear in zip(points, clear) if is_clear),
        measured=statistics.median(recorded) if recorded else None,
        pairs=len(recorded),
        smallest=smallest,
        smallest_dt=dt,
        floor=floor,
    )


def convergences(rows, bits):
    """All of them, by problem, order and integrator, the types in display order; `bits` are the significands' by type."""
    grouped = {}
    for row in rows:
        key = (row["problem"], row["integrator"], row["type"])
        grouped.setdefault(key, []).append(row)
    types = type_order.ordered(row["type"] for row in rows)
    found = [_convergence(same, bits) for same in grouped.values()]
    key = lambda c: (c.problem, c.order, c.integrator, types.index(c.type))
    return sorted(found, key=key)


def unit_roundoff(token, bits):
    """Half a ULP at 1 of a type, None where its significand is not known."""
    if token not in bits:
        return None
    # Below the smallest double no error in a record can be either.
    return 2.0 ** -bits[token] or None
