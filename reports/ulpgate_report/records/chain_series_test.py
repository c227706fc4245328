"""Tests of reading the series of a chain: columns by name, thinning that keeps the largest error."""
import math

import numpy
import pytest

from ulpgate_report.records import chain_series, csv_columns
from ulpgate_report.testing import sample_pendulum


def test_a_series_is_read_by_names(tmp_path):
    path = tmp_path / "pendulum3_double.csv"
    path.write_text(sample_pendulum.series("double", end=4.0, every=1e-3))
    found = chain_series.read(path)
    assert list(found.parts) == [
        "translational_on_step",
        "elastic",
        "potential",
    ], "0 is left out"
    steps = numpy.diff(found.angle_times)
    assert steps == pytest.approx(1e-3), "without the first step, which is off the grid"
    assert len(found.part_times) == 2000 and found.part_times[0] == 1e-5
    assert found.part_times[-1] == 4.0
    turned = tmp_path / "turned.csv"
    lines = [line.split(",")[::-1] for line in path.read_text().splitlines()]
    turned.write_text("\n".join(map(",".join, lines)) + "\n")
    again = chain_series.read(turned)
    assert (again.angle == found.angle).all(), "the place of a column is nothing"
    for name, (times, values) in found.errors.items():
        assert (again.errors[name][1] == values).all()


def test_the_largest_error_survives_the_thinning(tmp_path):
    path = tmp_path / "pendulum3_double.csv"
    path.write_text(sample_pendulum.series("float", end=8.0, every=1e-3))
    columns = csv_columns.read(path, ())
    found = chain_series.read(path)
    for name in (chain_series.AVERAGED, chain_series.RAW):
        times, values = found.errors[name]
        assert len(times) <= chain_series.MOST_ERRORS
        assert max(values) == max(map(abs, columns[name]))
        assert (numpy.diff(times) > 0).all()


def test_stretches_pass_over_what_is_not_finite():
    times = numpy.arange(6.0)
    values = numpy.array([1, -math.inf, math.nan, -5, 2, 0])
    found = chain_series.largest_of_stretches(times, values, 2)
    assert found[0].tolist() == [3.0, 4.0] and found[1].tolist() == [5.0, 2.0]


@pytest.mark.parametrize(
    "columns, has_angle, errors, why",
    [
        ("angle_1_rad", True, 0, "angles alone"),
        ("energy_error_J", False, 1, "an error alone"),
        ("raw_energy_error_J", False, 1, "the raw one alone"),
    ],
)
def test_columns_are_optional(tmp_path, columns, has_angle, errors, why):
    path = tmp_path / "s.csv"
    path.write_text(f"step,time_s,{columns}\n0,0,0\n10,1e-4,1\n20,2e-4,2\n")
    found = chain_series.read(path)
    assert (found.angle is not None) is has_angle and len(found.errors) == errors, why
    assert found.parts == {}


def test_a_chain_is_told_by_its_columns(tmp_path):
    for header, expected in (
        ("step,time_s,kinetic_half_step_J,angle_1_rad", True),
        ("step,time_s,kinetic_half_step_J,energy_error_J", True),
        ("step,time_s,kinetic_half_step_J,elastic", False),
        ("", False),
    ):
        path = tmp_path / "s.csv"
        path.write_text(header + "\n")
        assert chain_series.is_chain(path) is expected, header
