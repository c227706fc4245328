"""Tests of combining strata: maxima, ties, weights, percentiles, order."""
import random

import pytest

from ulpgate_report.math import combine
from ulpgate_report.records import records
from ulpgate_report.testing import sample_records

INF = float("inf")


def record(stratum="uniform", max_ulp=1.0, judged=10, mean_ulp=0.25, **other):
    """A record with what the test is about, the rest harmless."""
    found = {
        "stratum": stratum,
        "samples": judged,
        "judged": judged,
        "max_ulp": max_ulp,
        "argmax": [f"at {stratum}"],
        "max_float_distance": 1,
        "mean_ulp": mean_ulp,
        "correctly_rounded": 5,
        "histogram": {"exact": judged, "buckets": []},
        "mismatch": {"nan": 0},
        "max_ulp_over_condition": None,
    }
    return {**found, **other}


@pytest.mark.parametrize(
    "maxima, expected, stratum, why",
    [
        ([1.0, 3.0, 2.0], 3.0, "s1", "the largest"),
        ([2.0, 2.0, 1.0], 2.0, "s0", "a tie goes to the first stratum"),
        ([5.0, "inf", 7.0], INF, "s1", "inf is larger than any number"),
        (["inf", "inf"], INF, "s0", "a tie of inf too"),
        ([None, 0, None], 0, "s1", "null is smaller than exact"),
        ([None, None], None, None, "nothing judged anywhere"),
    ],
)
def test_maximum(maxima, expected, stratum, why):
    given = [record(f"s{i}", value) for i, value in enumerate(maxima)]
    cell = combine.combine_cell(given)
    assert cell.max_ulp == expected, why
    assert cell.stratum == stratum, why
    assert cell.argmax == ((f"at {stratum}",) if stratum else ()), why


@pytest.mark.parametrize(
    "means, expected, why",
    [
        ([(1.0, 10), (4.0, 30)], 3.25, "weighted by the judged samples"),
        (
            [(1.0, 10), (None, 0)],
            1.0,
            "a stratum without a judged sample has no weight",
        ),
        ([(1.0, 10), ("inf", 1)], INF, "one infinite error makes an infinite mean"),
        ([(None, 0)], None, "nothing judged"),
    ],
)
def test_mean(means, expected, why):
    given = [record(mean_ulp=mean, judged=judged) for mean, judged in means]
    assert combine.combine_cell(given).mean_ulp == expected, why


@pytest.mark.parametrize(
    "share, judged, exact, buckets, max_ulp, expected, why",
    [
        (99, 100, 99, ((0, 1),), 1.0, 0, "the 99th of 100 is exact"),
        (99, 100, 98, ((-4, 1), (0, 1)), 0.9, 0.5, "upper edge of the bucket"),
        (99, 100, 0, ((-4, 98), (0, 2)), 0.9, 0.9, "an edge above the maximum is cut"),
        (50, 3, 0, ((-4, 1), (0, 1), (4, 1)), 2.0, 1.0, "2 of 3 reach the half"),
        (99, 100, 0, ((0, 98),), INF, INF, "errors in no bucket are infinite"),
        (50, 100, 0, ((8000, 100),), INF, INF, "an edge beyond double"),
        (99, 0, 0, (), None, None, "nothing judged"),
    ],
)
def test_percentile(share, judged, exact, buckets, max_ulp, expected, why):
    got = combine.percentile_ulp(share, judged, exact, buckets, max_ulp)
    assert got == expected, why


def test_sums():
    one = record(
        histogram={"exact": 1, "buckets": [[-3, 2], [4, 1]]}, mismatch={"nan": 2}
    )
    two = record(
        histogram={"exact": 4, "buckets": [[-3, 5]]}, mismatch={"nan": 1, "inf": 4}
    )
    cell = combine.combine_cell([one, two])
    assert cell.buckets == ((-3, 7), (4, 1))
    assert cell.exact_count == 5
    assert cell.mismatch == {"inf": 4, "nan": 3}
    assert cell.mismatches == 7
    assert cell.correctly_rounded == 10


def test_order_of_lines_does_not_matter():
    context = sample_records.context(["sin", "ctan"])
    math = sample_records.math_records(context)
    straight = combine.combine_run(records.Run(context, math, {}))
    random.Random(1).shuffle(math)
    shuffled = combine.combine_run(records.Run(context, math, {}))
    assert straight == shuffled
    assert list(straight.cells) == list(shuffled.cells)
    assert [row.label for row in straight.rows] == ["sin", "ctan re", "ctan im"]


def test_paper_cells_hold_two_strata_only():
    context = sample_records.context(["sin"])
    math = sample_records.math_records(context)
    for one in math:
        one["max_float_distance"] = 1000 if one["stratum"] == "hard" else 2
    combined = combine.combine_run(records.Run(context, math, {}))
    key = (combined.rows[0], "double")
    assert combined.paper_cells[key].max_float_distance == 2
    assert combined.cells[key].max_float_distance == 1000
    assert combined.paper_cells[key].samples == 2000
