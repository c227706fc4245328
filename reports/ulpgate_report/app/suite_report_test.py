"""Tests of the report of a whole suite: the page, what is left out and said, nothing stale."""
import json
import shutil
import sys

import pytest

from ulpgate_report.app import cli
from ulpgate_report.pendulum import kind
from ulpgate_report.records import reading
from ulpgate_report.testing import sample_pendulum, sample_records
from ulpgate_report.testing.page_check import References


@pytest.fixture
def suite_directory(tmp_path):
    """A small good suite."""
    tokens = ("float", "double", "mpfr150")
    return sample_pendulum.write_suite(
        tmp_path / "suite", tokens=tokens, end=3.0, every=5e-3
    )


def test_what_is_left_out_is_said(suite_directory, tmp_path, capsys):
    for dt in ("1e-5", "1e-6"):
        shutil.rmtree(suite_directory / f"dt_{dt}")
    (suite_directory / "orders" / "orders.jsonl").unlink()
    (suite_directory / "empty").mkdir()
    context = (suite_directory / "orders" / "context.json").read_text()
    (suite_directory / "empty" / "context.json").write_text(context)
    (suite_directory / "lost").mkdir()
    (suite_directory / "lost" / "scenes.jsonl").write_text("{}\n")
    math = sample_records.context(["sin"])
    sample_records.write(
        suite_directory / "sines", math, sample_records.math_records(math), []
    )
    (suite_directory / "report").mkdir()
    (suite_directory / "damped" / "series" / "angles.csv").write_text("t\n")
    out = tmp_path / "out"
    assert cli.main([str(suite_directory), "--out", str(out)]) == 0
    said = capsys.readouterr().err
    page = (out / "index.html").read_text("utf-8")
    for sentence in (
        "empty: no record; left out.",
        "orders: no record; left out.",
        "lost: records without context.json; left out.",
        "sines: functions and kernels are reported apart",
    ):
        assert sentence in said and sentence in page
    assert "damped/series/angles.csv: the name tells no scene" in said


def test_whole_report(suite_directory, tmp_path):
    # A second step would draw the same once more, a second type of the orders another panel.
    shutil.rmtree(suite_directory / "dt_1e-6")
    sample_pendulum.write_orders(suite_directory / "orders", tokens=("double",))
    out, again = tmp_path / "out", tmp_path / "again"
    assert cli.main([str(suite_directory), "--out", str(out)]) == 0
    page = (out / "index.html").read_text("utf-8")
    found = References()
    found.feed(page)
    assert len(set(found.ids)) == len(found.ids)
    assert {value[1:] for _, value in found.fetched} <= set(found.ids)
    shown = {"pendulum_divergence", "pendulum_energy", "order_table", "drift_table"}
    assert shown <= set(found.tables)
    summary = json.loads((out / "summary.json").read_text("utf-8"))
    reading.validator("summary").validate(summary)
    assert len(summary["correlations"]) == 4 and len(summary["scenes"]) == 6
    assert summary["plan"]["orders"] == sample_records.PLAN
    assert cli.main([str(suite_directory), "--out", str(again)]) == 0
    for path in out.rglob("*"):
        if path.is_file():
            same = (again / path.relative_to(out)).read_bytes()
            assert path.read_bytes() == same, path.name
    figures = [path.name for path in (out / "figures").glob("*.svg")]
    for draw in kind.FIGURES:
        family = sys.modules[draw.__module__].FAMILY
        assert any(name.startswith(f"{family}_") for name in figures), family
    # A report of the integrators alone leaves nothing of the pendulum behind.
    assert cli.main([str(suite_directory / "orders"), "--out", str(out)]) == 0
    names = {path.name.split(".")[0] for path in out.rglob("*") if path.is_file()}
    assert names == {
        "index",
        "summary",
        "tables",
        "orders_kepler",
        "order_table",
        "order_records",
        "drift_table",
        "pendulum_divergence",
        "pendulum_correlations",
        "pendulum_energy",
    }


def test_todays_columns_keep_the_ordinary_energy_figure(suite_directory, capsys):
    run = suite_directory / "dt_1e-5"
    for path in (run / "series").iterdir():
        lines = path.read_text().splitlines()
        short = [line.rsplit(",", 5)[0] for line in lines]
        path.write_text("\n".join(short) + "\n")
    out = suite_directory / "out"
    assert cli.main([str(run), "--out", str(out)]) == 0
    assert (out / "figures" / "energy_pendulum3.svg").exists()
    said = capsys.readouterr().err
    assert "No series with parts of the energy and energy_error_J" in said
    assert "no energy is drawn" not in said and "no speed" not in said
