"""Tests of the scenes' figures: same bytes twice, depth, odd values."""
import math

import numpy
import pytest

from ulpgate_report.figures import figure_style
from ulpgate_report.records import csv_columns, energy_account, records, scene_records
from ulpgate_report.scenes import (
    figure_benchmark,
    figure_divergence,
    figure_energy,
    figure_snapshots,
    kind,
)
from ulpgate_report.testing import sample_scenes
from ulpgate_report.testing.sample_scenes import short_columns

TOKENS = ("double", "mpfr150", "cpp_bin_float62")


@pytest.fixture(scope="module")
def scenes(tmp_path_factory):
    """The scenes of a small run."""
    folder = tmp_path_factory.mktemp("scenes")
    return records.load(sample_scenes.write_sample(folder, TOKENS, bodies=60)).scenes


def only(**what):
    """Scenes that hold one thing alone."""
    empty = {"records": (), "timings": (), "series": {}, "divergences": {}}
    return scene_records.Scenes(**{**empty, "snapshots": {}, **what})


@pytest.mark.parametrize("draw", kind.FIGURES)
def test_same_bytes_twice(scenes, draw):
    ((name, caption, figure),) = draw(scenes)
    first = figure_style.render(figure, name)
    ((_, _, again),) = draw(scenes)
    assert first == figure_style.render(again, name)
    assert caption.endswith(".") and name.startswith(kind.FAMILIES)
    assert b"CreationDate" not in first["pdf"] and b"<dc:date>" not in first["svg"]


@pytest.mark.parametrize("draw", kind.FIGURES)
def test_nothing_to_draw(draw):
    assert list(draw(only())) == []


def test_balance_of_nan_is_left_out_of_the_drawing():
    series = short_columns(
        translational_on_step_J=(1, "NaN", "Infinity"), elastic_J=(1, 1, "-Infinity")
    )
    found = energy_account.balance(series)[1]
    assert found[0] == 0 and math.isnan(found[1]) and math.isnan(found[2])
    ((name, _, figure),) = figure_energy.draw(only(series={("s", "double"): series}))
    assert figure_style.render(figure, name)["png"]


def test_kinetic_energy_alone_is_drawn():
    series = {
        ("s", "float"): short_columns(kinetic_half_step_J=(1, 2, 3), mean_x_m=(0, 0, 0))
    }
    ((_, caption, figure),) = figure_energy.draw(only(series=series))
    assert "no account was kept" in caption
    figure_style.render(figure, "energy_s")


def test_thinning_keeps_the_peak():
    times = list(range(100000))
    values = [1.0] * 100000
    values[54321] = 7.0
    _, kept = figure_energy._thinned(times, values)
    assert len(kept) <= 4000 and max(kept) == 7.0


def test_spheres_are_sorted_by_depth():
    given = {
        "shape": ["sphere", "facet", "sphere", "sphere"],
        "x_m": [1.0, 9.0, 2.0, 3.0],
        "y_m": [0.0, 0.0, 0.0, math.nan],
        "z_m": [0.5, 0.0, -0.5, 0.0],
        "radius_m": [0.1] * 4,
        "kinetic_J": [1e-3, 5.0, 0.0, 1.0],
    }
    found = figure_snapshots.spheres(given)
    assert found[:, 0].tolist() == [2.0, 1.0], "the farthest first; no facet, no NaN"
    assert figure_snapshots.energy_range([found]) == (1e-4, 1e-3)


@pytest.mark.parametrize(
    "energies, expected, why",
    [
        ([0.0, 0.0], (1e-12, 1.0), "all at rest"),
        ([1.0, 1e-20], (1e-6, 1.0), "not more than six decades"),
        ([math.inf, 2.0, 0.5], (0.5, 2.0), "what is infinite has no colour of its own"),
    ],
)
def test_energy_range(energies, expected, why):
    table = numpy.array([[0, 0, 1, energy] for energy in energies], dtype=float)
    assert figure_snapshots.energy_range([table]) == pytest.approx(expected), why


def test_a_whole_deposition_stays_small(tmp_path):
    path = tmp_path / "deposition_double_1.csv"
    path.write_text(sample_scenes.snapshot(1000, 10009))
    given = csv_columns.read(path, (), {"body": str, "shape": str})
    snapshots = {("deposition", "double"): [(1, given)]}
    ((name, _, figure),) = figure_snapshots.draw(only(snapshots=snapshots))
    (panel,) = [axes for axes in figure.axes if axes.get_xlabel() == "x (m)"]
    # One collection: 10 009 patches, each an artist of its own, would take minutes.
    assert len(panel.collections) == 1 and not panel.patches
    files = figure_style.render(figure, name)
    assert max(map(len, files.values())) < 2e6


def test_identical_runs_have_no_divergence_to_draw():
    given = {name: [0.0, 1.0] for name in ("step", "time_s")}
    zero = ("max_position_error_m", "max_position_ulp")
    given.update((name, [0.0, 0.0]) for name in zero)
    found = figure_divergence.draw(only(divergences={("s", "double"): given}))
    assert list(found) == []


def test_benchmark_without_double():
    timing = sample_scenes.timing_record("float")
    timing["slowdown_against_double"] = None
    ((name, caption, figure),) = figure_benchmark.draw(only(timings=(timing,)))
    assert figure_style.render(figure, name)["png"]
