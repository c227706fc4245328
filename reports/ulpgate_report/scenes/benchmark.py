"""Iterations per second and slowdown of each scene, type and number of threads, the published numbers beside."""
import math
from dataclasses import dataclass

from ulpgate_report.values import type_order

# Kozicki, Gladky, Thoeni, CPC 2022: gravity deposition, relative to double, 16 threads.
PAPER_SLOWDOWN = {
    "float": 0.99,
    "double": 1.0,
    "long_double": 1.4,
    "float128": 4.7,
    "mpfr62": 13.5,
    "mpfr150": 19.1,
    "cpp_bin_float62": 24.2,
}
PAPER_SCENE = "deposition"


@dataclass(frozen=True)
class Bar:
    """One scene, type and number of threads; None or NaN where it cannot be told."""

    timing: dict
    slowdown: object
    slowdown_deviation: float
    paper_slowdown: object


def _bar(timing, reference):
    """The slowdown as recorded, else against `reference`; deviations combine as of independent means."""
    slowdown = timing.get("slowdown_against_double")
    speed = timing["iterations_per_s"]
    deviation = math.nan
    if slowdown is None and reference is not None:
        slowdown = reference["iterations_per_s"] / speed
    # Double against itself has none.
    if None not in (slowdown, reference) and reference is not timing:
        shares = [t["deviation"] / t["iterations_per_s"] for t in (timing, reference)]
        deviation = slowdown * math.hypot(*shares)
    of_paper = PAPER_SCENE in timing["scene"]
    paper = PAPER_SLOWDOWN.get(timing["type"]) if of_paper else None
    return Bar(timing, slowdown, deviation, paper)


def bars(scenes):
    """All bars, by scene, threads and type."""
    timings = scenes.timings
    names = list(dict.fromkeys(t["scene"] for t in timings))
    types = type_order.ordered(t["type"] for t in timings)
    key = lambda t: (names.index(t["scene"]), t["threads"], types.index(t["type"]))
    of_double = {
        (t["scene"], t["threads"]): t for t in timings if t["type"] == "double"
    }
    return [
        _bar(t, of_double.get((t["scene"], t["threads"])))
        for t in sorted(timings, key=key)
    ]
