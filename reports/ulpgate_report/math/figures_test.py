"""Tests of the functions' figures: hard, infinite and exact points."""
import math

import pytest

from ulpgate_report.figures import figure_style
from ulpgate_report.math import (
    combine,
    figure_distributions,
    figure_error_vs_time,
    figure_heatmap,
)
from ulpgate_report.records import records
from ulpgate_report.testing import sample_records
from ulpgate_report.testing.hard_records import hard_values


def combined_run(names, change=lambda record: None, timed=True):
    """A combined sample run with times."""
    context = sample_records.context(names)
    math_records = sample_records.math_records(context)
    for record in math_records:
        change(record)
    times = sample_records.timing_records(context) if timed else []
    time_ns = {(t["what"], t["type"]): t["ns_per_eval"] for t in times}
    return combine.combine_run(records.Run(context, math_records, time_ns))


def infinite_everywhere(record):
    """No finite error at all."""
    record["max_ulp"] = "inf"


DRAWERS = [
    figure_heatmap.draw,
    figure_error_vs_time.draw,
    figure_distributions.draw_real,
    figure_distributions.draw_complex,
]


@pytest.mark.parametrize("draw", DRAWERS)
def test_hard_values_are_drawn(draw):
    name, caption, figure = draw(combined_run(["sin", "fmod", "ctan"], hard_values))
    files = figure_style.render(figure, name)
    assert set(files) == {"pdf", "svg", "png"}
    assert files["pdf"].startswith(b"%PDF") and b"CreationDate" not in files["pdf"]
    assert b"<svg" in files["svg"] and b"<dc:date>" not in files["svg"]
    assert files["png"].startswith(b"\x89PNG")
    assert caption.endswith(".")


@pytest.mark.parametrize("draw", DRAWERS[:3])
def test_infinite_values_alone_are_drawn(draw):
    name, _, figure = draw(combined_run(["sin", "fmod"], infinite_everywhere))
    assert figure_style.render(figure, name)["png"]


def test_nothing_to_draw():
    run = combined_run(["sin"], timed=False)
    assert figure_error_vs_time.draw(run)[2] is None
    assert figure_distributions.draw_special(run)[2] is None


def test_points_take_the_worse_part_of_the_papers_strata():
    def change(record):
        record["max_ulp"] = 2.0 if record["part"] == "re" else 4.0
        if record["stratum"] == "hard":
            record["max_ulp"] = 100.0

    found = figure_error_vs_time.points(combined_run(["ctan"], change))
    assert len(found) == len(sample_records.TYPES)
    double = found[1]
    assert double.max_ulp == 4.0
    assert double.log10_error == pytest.approx(math.log10(4.0 * 2.0**-52))


def test_points_of_exact_and_infinite_errors():
    exact = figure_error_vs_time.points(combined_run(["fmod"]))
    assert all(point.log10_error == -math.inf for point in exact)
    infinite = figure_error_vs_time.points(combined_run(["sin"], infinite_everywhere))
    assert all(point.log10_error == math.inf for point in infinite)


def test_half_an_ulp_lies_on_the_floor():
    def change(record):
        record["max_ulp"] = 0.5

    for point in figure_error_vs_time.points(combined_run(["sin"], change)):
        bits = sample_records.TYPES[point.type_index][-1]
        floor = figure_error_vs_time.floor_log10(bits)
        assert point.log10_error == pytest.approx(floor, abs=1e-12)


def test_shares_keep_every_sample():
    buckets = ((-400, 1), (-24, 2), (-22, 3), (0, 4), (4000, 10))
    run = combined_run(["sin"])
    cell = run.cells[run.rows[0], "double"]
    changed = combine.Cell(**{**vars(cell), "buckets": buckets, "judged": 20})
    found = figure_distributions.shares(changed)
    assert sum(share for _, share in found) == pytest.approx(1.0)
    assert found[0] == (-6.0, 0.15), "what is below the range joins its first bucket"
    assert found[1] == (-5.75, 0), "an empty bucket stands between"
    assert found[-1] == (40.0, 0.5)
