"""Tests of the pendulum's figures: vector files, texts apart, and what the marks say."""
import itertools
import math
import re

import matplotlib
import numpy
import pytest
from matplotlib import pyplot

from ulpgate_report.figures import figure_style
from ulpgate_report.pendulum import (
    figure_correlation,
    figure_damped_angle,
    figure_energy,
    figure_energy_error,
    figure_snapshots,
    figure_t_s,
    kind,
)
from ulpgate_report.records import chain_series, pendulum_records, suite
from ulpgate_report.testing import sample_pendulum

TOKENS = ("float", "double", "float128", "mpfr150")


@pytest.fixture(scope="module")
def pendulum(tmp_path_factory):
    """The pendulum of a small suite."""
    folder = tmp_path_factory.mktemp("suite")
    sample_pendulum.write_suite(folder, TOKENS, end=6.0, every=2e-3)
    return suite.load(folder).pendulum


def only(**what):
    """A pendulum of one run that holds one thing alone."""
    return pendulum_records.Pendulum((pendulum_records.PendulumRun("", **what),))


@pytest.fixture(scope="module")
def drawn(pendulum):
    """{draw: [(name, caption, figure)]} of all figures; they are closed and can still be rendered."""
    found = {draw: list(draw(pendulum)) for draw in kind.FIGURES}
    pyplot.close("all")
    return found


@pytest.mark.parametrize("draw", kind.FIGURES)
def test_vectors(drawn, draw):
    name, caption, figure = drawn[draw][0]
    # The report of a suite has all of them twice, in the same bytes.
    files = figure_style.render(figure, name, ("pdf", "svg"))
    assert caption.endswith(".") and name.startswith(kind.FAMILIES)
    assert b"/Type3" not in files["pdf"] and b"/Subtype /Image" not in files["pdf"]
    assert b"<image" not in files["svg"] and b"<dc:date>" not in files["svg"]


@pytest.mark.parametrize("draw", kind.FIGURES)
def test_nothing_to_draw(draw):
    assert list(draw(only())) == []


def hidden_labels(figure):
    """The labels of ticks beyond the limits of their axis, which matplotlib keeps and does not draw."""
    found = set()
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            slack = 1e-6 * (high - low)
            for tick in (*axis.majorTicks, *axis.minorTicks):
                if not low - slack <= tick.get_loc() <= high + slack:
                    found |= {tick.label1, tick.label2}
    return found


def boxes(figure):
    """[(text, its box in pixels)] of every text that is drawn."""
    canvas = matplotlib.backends.backend_agg.FigureCanvasAgg(figure)
    canvas.draw()
    texts = set(figure.findobj(matplotlib.text.Text)) - hidden_labels(figure)
    return [
        (text, text.get_window_extent(canvas.get_renderer()))
        for text in texts
        if text.get_visible() and text.get_text().strip()
    ]


@pytest.mark.parametrize("draw", kind.FIGURES)
def test_no_text_lies_on_another(drawn, draw):
    for name, _, figure in drawn[draw]:
        found = boxes(figure)
        for (one, first), (other, second) in itertools.combinations(found, 2):
            if one.get_rotation() % 90 or other.get_rotation() % 90:
                # The boxes of tilted labels meet where the labels do not.
                continue
            overlap = matplotlib.transforms.Bbox.intersection(first, second)
            wide = overlap is not None and min(overlap.width, overlap.height) > 1
            assert not wide, f"{name}: {one.get_text()!r} and {other.get_text()!r}"
        sizes = [text.get_fontsize() for text, _ in found]
        assert min(sizes) >= 6, name


def test_names_tell_runs_and_conditions_apart(drawn):
    names = [name for figures in drawn.values() for name, _, _ in figures]
    assert len(set(names)) == len(names)
    assert "pendulum_correlation_pendulum3_dt_1e-5" in names
    assert "pendulum_t_s_pendulum3_mass-yade" in names
    assert all(re.fullmatch(r"[A-Za-z0-9_.+-]+", name) for name in names)


def curve_of(row):
    """The columns of a row's synthetic curve."""
    lines = sample_pendulum.curve(row).splitlines()[1:]
    pairs = [tuple(map(float, line.split(","))) for line in lines]
    return dict(zip(("time_s", "correlation"), map(list, zip(*pairs))))


def test_correlation_marks_limit_and_duration():
    rows = [
        sample_pendulum.correlation_record("double"),
        *sample_pendulum.reference_records("1e-5", "mass=yade"),
    ]
    curves = {(r["scene"], r["type"], r["against"]): curve_of(r) for r in rows}
    given = only(correlations=tuple(rows), curves=curves)
    ((_, caption, figure),) = figure_correlation.draw(given)
    assert "mass=yade" in caption and "1e-5" in caption
    double, own, half = figure.axes
    verticals = [
        line.get_xdata()[0]
        for line in double.lines
        if len(line.get_xdata()) == 2 and line.get_xdata()[0] == line.get_xdata()[1]
    ]
    assert verticals == [rows[0]["t_s"]]
    limits = [
        line.get_ydata()[0] for line in double.lines if len(line.get_ydata()) == 2
    ]
    assert figure_correlation.LIMIT in limits
    texts = [[text.get_text() for text in axes.texts] for axes in (double, own, half)]
    assert "2.90" in texts[0][0] and "rounding" in texts[0][0]
    assert r"\geq 16.00" in texts[1][0] and "to the end" in texts[1][0]
    assert [axes.get_ylabel().split("\n")[0] for axes in (own, half)] == [
        "mpfr150,"
    ] * 2
    assert not own.patches, "nothing of a strip that is true to the end is grey"
    pyplot.close(figure)


