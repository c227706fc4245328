"""A scale with the empty stretches cut out, so that clusters far apart stay readable side by side."""
from dataclasses import dataclass

# Around each value this much is kept, and an empty stretch longer than GAP is drawn as CUT; in the scale's units.
MARGIN = 1.0
GAP = 3.0
CUT = 1.5


@dataclass(frozen=True)
class CutScale:
    """Stretches of the original scale, ascending, each with the position where it is drawn."""

    stretches: tuple

    def position(self, value):
        """Where a value of one of the stretches is drawn."""
        for low, high, start in self.stretches:
            if value <= high:
                return start + (max(value, low) - low)
        low, high, start = self.stretches[-1]
        return start + (high - low)

    @property
    def length(self):
        """Length of the whole drawn scale."""
        low, high, start = self.stretches[-1]
        return start + high - low

    @property
    def cuts(self):
        """(from, to) of each cut, as positions."""
        ends = [start + high - low for low, high, start in self.stretches]
        return [(end, s[2]) for end, s in zip(ends, self.stretches[1:])]

    def ticks(self, step):
        """Multiples of `step` in every stretch, at least one multiple of 1 in each."""
        found = []
        for low, high, _ in self.stretches:
            first = -(-low // 1)
            inside = [first + n for n in range(int(high - first) + 1)]
            found += [v for v in inside if v % step == 0] or inside[:1]
        return found


def make(values):
    """The scale that shows `values`, which must not be empty."""
    merged = []
    for value in sorted(values):
        low, high = value - MARGIN, value + MARGIN
        if merged and low - merged[-1][1] <= GAP:
            merged[-1][1] = max(high, merged[-1][1])
        else:
            merged.append([low, high])
    start, stretches = 0.0, []
    for low, high in merged:
        stretches.append((low, high, start))
        start += high - low + CUT
    return CutScale(tuple(stretches))
