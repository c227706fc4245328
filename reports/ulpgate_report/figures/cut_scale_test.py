"""Tests of the scale with cuts."""
import pytest

from ulpgate_report.figures import cut_scale


@pytest.mark.parametrize(
    "values, cuts, why",
    [
        ([0.0], 0, "one value, one stretch"),
        ([0.0, 4.0], 0, "a short gap is not cut"),
        ([0.0, 100.0], 1, "a long one is"),
        ([-150.0, -62.0, -16.0, -7.0], 3, "float, double, 62 and 150 digits"),
    ],
)
def test_cut_scale(values, cuts, why):
    scale = cut_scale.make(values)
    assert len(scale.cuts) == cuts, why
    drawn = [scale.position(value) for value in values]
    assert drawn == sorted(drawn), why
    assert scale.length <= 12 * len(values), why
    ticks = scale.ticks(2)
    for low, high, _ in scale.stretches:
        assert any(low <= tick <= high for tick in ticks), "every stretch has a tick"
