"""Tests of the figures: floors, breaks, failed settings, panels."""
import pytest
from matplotlib import pyplot

from ulpgate_report.records import work_precision_records
from ulpgate_report.testing import sample_work_precision as sample
from ulpgate_report.work_precision import (
    axes,
    drawing,
    figure_curves,
    figure_fits,
    settings,
)

TOKENS = ("float", "double", "mpfr62")


def measured_of(rows, fits=()):
    """Settings as a report has them."""
    found = work_precision_records.WorkPrecision(tuple(rows), tuple(fits), {}, 0)
    return settings.made_of(found)


def drawn_lines(figure):
    """(number of points, x of the first, marker) of each line in the first plot of a figure."""
    lines = figure.axes[0].lines
    return [(len(l.get_xdata()), l.get_xdata()[0], l.get_marker()) for l in lines]


def test_a_figure_shows_floors_breaks_and_failures():
    rows = [
        {**sample.timed(10.0**-n, None, evaluations=10**n), "steps": 10**n}
        for n in range(2, 15)
    ]
    rows[4] = sample.failed(rows[4], "diverged", "not finite")
    measured = measured_of(rows)
    ((name, caption, figure),) = figure_curves.draw(measured)
    assert name == "work_precision_trajectory_kepler"
    assert "error on x, evaluations on y" in caption and "1 of 13 settings" in caption
    lines = drawn_lines(figure)
    pieces = [count for count, _, marker in lines if marker == "s"]
    assert pieces == [4, 8], "double's squares, broken at the fifth"
    (cross,) = [x for _, x, marker in lines if marker == "x"]
    plot = figure.axes[0]
    ticks = [t.get_text() for t in plot.get_xticklabels()]
    assert plot.get_xticks()[ticks.index("failed")] == pytest.approx(cross)
    floors = [
        line.get_xdata()[0] for line in plot.lines if line.get_linestyle() == "--"
    ]
    scale = axes.scale_of("error", [1e-2, 1e-14], (2.0**-53,), True)
    assert floors == [pytest.approx(scale.position(2.0**-53))]
    assert "double" in [text.get_text() for text in plot.texts]
    pyplot.close(figure)


def test_many_integrators_get_a_panel_for_each_type():
    rows, times = sample.settings("kepler", TOKENS)
    timed = iter(times)
    rows = [r if r["failure"] else {**r, **next(timed), "what": ""} for r in rows]
    ((_, caption, figure),) = figure_curves.draw(measured_of(rows))
    assert [plot.get_title() for plot in figure.axes] == ["", *TOKENS]
    (legend,) = figure.legends
    names = [text.get_text() for text in legend.texts]
    assert len(names) == 15 and names[-1] == f"{len(sample.INTEGRATORS) - 14} others"
    assert "Pareto front, of all types above" in caption
    pyplot.close(figure)


LAW = {"constant": 2.0, "order": 3.0, "walk": 0.5, "drift": 4.0}


@pytest.mark.parametrize(
    "law, expected",
    [
        (LAW, ["stepping", "walk", "drift"]),
        ({**LAW, "drift": None}, ["stepping", "walk"]),
        ({**LAW, "walk": None, "drift": None}, ["stepping"]),
        ({**LAW, "constant": None, "order": None}, ["walk", "drift"]),
        (dict.fromkeys(LAW), []),
    ],
)
def test_branches_of_a_law_meet(law, expected):
    # Random walk and drift are equal at n = (B/D)^2: put between the ends.
    if law["drift"]:
        law = {**law, "drift": 0.5 / 1e3}
    one = figure_fits.Law(law, 2.0**-53, 10.0)
    pieces = one.pieces(0.1, 1e-7)
    assert [name for name, _ in pieces] == expected
    for (_, points), (_, following) in zip(pieces, pieces[1:]):
        assert points[-1] == following[0]
    for _, points in pieces:
        for dt, error in points:
            assert error == max(one.branches(dt).values())


def test_laws_are_drawn_beside_their_points():
    rows, _ = sample.settings("kepler", TOKENS, sample.INTEGRATORS[:2])
    fits = sample.fits_of("kepler", rows)
    ((name, caption, figure),) = figure_fits.draw(measured_of(rows, fits))
    assert name == "work_precision_fits_trajectory_kepler"
    assert "energy error over the step" in caption and "Crosses" in caption
    assert {plot.get_title() for plot in figure.axes} == {
        "symplectic_euler",
        "leapfrog",
    }
    leapfrog = next(p for p in figure.axes if p.get_title() == "leapfrog")
    stars = [line for line in leapfrog.lines if line.get_marker() == "*"]
    assert len(stars) == len(TOKENS)
    named = [text.get_text() for text in leapfrog.texts]
    assert "$dt^{2}$" in named and r"$\sqrt{n}\,u$" in named
    assert named.count("$dt^{2}$") == 1, "the order is that of all types"
    # The line of the law goes through the points that it is made of.
    scale = drawn_scale(rows, "leapfrog")
    best = min(f["best_error"] for f in fits if f["integrator"] == "leapfrog")
    lowest = min(star.get_ydata()[0] for star in stars)
    assert lowest == pytest.approx(scale.position(best))
    pyplot.close(figure)


def drawn_scale(rows, integrator):
    """The scale of the errors of a panel."""
    mine = [row for row in rows if row["integrator"] == integrator]
    floors = [2.0 ** -sample.BITS[token] for token in TOKENS]
    return drawing.scales_of(mine, ("dt", "energy_error"), floors)[1]


def test_a_law_that_does_not_hold_is_dashed_and_without_energy_the_final_error_is_shown():
    rows, _ = sample.settings("robertson", ("double",), sample.INTEGRATORS[1:2])
    rows = [{**row, "energy_error": None} for row in rows]
    fits = sample.fits_of("robertson", rows, error="final_error")
    fits = [{**fit, "bad": True} for fit in fits]
    ((_, caption, figure),) = figure_fits.draw(measured_of(rows, fits))
    assert ": error over the step" in caption
    (plot,) = figure.axes
    laws = [l for l in plot.lines if len(l.get_xdata()) > 20]
    assert laws and all(l.is_dashed() for l in laws)
    pyplot.close(figure)
    assert list(figure_fits.draw(measured_of(rows))) == [], "nothing was fitted"
