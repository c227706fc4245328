"""Tests of the orders' figure: slopes before the floor, their numbers, panels, every integrator in a legend."""
import math

import pytest
from matplotlib import pyplot

from ulpgate_report.figures import figure_style
from ulpgate_report.integrators import figure_orders, orders, slopes
from ulpgate_report.records import pendulum_records
from ulpgate_report.testing import sample_pendulum


def of_orders(rows):
    """A pendulum's run of orders alone."""
    run = pendulum_records.PendulumRun("", orders=rows, bits=sample_pendulum.BITS)
    return pendulum_records.Pendulum((run,))


def drawn(rows):
    """(caption, figure) of one problem, laid out."""
    ((_, caption, figure),) = figure_orders.draw(of_orders(tuple(rows)))
    figure.canvas.draw()
    return caption, figure


def legend_of(axes):
    """What the legend of a panel says."""
    return [text.get_text() for text in axes.get_legend().get_texts()]


def test_slopes_go_through_points_before_the_floor():
    given = of_orders(tuple(sample_pendulum.order_records(("double",))))
    found = orders.convergences(given.orders, given.bits)
    for one in found:
        x, y = slopes.anchor(one)
        measured = min(one.clear, key=lambda point: abs(math.log10(point[0]) - x))
        assert y == pytest.approx(math.log10(measured[1]))
        assert measured[1] > 10 * (one.floor or 0)


def test_order_figure_shows_the_floor_and_every_integrator():
    pendulum = of_orders(tuple(sample_pendulum.order_records()))
    ((name, caption, figure),) = figure_orders.draw(pendulum)
    assert name == "orders_kepler" and "mpfr62" in caption
    assert "a panel for each type" in caption
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


@pytest.mark.parametrize("narrow", [False, True])
def test_one_type_has_panels_by_order_with_their_own_legends(narrow):
    rows = sample_pendulum.order_records(("double",))
    if narrow:
        with figure_style.one_column():
            caption, figure = drawn(rows)
    else:
        caption, figure = drawn(rows)
    assert "in double" in caption and "for each range of orders" in caption
    assert "each type" not in caption
    titles = ["order 2", "orders 4 and 5", "orders 6 and 8", "orders 10 and 12"]
    assert [axes.get_title() for axes in figure.axes] == titles
    labels = [label for axes in figure.axes for label in legend_of(axes)]
    assert len(labels) == len(sample_pendulum.INTEGRATORS)
    assert "yoshida8 (8): 8.00" in labels
    box = figure.get_tightbbox(figure.canvas.get_renderer())
    assert box.width <= (figure_style.COLUMN_INCHES + 0.2 if narrow else 7.2)
    assert not narrow or box.height <= 9.6
    pyplot.close(figure)


def test_few_integrators_share_a_panel():
    rows = [r for r in sample_pendulum.order_records(("double",)) if r["order"] < 6]
    caption, figure = drawn(rows)
    assert [axes.get_title() for axes in figure.axes] == ["orders 2 to 5"]
    assert "a panel" not in caption
    pyplot.close(figure)


def test_every_slope_has_a_number_that_lies_on_no_marker():
    for tokens in (("double",), ("double", "float128", "mpfr62")):
        _, figure = drawn(sample_pendulum.order_records(tokens))
        for axes in figure.axes:
            curves = [line for line in axes.lines if line.get_marker() != "None"]
            dotted = [line for line in axes.lines if line.get_linestyle() == ":"]
            dotted = [line for line in dotted if line not in curves]
            numbers = [text for text in axes.texts if text.get_text() != "u"]
            assert numbers and len(numbers) == len(dotted)
            markers = [
                axes.transData.transform(point)
                for line in curves
                for point in line.get_xydata()
            ]
            for text in numbers:
                box = text.get_window_extent()
                assert not any(box.contains(*at) for at in markers), text.get_text()
                assert text.get_size() >= 6.5
        pyplot.close(figure)


def test_curves_of_a_panel_differ():
    _, figure = drawn(sample_pendulum.order_records(("double", "float128")))
    for axes in figure.axes:
        looks = [
            (line.get_color(), line.get_marker())
            for line in axes.lines
            if line.get_marker() != "None"
        ]
        assert len(set(looks)) == len(looks) == len(sample_pendulum.INTEGRATORS)
    pyplot.close(figure)


def test_exact_integrators_are_told_and_not_drawn():
    rows = sample_pendulum.order_records(("double",))
    for row in rows:
        if row["integrator"] == "bulirsch_stoer":
            row["error"], row["measured_order"] = 0.0, None
    caption, figure = drawn(rows)
    assert "of bulirsch_stoer every error is 0" in caption
    labels = [label for axes in figure.axes for label in legend_of(axes)]
    assert not any("bulirsch" in label for label in labels)
    pyplot.close(figure)
    exact = [r for r in rows if r["integrator"] == "bulirsch_stoer"]
    assert not list(figure_orders.draw(of_orders(tuple(exact))))


def test_caption_tells_ends_hidden_curves_and_what_is_not_measured():
    rows = sample_pendulum.order_records(("double",))
    for row in rows:
        row["t_end"] = 0.5 if row["order"] == 2 else 1.0
    rows += [
        {**row, "integrator": "twin"} for row in rows if row["integrator"] == "pefrl"
    ]
    caption, figure = drawn(rows)
    assert "2^-1 for order 2 and 1 for orders 4 to 12" in caption
    assert "pefrl and twin" in caption or "pefrl under twin" in caption
    assert "-: not measured" in caption
    pyplot.close(figure)


def test_same_records_give_the_same_bytes():
    made = [
        figure_style.render(drawn(sample_pendulum.order_records(("double",)))[1], "n")
        for _ in range(2)
    ]
    assert made[0] == made[1]
