"""Tests of loading: each kind of bad input is refused, by file and line."""
import pytest

from ulpgate_report.app import cli
from ulpgate_report.records import records
from ulpgate_report.testing import sample_records
from ulpgate_report.testing.changes import edit_line, with_fields, without


@pytest.fixture
def run_directory(tmp_path):
    """A small good run."""
    return sample_records.write_sample(tmp_path / "run", ["sin", "ctan"])


def test_good_run_loads(run_directory):
    run = records.load(run_directory)
    assert len(run.math) == 3 * 7 * 6
    assert run.time_ns["sin", "double"] > 0


@pytest.mark.parametrize(
    "name, line, change, named, why",
    [
        ("math.jsonl", 3, lambda s: s[: len(s) // 2], "math.jsonl:3", "truncated"),
        ("math.jsonl", 2, lambda s: "[1]", "math.jsonl:2", "not an object"),
        ("math.jsonl", 5, with_fields(max_ulp=-1), "math.jsonl:5: max_ulp", "negative"),
        (
            "math.jsonl",
            5,
            with_fields(max_ulp="big"),
            "math.jsonl:5: max_ulp",
            "no number",
        ),
        ("math.jsonl", 4, with_fields(extra=1), "math.jsonl:4", "unknown field"),
        ("math.jsonl", 4, without("judged"), "math.jsonl:4", "field missing"),
        (
            "math.jsonl",
            4,
            with_fields(mismatch={"odd": 1}),
            "math.jsonl:4",
            "unknown class",
        ),
        (
            "math.jsonl",
            1,
            with_fields(function="qux"),
            "math.jsonl:1: qux",
            "not in context",
        ),
        (
            "math.jsonl",
            1,
            with_fields(part="value"),
            "math.jsonl:1: ctan value",
            "no such part",
        ),
        (
            "math.jsonl",
            1,
            with_fields(type="half"),
            "math.jsonl:1: half",
            "not in context",
        ),
        (
            "math.jsonl",
            1,
            with_fields(stratum="odd"),
            "math.jsonl:1: odd",
            "not in context",
        ),
        (
            "math.jsonl",
            1,
            with_fields(plan="f" * 16),
            "math.jsonl:1: plan",
            "another plan",
        ),
        (
            "math.jsonl",
            6,
            lambda s: s.replace('"samples": 1000', '"samples": NaN'),
            "math.jsonl:6",
            "NaN is not JSON",
        ),
        (
            "math.jsonl",
            2,
            lambda s: s + "\n" + s,
            "math.jsonl:3",
            "twice the same record",
        ),
        ("timing.jsonl", 2, with_fields(ns_per_eval=0), "timing.jsonl:2", "no time"),
        ("timing.jsonl", 2, lambda s: "{", "timing.jsonl:2", "truncated"),
        ("context.json", 1, lambda s: s[:-9], "context.json:2", "ends too soon"),
        ("context.json", 1, without("plan"), "context.json", "field missing"),
    ],
)
def test_bad_input_is_refused(run_directory, capsys, name, line, change, named, why):
    edit_line(run_directory, name, line, change)
    assert cli.main([str(run_directory), "--print"]) == 2, why
    assert named in capsys.readouterr().err, why


def test_invalid_utf8_names_the_line(run_directory, capsys):
    path = run_directory / "math.jsonl"
    lines = path.read_bytes().split(b"\n")
    lines[2] = b"\xff" + lines[2]
    path.write_bytes(b"\n".join(lines))
    assert cli.main([str(run_directory), "--print"]) == 2
    assert "math.jsonl:3" in capsys.readouterr().err


@pytest.mark.parametrize(
    "prepare, why",
    [
        (lambda d: (d / "math.jsonl").write_text("\n"), "no line"),
        (lambda d: (d / "math.jsonl").unlink(), "no file"),
        (
            lambda d: (d / "math.jsonl").write_text(
                with_fields(samples=0, judged=0)(
                    (d / "math.jsonl").read_text().split("\n")[0]
                )
            ),
            "no sample",
        ),
    ],
)
def test_empty_run(run_directory, prepare, why):
    prepare(run_directory)
    assert cli.main([str(run_directory), "--print"]) == 3, why


def test_timing_is_optional_and_may_hold_more(run_directory):
    edit_line(run_directory, "timing.jsonl", 1, with_fields(what="a_kernel"))
    assert ("a_kernel", "float") in records.load(run_directory).time_ns
    (run_directory / "timing.jsonl").unlink()
    assert records.load(run_directory).time_ns == {}


def test_incomplete_run_is_said_to_be(run_directory, capsys):
    edit_line(run_directory, "context.json", 1, with_fields(complete=False))
    assert cli.main([str(run_directory), "--print"]) == 0
    assert "incomplete" in capsys.readouterr().err
