"""Tests of the figures: floors, breaks, failed settings, panels."""
import pytest
from matplotlib import pyplot

from ulpgate_report.records import work_precision_records
from ulpgate_report.testing import sample_work_precision as sample
from ulpgate_report.work_precision import axes, figure_curves, settings

TOKENS = ("float", "double", "mpfr62")


def measured_of(rows):
    """Settings as a report has them."""
    found = work_precision_records.WorkPrecision(tuple(rows), (), {}, 0)
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
