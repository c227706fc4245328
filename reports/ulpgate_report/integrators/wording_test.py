"""Tests of what captions say of the orders: ends, coinciding curves, errors of 0."""
import pytest

from ulpgate_report.integrators import orders, wording
from ulpgate_report.testing.sample_pendulum import BITS, order_rows


def found(**errors):
    """{double: convergences} of integrators with these errors, in this order."""
    return {
        "double": [
            orders.convergences(order_rows(mine, integrator=name), BITS)[0]
            for name, mine in errors.items()
        ]
    }


@pytest.mark.parametrize(
    "value, text",
    [(2.0**-22, "2^-22"), (0.5, "2^-1"), (1.0, "1"), (8.0, "2^3"), (0.1, "0.1")],
)
def test_power_of_two(value, text):
    assert wording.power_of_two(value) == text


@pytest.mark.parametrize(
    "ends, text",
    [
        ({}, ""),
        ({4: 1.0, 8: 1.0}, "Every error is that at the time 1. "),
        (
            {1: 0.25, 4: 1.0, 5: 1.0},
            "The end time differs by order: 2^-2 for order 1 and 1 for orders 4 and 5. ",
        ),
        (
            {1: 0.25, 2: 1.0, 3: 0.5, 4: 1.0, 5: 1.0},
            "The end time differs by order: 2^-2 for order 1, 2^-1 for order 3 and 1 for orders 2, 4 and 5. ",
        ),
        (
            {1: 0.25, 4: 1.0, 5: 1.0, 9: 1.0},
            "The end time differs by order: 2^-2 for order 1 and 1 for orders 4 to 9. ",
        ),
    ],
)
def test_ends(ends, text):
    lines = [{"order": order, "t_end": end} for order, end in ends.items()]
    assert wording.ends(lines or [{"order": 4}]) == text


def test_hidden_curves_are_named():
    same, other = [1e-3, 1e-6, 1e-9], [1e-4, 1e-7, 1e-10]
    nearly = [1e-3, 1e-6, 1.02e-9]
    said = wording.hidden(found(a=same, b=other, c=nearly, d=[1e-3, 1e-6]))
    assert "open: a under c. " in said
    assert wording.hidden(found(a=same, b=other)) == ""
    twice = found(a=same, c=nearly)
    assert "open: a under c. " in wording.hidden({**twice, "float128": twice["double"]})
    some = {**twice, "float128": found(a=same, c=other)["double"]}
    assert "a under c (in double)" in wording.hidden(some)


def test_curves_that_are_not_drawn_are_named():
    assert wording.zeros(found(a=[1e-3, 1e-6])) == ""
    assert "every" not in wording.zeros(found(a=[1e-3, 0.0]))
    said = wording.zeros(found(a=[1e-3, 0.0], b=[0.0, 0.0], c=[0.0]))
    assert "of b and c every error is 0" in said
