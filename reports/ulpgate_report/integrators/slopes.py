"""Straight lines of the orders in theory through a panel of curves, each with its number at a place of its own."""
import math

import numpy

# What a digit and a line of the numbers take, and how far they stay from curves, in inches.
SIZE = 6.5
_DIGIT, _HEIGHT, _GAP = 0.062, 0.085, 0.035
_STEP = 0.02
_STYLE = {"color": "0.45", "linestyle": ":", "linewidth": 0.7, "zorder": 1}


def anchor(found):
    """The point (log10 dt, log10 error) that a slope is drawn through: the middle of those before the floor."""
    dt, error = found.clear[len(found.clear) // 2]
    return math.log10(dt), math.log10(error)


def _is_near(points, place, reach):
    """Whether one of `points`, rows of (x, y), lies within `reach` of the place, along each axis."""
    return bool((numpy.abs(points - place) < reach).all(axis=1).any())


class Panel:
    """A panel in inches: where the curves are, and what numbers stand there already."""

    def __init__(self, axes, limits, inches):
        self._axes = axes
        (self._left, self._right), (self._bottom, self._top) = limits
        self._scale = (
            inches[0] / (self._right - self._left),
            inches[1] / (self._top - self._bottom),
        )
        self._inches = inches
        self._curves, self._boxes = numpy.empty((0, 2)), []

    def _at(self, x, y):
        return (x - self._left) * self._scale[0], (y - self._bottom) * self._scale[1]

    def _along(self, start, end):
        """Points of a straight line at short distances."""
        (x, y), (to_x, to_y) = start, end
        count = max(1, math.ceil(math.hypot(to_x - x, to_y - y) / _STEP))
        return [
            (x + (to_x - x) * n / count, y + (to_y - y) * n / count)
            for n in range(count + 1)
        ]

    def keep_clear(self, points):
        """No number may stand on the curve through these points."""
        placed = [self._at(*point) for point in points]
        curve = list(placed)
        for start, end in zip(placed, placed[1:]):
            curve += self._along(start, end)
        self._curves = numpy.vstack([self._curves, numpy.reshape(curve, (-1, 2))])

    def _line(self, found):
        """Both ends of the slope, from edge to edge of the panel, in inches."""
        x, y = anchor(found)
        low = max(self._left, x - (y - self._bottom) / found.order)
        high = min(self._right, x + (self._top - y) / found.order)
        return [self._at(at, y + found.order * (at - x)) for at in (low, high)]

    def _is_free(self, box):
        (x, y), (half, tall) = box
        width, height = self._inches
        edge = half + _GAP, tall + _GAP
        inside = edge[0] < x < width - edge[0] and edge[1] < y < height - edge[1]
        return (
            inside
            and not _is_near(self._curves, (x, y), edge)
            and not any(
                abs(x - at) < half + other + _GAP and abs(y - up) < tall + its + _GAP
                for (at, up), (other, its) in self._boxes
            )
        )

    def _candidates(self, points, size):
        """(0 on the line, which it breaks, 1 below, 2 above; how far from an end; place)."""
        (x, y), (to_x, to_y) = points[0], points[-1]
        long = math.hypot(to_x - x, to_y - y)
        across, up = (y - to_y) / long, (to_x - x) / long
        # So far the box is clear of what lies on the line.
        aside = abs(across) * (size[0] + _GAP) + abs(up) * (size[1] + _GAP) + 0.01
        for side, sign in enumerate((0, -1, 1)):
            for index, (at, high) in enumerate(points):
                from_end = min(index, len(points) - 1 - index)
                yield side, from_end, (
                    at + sign * aside * across,
                    high + sign * aside * up,
                )

    def _place(self, text, points, others):
        """The free place on the line that the fewest others cross; else one beside it, near to no other; None without any.

        Of several the nearest to an end.
        """
        size = (len(text) * _DIGIT / 2, _HEIGHT / 2)
        free = []
        for side, from_end, (x, y) in self._candidates(points, size):
            if not self._is_free(((x, y), size)):
                continue
            # Beside a line, a number must not seem to be that of the next.
            gap = 3 * _GAP if side else 0
            reach = size[0] + gap, size[1] + gap
            crossed = sum(_is_near(line, (x, y), reach) for line in others)
            if not (side and crossed):
                free.append((side, crossed, from_end, (x, y)))
        if not free:
            return None
        place = min(free)[-1]
        self._boxes.append((place, size))
        return place

    def draw(self, slopes):
        """Every slope that a number has a place on: where none is free, the line would be without a meaning."""
        lines = [self._along(*self._line(found)) for found in slopes]
        arrays = [numpy.array(line) for line in lines]
        for index, (found, points) in enumerate(zip(slopes, lines)):
            text = f"{found.order:g}"
            place = self._place(text, points, arrays[:index] + arrays[index + 1 :])
            if place is None:
                continue
            ends = [self._back(*point) for point in (points[0], points[-1])]
            self._axes.plot(*zip(*ends), **_STYLE)
            box = {"facecolor": "white", "edgecolor": "none", "pad": 0.6}
            self._axes.text(
                *self._back(*place),
                text,
                size=SIZE,
                ha="center",
                va="center_baseline",
                zorder=1.5,
                bbox=box,
            )

    def _back(self, x, y):
        return self._left + x / self._scale[0], self._bottom + y / self._scale[1]
