"""Tests of curves that break, fronts, axes and their scales."""
import itertools
import math

import pytest

from ulpgate_report.records import work_precision_records
from ulpgate_report.testing import sample_work_precision as sample
from ulpgate_report.work_precision import axes, settings

TOKENS = ("float", "double", "mpfr62")
PAIR = axes.DEFAULT


def measured_of(rows, pairs=()):
    """Settings as a report has them."""
    found = work_precision_records.WorkPrecision(tuple(rows), (), {}, 0)
    return settings.made_of(found, pairs)


def test_curves_break_where_a_setting_failed():
    rows = [
        sample.timed(None, 1.0, failure="diverged"),
        sample.timed(1e-3, 2.0),
        sample.timed(1e-4, 3.0),
        sample.timed("nan", 4.0),
        sample.timed(None, 5.0),
        sample.timed(1e-6, 6.0),
        sample.timed(1e-7, None),
        sample.timed(0, 7.0),
        sample.timed(1e-8, 0.0),
    ]
    found = settings.segments(rows, PAIR)
    assert found == [[(1e-3, 2.0), (1e-4, 3.0)], [(1e-6, 6.0)], [(0, 7.0)]]
    assert [settings.has_failed(row) for row in rows[:5]] == [
        True,
        False,
        False,
        True,
        False,
    ]


def test_planned_steps_are_curves_of_their_own():
    def planned(text, steps):
        changes = {"dt_text": text, "planned": True}
        return {**sample.timed(1e-6, 1.0, steps=steps), **changes}

    rows = [planned("plan:1e-9", 90), sample.timed(1e-3, 1.0), planned("plan:1e-6", 60)]
    rows = measured_of(rows).rows
    assert [settings.tolerance(row) for row in rows] == [None, 1e-6, 1e-9]
    assert list(settings.curves(rows)) == [
        ("double", "leapfrog"),
        ("double", "leapfrog, planned"),
    ]
    fits = [
        sample.fit("kepler", "leapfrog", "double", **how)
        for how in ({"planned": True}, {})
    ]
    found = work_precision_records.WorkPrecision((), tuple(fits), {}, 0)
    ordered = settings.made_of(found).fits
    assert [settings.method(fit) for fit in ordered] == [
        "leapfrog",
        "leapfrog, planned",
    ]
    scene = sample.of_run("scene", "deposition", "double", "leapfrog", 10, 1e-3)
    assert settings.tolerance(scene) is None, "a scene's step is text too"


@pytest.mark.parametrize(
    "points, expected, why",
    [
        ([], [], "nothing"),
        ([(1e-3, 1.0)], [0], "one point"),
        ([(1e-3, 1.0), (1e-3, 1.0)], [0], "of equal ones the first"),
        ([(1e-3, 1.0), (1e-4, 2.0), (1e-5, 3.0)], [2, 1, 0], "by error"),
        ([(1e-3, 1.0), (1e-2, 2.0)], [0], "dearer and worse"),
        ([(1e-3, 1.0), (0.999e-3, 9.0)], [0], "a gain of a thousandth is none"),
        ([(1e-3, 1.0), (0, 9.0)], [1, 0], "exact"),
        ([("inf", 0.5), (1e-3, 1.0), ("nan", 0.1)], [1], "failed ones never"),
        ([(1.0, 0.5), (0.99, 1.0)], [1], "an error of 1 says nothing"),
    ],
)
def test_front(points, expected, why):
    rows = [sample.timed(*point) for point in points]
    found = settings.front(rows, PAIR)
    assert [
        next(i for i, r in enumerate(rows) if r is f) for f in found
    ] == expected, why


def test_front_agrees_with_its_definition():
    rows, times = sample.settings("kepler", TOKENS, sample.INTEGRATORS[:5])
    rows = [row for row in rows if not row["failure"]]
    for row, time in zip(rows, times, strict=True):
        row["seconds"] = time["seconds"]
    points = [at for at in (settings.point(row, PAIR) for row in rows) if at]
    best = [settings.point(row, PAIR) for row in settings.front(rows, PAIR)]
    assert 5 < len(best) < len(points)
    for error, cost in points:
        limit = error / (1 - settings.GAIN)
        assert any(e <= limit and c <= cost for e, c in best), "or nearly bettered"
    for (e, c), (other, dearer) in itertools.permutations(best, 2):
        assert not (e <= other and c <= dearer), "none on it betters another"


def test_a_larger_step_is_the_cheaper_one():
    rows = [sample.timed(1e-3, 1.0, dt=0.1), sample.timed(1e-6, 1.0, dt=0.01)]
    rows.append(sample.timed(1e-3, 1.0, dt=0.02))
    for pair in (("dt", "error"), ("error", "dt")):
        found = {row["dt"] for row in settings.front(rows, pair)}
        assert found == {0.1, 0.01}, pair


@pytest.mark.parametrize(
    "text, expected",
    [
        ("error,seconds", ("error", "seconds")),
        ("dt,energy_error", ("dt", "energy_error")),
        ("error", None),
        ("error,error", None),
        ("error,time", None),
        ("error,seconds,dt", None),
        ("", None),
    ],
)
def test_pairs_of_axes(text, expected):
    if expected is None:
        with pytest.raises(ValueError, match="energy_error"):
            axes.pair(text)
    else:
        assert axes.pair(text) == expected


@pytest.mark.parametrize("name", list(axes.QUANTITIES))
@pytest.mark.parametrize(
    "values",
    [[1.0], [1e-150, 1e-7, 3.0], [0, 1e-3], [1e-3, math.inf], [1e-320, 1e300]],
)
def test_scales_show_every_value(name, values):
    floors = (2.0**-53,) if axes.QUANTITIES[name].is_error else ()
    finite = [v for v in values if 0 < v < math.inf]
    scale = axes.scale_of(name, values, floors)
    drawn = [scale.position(value) for value in sorted(finite)]
    assert drawn == sorted(set(drawn)), "one order, no two alike"
    if axes.QUANTITIES[name].is_error:
        drawn += [scale.position(value) for value in values]
    assert all(scale.low <= at <= scale.high for at in drawn)


def test_what_is_not_timed_is_drawn_against_counts():
    rows = [sample.timed(1e-3, None, steps=10, evaluations=40)]
    ((pair, suffix, said),) = settings.drawn_pairs(measured_of(rows), rows)
    assert (pair, suffix) == (("error", "evaluations"), "") and "Nothing" in said
    rows = [sample.timed(1e-3, None, evaluations=None)]
    assert settings.drawn_pairs(measured_of(rows), rows)[0][0][1] == "steps"
    rows = [sample.line("function", "sin", "double", 1e-16)]
    assert settings.drawn_pairs(measured_of(rows), rows) == []
    asked = measured_of(rows, (("dt", "error"),))
    assert settings.drawn_pairs(asked, rows) == [(("dt", "error"), "dt_error", "")]
