"""Tests of suites and of loading the pendulum: what is one, what is refused, where nothing was measured."""
import json

import pytest

from ulpgate_report.app import cli
from ulpgate_report.records import pendulum_records, records, suite
from ulpgate_report.records.errors import NothingMeasured
from ulpgate_report.testing import sample_pendulum, sample_records, sample_scenes
from ulpgate_report.testing.changes import edit_line, with_fields, without

TOKENS = ("float", "double", "mpfr150")
SMALL = {"tokens": TOKENS, "end": 3.0, "every": 5e-3}


@pytest.fixture
def suite_directory(tmp_path):
    """A small good suite."""
    return sample_pendulum.write_suite(tmp_path / "suite", **SMALL)


def test_good_suite_loads(suite_directory):
    run = suite.load(suite_directory)
    names = [one.name for one in run.pendulum.runs]
    assert names == ["damped", "drift_mpfr62", "dt_1e-5", "dt_1e-6", "orders"]
    assert run.pendulum.type_tokens == ["float", "double", "float128", "mpfr62"] + [
        "mpfr150"
    ], "those of the orders too"
    assert len(run.pendulum.correlations) == 2 * (len(TOKENS) + 1)
    assert run.scenes.names == [
        "pendulum3_damped",
        "pendulum3_dt_1e-5",
        "pendulum3_dt_1e-6",
    ]
    assert run.scenes.not_missed == {"energy", "snapshots", "divergence", "benchmark"}
    assert not run.scenes.series and not run.scenes.snapshots
    assert run.context["plan"]["dt_1e-5"] == sample_records.PLAN
    assert run.context["tool"]["version"] and run.notes == ()


def test_a_run_by_itself_is_read_alone(suite_directory):
    run = suite.load(suite_directory / "dt_1e-5")
    (one,) = run.pendulum.runs
    assert one.name == "" and len(one.series) == len(TOKENS)
    assert run.scenes.names == ["pendulum3"]
    assert one.condition("pendulum3", "double").text == (
        "pendulum3, time step 1e-5 s, mass=yade"
    )
    orders = suite.load(suite_directory / "orders")
    assert orders.scenes is None and orders.pendulum.orders


def test_plain_scenes_have_no_pendulum(tmp_path):
    run = suite.load(sample_scenes.write_sample(tmp_path, ("double",), bodies=9))
    assert run.pendulum is None and not run.scenes.not_missed


def test_the_most_precise_type_is_told_by_its_bits(suite_directory):
    pendulum = suite.load(suite_directory).pendulum
    for tokens, expected in (
        (["mpfr62", "mpfr150", "cpp_bin_float62"], "mpfr150"),
        (["float", "double"], "double"),
        (["double", "mpfr40"], "mpfr40"),
    ):
        assert pendulum.most_precise(tokens) == expected


CORRELATION = "dt_1e-5/correlation.jsonl"
CURVE = "dt_1e-5/correlation/pendulum3_double_mpfr150.csv"
SERIES = "damped/series/pendulum3_double.csv"


