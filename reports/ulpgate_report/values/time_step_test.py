"""Tests of the time step's text: arithmetic of numbers alone, order, labels."""
import pytest

from ulpgate_report.values import time_step


@pytest.mark.parametrize(
    "text, expected, why",
    [
        ("1e-5", 1e-5, "a number"),
        (1e-6, 1e-6, "JSON's number"),
        ("(1e-5)/2", 5e-6, "half a step"),
        ("2 * (1e-5 - 5e-6)", 1e-5, "arithmetic"),
        ("1/0", None, "no value"),
        ("-1e-5", None, "no step"),
        ("1e999", None, "infinite"),
        ("h", None, "a name"),
        ("__import__('os')", None, "a call is not evaluated"),
        ("9**9**9", None, "nor is a power"),
        ("True", None, "no number"),
        ("", None, "empty"),
    ],
)
def test_seconds(text, expected, why):
    found = time_step.seconds(text)
    assert found == (expected if expected is None else pytest.approx(expected)), why


def test_order_and_labels():
    steps = ["1e-7", "h", "(1e-5)/2", "1e-5", "1e-7"]
    assert time_step.ordered(steps) == ["1e-5", "(1e-5)/2", "1e-7", "h"]
    assert time_step.label("1e-5") == "$10^{-5}$ s"
    assert time_step.label("(1e-5)/2") == r"$5 \times 10^{-6}$ s"
    assert time_step.label("a$b") == r"a\$b s"
