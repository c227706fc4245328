"""Tests of where a value stands on the scale of colours."""
import pytest

from ulpgate_report.figures import heat_colours


@pytest.mark.parametrize(
    "value, expected, why",
    [
        (0, 0.0, "exact is the lowest colour"),
        (0.5, 0.0, "so is correct rounding"),
        (1e6, 1.0, "the highest"),
        (10**400, 1.0, "above is cut"),
    ],
)
def test_heat_position(value, expected, why):
    assert heat_colours.ULP.position(value) == pytest.approx(expected), why