@pytest.mark.parametrize(
    "name, line, change, named, why",
    [
        (CORRELATION, 2, lambda s: s[:30], f"{CORRELATION}:2", "truncated"),
        (CORRELATION, 3, without("t_s"), f"{CORRELATION}:3", "field missing"),
        (CORRELATION, 3, with_fields(odd=1), f"{CORRELATION}:3", "unknown field"),
        (CORRELATION, 3, with_fields(t_s=-1), f"{CORRELATION}:3: t_s", "negative"),
        (
            CORRELATION,
            3,
            with_fields(limited_by="luck"),
            f"{CORRELATION}:3: limited_by",
            "no limit",
        ),
        (
            CORRELATION,
            3,
            with_fields(against="../a"),
            f"{CORRELATION}:3: against",
            "would read elsewhere",
        ),
        (CORRELATION, 3, lambda s: s + "\n" + s, f"{CORRELATION}:4", "twice"),
        (CURVE, 4, lambda s: s + "x", f"{CURVE}:4: correlation", "no number"),
        (CURVE, 1, lambda s: "t,correlation", f"{CURVE}:1", "column missing"),
        (SERIES, 9, lambda s: s + ",1", f"{SERIES}:9", "too many fields"),
        (
            "dt_1e-6/snapshots/pendulum3_float_0.csv",
            2,
            lambda s: s.replace("sphere,", "sphere,a"),
            "dt_1e-6/snapshots/pendulum3_float_0.csv:2: x_m",
            "no number",
        ),
        (
            "orders/orders.jsonl",
            5,
            with_fields(dt=0),
            "orders/orders.jsonl:5: dt",
            "no step",
        ),
        (
            "orders/orders.jsonl",
            5,
            lambda s: s + "\n" + s,
            "orders/orders.jsonl:6",
            "twice",
        ),
        (
            "dt_1e-6/scenes.jsonl",
            1,
            with_fields(energy_slope="steep"),
            "dt_1e-6/scenes.jsonl:1: energy_slope",
            "no slope",
        ),
        ("damped/context.json", 1, lambda s: "{", "damped/context.json", "no JSON"),
    ],
)
def test_bad_input_is_refused(suite_directory, capsys, name, line, change, named, why):
    edit_line(suite_directory, name, line, change)
    assert cli.main([str(suite_directory), "--print"]) == 2, why
    assert named in capsys.readouterr().err, why


def test_runs_that_differ_are_told_apart(suite_directory):
    path = suite_directory / "damped" / "context.json"
    changed = json.loads(path.read_text())
    changed.update(cpu="another", complete=False)
    path.write_text(json.dumps(changed))
    context = suite.load(suite_directory).context
    assert context["cpu"] == {
        "damped": "another",
        "drift_mpfr62": "synthetic",
        "dt_1e-5": "synthetic",
        "dt_1e-6": "synthetic",
        "orders": "synthetic",
    }
    assert context["complete"] is False and context["compiler"] == "g++ 12.2.0"


@pytest.mark.parametrize("make", ["nothing", "empty runs", "functions alone"])
def test_nothing_measured(tmp_path, capsys, make):
    if make == "empty runs":
        (tmp_path / "a").mkdir()
        (tmp_path / "a" / "context.json").write_text(
            json.dumps(sample_scenes.context())
        )
    if make == "functions alone":
        context = sample_records.context(["sin"])
        sample_records.write(
            tmp_path / "a", context, sample_records.math_records(context), []
        )
    with pytest.raises(NothingMeasured):
        suite.load(tmp_path)
    assert cli.main([str(tmp_path), "--print"]) == 3
    assert str(tmp_path) in capsys.readouterr().err


def test_conditions_come_from_the_record_of_the_type():
    rows = [
        sample_pendulum.record("double", "1e-5", ""),
        sample_pendulum.record("float", "1e-6", "mass=yade"),
    ]
    run = pendulum_records.PendulumRun("a", records=tuple(rows))
    assert run.condition("pendulum3", "float").dt == "1e-6"
    assert run.condition("pendulum3", "mpfr62").dt == "1e-5", "any of the scene"
    assert run.condition("other", "double").text == "other"
    grouped = run.by_condition({("pendulum3", t): t for t in ("float", "double")})
    assert [c.variant for c in grouped] == ["mass=yade", ""]


def test_records_load_takes_the_chains_of_the_suite(suite_directory):
    for name in ("correlation.jsonl",):
        (suite_directory / "dt_1e-6" / name).unlink()
    for path in (suite_directory / "dt_1e-6" / "series").iterdir():
        path.unlink()
    alone = records.load(suite_directory / "dt_1e-6")
    assert alone.pendulum is None and alone.scenes.snapshots
    found = suite.load(suite_directory).pendulum
    (run,) = [one for one in found.runs if one.name == "dt_1e-6"]
    assert run.records and run.snapshots