def test_the_least_that_can_be_drawn():
    row = sample_pendulum.correlation_record("double", t_s=0, variant="")
    row["dt"] = "h"
    key = (row["scene"], row["type"], row["against"])
    nodes = {"shape": ["sphere"] * 2, "x_m": [0.0] * 2, "y_m": [0.0, 1.0]}
    nan = math.nan
    series = chain_series.ChainSeries(
        numpy.array([0.0, 1e-4]),
        numpy.array([1.0, 1.0]),
        numpy.array([1e-4]),
        {"translational_on_step": numpy.array([nan])},
        {chain_series.RAW: (numpy.array([1e-4]), numpy.array([0.0]))},
    )
    given = only(
        correlations=(row,),
        curves={key: {"time_s": [0.0], "correlation": [nan]}},
        snapshots={("pendulum3", "double"): [(0, {**nodes, "time_s": [0.0] * 2})]},
        series={("pendulum3", "double"): series},
        records=(sample_pendulum.record("double", "1e-5", "damping=1"),),
        orders=tuple(sample_pendulum.order_records(("double",), steps=1)),
    )
    names = []
    for draw in kind.FIGURES:
        for name, _, figure in draw(given):
            names.append(name)
            assert figure_style.render(figure, name)["png"]
    assert len(names) == len(kind.FIGURES)


def test_durations_take_the_longest_reference():
    rows = [
        sample_pendulum.correlation_record("double", against=a, t_s=t)
        for a, t in (("mpfr150", 2.0), ("RealHP4", 1.0), ("float128", 3.0))
    ]
    rows.append(sample_pendulum.correlation_record("double", against="half_step"))
    found = figure_t_s.durations(rows, ["double", "float128", "mpfr150"])
    assert found == {("1e-5", "double"): rows[0]}


def test_t_s_marks_bounds_limits_and_published_values(pendulum):
    rows = [row for row in pendulum.correlations]
    ((_, caption, figure),) = figure_t_s.draw(only(correlations=tuple(rows)))
    (axes,) = figure.axes
    points = [line for line in axes.lines if len(line.get_xdata()) == 1]
    diamonds = [p for p in points if p.get_markeredgecolor() == "black"]
    assert [float(p.get_ydata()[0]) for p in diamonds] == [1.1, 2.5, 5.1]
    assert len(axes.texts) == 2, "an arrow for each bound: the reference at two steps"
    assert axes.get_ylim()[1] > 1.1 * sample_pendulum.END_S, "room for the arrows"
    assert "108167" in caption
    pyplot.close(figure)
    plain = [{**row, "variant": ""} for row in rows]
    ((_, caption, figure),) = figure_t_s.draw(only(correlations=tuple(plain)))
    assert "108167" not in caption
    pyplot.close(figure)


def test_angles_only_of_damped_runs(pendulum):
    names = [name for name, _, _ in figure_damped_angle.draw(pendulum)]
    pyplot.close("all")
    assert names == ["pendulum_angle_pendulum3_damped"]


@pytest.mark.parametrize(
    "tokens, expected, why",
    [
        (["float", "double", "float128"], ["float", "float128"], "the published two"),
        (["double", "mpfr62", "mpfr150"], ["double", "mpfr150"], "first and last"),
        (["double"], ["double"], "one"),
    ],
)
def test_types_of_the_energy_figure(tokens, expected, why):
    assert figure_energy.shown_types(tokens) == expected, why


def test_energy_errors_left_out_where_they_cannot_be_drawn():
    rows = [
        sample_pendulum.record("double", "1e-5", max_energy_error="inf"),
        sample_pendulum.record("float", "1e-5", max_energy_error=0.0),
        sample_pendulum.record("mpfr62", "1e-5", max_energy_error_raw=None),
    ]
    found = figure_energy_error.errors(rows)
    assert [(token, raw) for _, token, raw, _ in found] == [
        ("double", True),
        ("float", True),
        ("mpfr62", False),
    ]


def test_instants_of_float_and_double_are_one():
    def snapshots(times):
        nodes = {"shape": ["sphere"] * 4, "x_m": [0.0] * 4, "y_m": [0.0] * 4}
        return [(0, {**nodes, "time_s": [t] * 4}) for t in times]

    lines = [
        ("float", snapshots([0.0, 0.10000000149, 2.4999998])),
        ("double", snapshots([0.0, 0.1, 2.5])),
    ]
    found = figure_snapshots._instants(lines)
    assert list(found) == [0.0, 0.1, 2.5], "of the longer type"
    assert all(set(of_type) == {"float", "double"} for of_type in found.values())


def test_nodes_leave_out_what_is_no_node():
    columns = {
        "shape": ["box", "sphere", "sphere"],
        "x_m": [9.0, 0.0, 1.0],
        "y_m": [9.0, 0.0, 2.0],
    }
    x, y = figure_snapshots.nodes(columns)
    assert x.tolist() == [0.0, 1.0] and y.tolist() == [0.0, 2.0]
    assert figure_snapshots.nodes({**columns, "x_m": [0, math.inf, 1]}) is None
