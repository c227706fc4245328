"""Tests of the orders' figure: slopes before the floor, every integrator in the legend."""
import math

import pytest
from matplotlib import pyplot

from ulpgate_report.integrators import figure_orders, orders
from ulpgate_report.records import pendulum_records
from ulpgate_report.testing import sample_pendulum


def of_orders(rows):
    """A pendulum's run of orders alone."""
    run = pendulum_records.PendulumRun("", orders=rows, bits=sample_pendulum.BITS)
    return pendulum_records.Pendulum((run,))


def test_slopes_go_through_points_before_the_floor():
    given = of_orders(tuple(sample_pendulum.order_records(("double",))))
    found = orders.convergences(given.orders)
    for one in found:
        x, y = figure_orders.anchor(one)
        measured = min(one.clear, key=lambda point: abs(math.log10(point[0]) - x))
        assert y == pytest.approx(math.log10(measured[1]))
        assert measured[1] > 10 * (one.floor or 0)


def test_order_figure_shows_the_floor_and_every_integrator():
    pendulum = of_orders(tuple(sample_pendulum.order_records()))
    ((name, caption, figure),) = figure_orders.draw(pendulum)
    assert name == "orders_kepler" and "mpfr62" in caption
    titles = [axes.get_title() for axes in figure.axes]
    assert titles == ["double", "float128", "mpfr62"]
    for axes, token in zip(figure.axes, titles):
        unit = -sample_pendulum.BITS[token] * math.log10(2)
        levels = [
            line.get_ydata()[0]
            for line in axes.lines
            if len(line.get_ydata()) == 2 and line.get_ydata()[0] == line.get_ydata()[1]
        ]
        assert levels == [pytest.approx(unit)]
    (legend,) = figure.legends
    labels = [text.get_text() for text in legend.texts]
    assert len(labels) == len(sample_pendulum.INTEGRATORS)
    assert "yoshida8 (8): 8.00" in labels
    pyplot.close(figure)
