"""Tests of the pendulum's tables: properties, not bytes; and that LaTeX takes them."""
import pytest

from ulpgate_report.pendulum import kind, published, tables
from ulpgate_report.records import pendulum_records
from ulpgate_report.tables import table_text
from ulpgate_report.testing import sample_pendulum
from ulpgate_report.testing.table_check import compile_tables, csv_rows, needs_latex


def pendulum(correlations=(), records=(), **what):
    """A pendulum of one run."""
    run = pendulum_records.PendulumRun("", tuple(records), tuple(correlations), **what)
    return pendulum_records.Pendulum((run,))


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
    assert rows[2]["t_s_dt_1e-5"] == "9.30 t", "time-stepping limits it"
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
