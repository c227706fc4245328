"""Tests of the pendulum's tables and of what its figures show: properties, not bytes."""
import csv
import io
import math

import numpy
import pytest

from ulpgate_report.pendulum import kind, published, tables
from ulpgate_report.records import chain_series, csv_columns, pendulum_records
from ulpgate_report.tables import table_csv, table_text
from ulpgate_report.testing import sample_pendulum
from ulpgate_report.testing.latex_check import compile_tables, needs_latex


def pendulum(correlations=(), records=(), **what):
    """A pendulum of one run."""
    run = pendulum_records.PendulumRun("", tuple(records), tuple(correlations), **what)
    return pendulum_records.Pendulum((run,))


def csv_rows(table):
    """A rendered CSV, read again."""
    return list(csv.DictReader(io.StringIO(table_csv.render(table))))


def correlations(steps=("1e-6", "1e-5"), variant="mass=yade"):
    """Lines of correlation.jsonl of several steps, in no order."""
    found = []
    for dt in steps:
        found += sample_pendulum.reference_records(dt, variant)
        for token in ("mpfr62", "double", "float"):
            found.append(sample_pendulum.correlation_record(token, dt, variant))
    return found


def test_divergence_table():
    given = correlations()
    table = tables.pendulum_divergence(pendulum(given))
    rows = csv_rows(table)
    assert [(r["type"], r["against"]) for r in rows] == [
        ("float", "mpfr150"),
        ("double", "mpfr150"),
        ("mpfr62", "mpfr150"),
        ("mpfr150", "its own RealHP<4>"),
        ("mpfr150", "half its step"),
    ]
    assert list(rows[0])[4:] == ["t_s_dt_1e-5", "t_s_dt_1e-6", "published_t_s"]
    assert rows[1]["t_s_dt_1e-5"] == "2.90 r" and rows[1]["published_t_s"] == "2.5"
    assert rows[2]["t_s_dt_1e-5"] == "9.30 s", "time-stepping limits it"
    assert rows[3]["t_s_dt_1e-6"] == ">= 16.00 e" and not rows[3]["published_t_s"]
    assert published.CITATION in table.caption


@pytest.mark.parametrize(
    "steps, variant, why",
    [
        (("1e-6",), "mass=yade", "another step"),
        (("1e-5",), "", "another mass"),
        (("1e-5",), "mass=yade,damping=0.1", "damped"),
    ],
)
def test_nothing_published_beside_another_run(steps, variant, why):
    table = tables.pendulum_divergence(pendulum(correlations(steps, variant)))
    assert "published_t_s" not in [column.name for column in table.columns], why
    assert published.CITATION not in table.caption, why
    assert all(len(row) == len(table.columns) for row in table.rows)


def test_a_step_that_was_not_run_stays_empty():
    rows = [r for r in correlations() if (r["type"], r["dt"]) != ("double", "1e-6")]
    table = tables.pendulum_divergence(pendulum(rows))
    (row,) = [row for row in csv_rows(table) if row["type"] == "double"]
    assert row["t_s_dt_1e-6"] == "" and row["t_s_dt_1e-5"] == "2.90 r"
    text = table_text.render(table)
    assert "2.90 r" in text and "c-" not in text


def test_every_duration_with_its_number():
    rows = csv_rows(tables.pendulum_correlations(pendulum(correlations())))
    assert len(rows) == 10
    assert [row["dt_s"] for row in rows[:2]] == ["1e-5", "1e-6"], "the larger first"
    bounds = [row for row in rows if row["lower_bound"] == "yes"]
    assert {row["t_s"] for row in bounds} == {"16.0"}


def test_energy_table():
    records = [
        sample_pendulum.record("double", "1e-6"),
        sample_pendulum.record("double", "1e-5"),
        sample_pendulum.record("float", "1e-5", max_energy_error="inf"),
        sample_pendulum.record(
            "mpfr62", "1e-5", max_energy_error=None, max_energy_error_raw=None
        ),
    ]
    old = sample_pendulum.record("float128", "1e-5")
    for name in ("max_energy_error_raw", "energy_slope", "energy_slope_raw"):
        del old[name]
    rows = csv_rows(tables.pendulum_energy(pendulum((), [*records, old])))
    assert [(r["type"], r["dt_s"]) for r in rows] == [
        ("float", "1e-5"),
        ("double", "1e-5"),
        ("double", "1e-6"),
        ("float128", "1e-5"),
    ], "without an error no line"
    assert rows[0]["max_energy_error_J"] == "inf"
    assert float(rows[1]["max_energy_error_raw_J"]) > float(
        rows[1]["max_energy_error_J"]
    )
    assert (
        0.5 <= float(rows[1]["energy_slope"]) < 0.6 and not rows[1]["energy_slope_raw"]
    )
    assert rows[3]["max_energy_error_raw_J"] == rows[3]["energy_slope"] == ""


@needs_latex
def test_latex_compiles_and_fits(tmp_path):
    run = pendulum(
        correlations(("1e-5", "1e-6", "1e-7", "1e-8")),
        [sample_pendulum.record("cpp_bin_float62", dt) for dt in ("1e-5", "(1e-5)/2")],
        orders=tuple(sample_pendulum.order_records(steps=6)),
        drifts=tuple(sample_pendulum.drift_records()),
    )
    made = [make(run) for make, _ in kind.TABLES]
    for table, (make, _) in zip(made, kind.TABLES):
        assert table.name == make.__name__ and table.rows
    shown = [t for t, (_, formats) in zip(made, kind.TABLES) if "tex" in formats]
    assert "Overfull" not in compile_tables(shown, tmp_path)


def test_a_series_is_read_by_names(tmp_path):
    path = tmp_path / "pendulum3_double.csv"
    path.write_text(sample_pendulum.series("double", end=4.0, every=1e-3))
    found = chain_series.read(path)
    assert list(found.parts) == ["kinetic", "elastic", "potential"], "0 is left out"
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
