"""Tests of `ulpgate stress` through the program: records, verdicts, truths, exit codes, and what resumes."""

import functools
import json
import pathlib
import signal
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

import program  # noqa: E402
from program import ROOT  # noqa: E402

run = functools.partial(program.run, "stress", timeout=600)
SCHEMA = ROOT / "reports/schema/stress.schema.json"

# A second or two, of three kinds.
SMALL = [
    "--cases",
    "rump_1988,one_minus_cosine,robertson/radau3_to_40,henon_heiles/yoshida8_to_100",
    "--types",
    "float,double,mpfr62",
]


def rows(text):
    return [json.loads(line) for line in text.splitlines()]


def test_records_hold_to_their_schema_and_do_not_depend_on_threads(tmp_path):
    jsonschema = pytest.importorskip("jsonschema")
    code, one, err = run(*SMALL, "--json", "--threads", 1)
    assert code == 0, err
    code, two, err = run(*SMALL, "--json", "--threads", 3, "--out", tmp_path / "s")
    assert code == 0, err
    assert one == two
    assert (tmp_path / "s/stress.jsonl").read_text() == one
    schema = json.loads(SCHEMA.read_text())
    found = rows(one)
    for row in found:
        jsonschema.validate(row, schema)
    by_key = {(r["case"], r["form"], r["type"]): r for r in found}
    naive = by_key["one_minus_cosine", "naive", "double"]
    assert naive["verdict"] == "unstable" and naive["as_known"] and naive["cause"]
    assert by_key["one_minus_cosine", "half_angle", "double"]["verdict"] == "stable"
    assert (
        by_key["rump_1988", "original_order", "double"]["verdict"] == "ill_conditioned"
    )
    robertson = by_key["robertson", "radau3_to_40", "mpfr62"]
    assert robertson["error"] < 1e-55 < robertson["stepping_error"] < 1e-3


def test_a_reproducer_gives_its_row_again():
    code, out, _ = run(*SMALL, "--json")
    assert code == 0
    row = next(
        r for r in rows(out) if r["case"] == "robertson" and r["type"] == "float"
    )
    words = row["reproducer"].split()
    assert words[:2] == ["ulpgate", "stress"]
    code, again, _ = run(*words[2:], "--json")
    assert code == 0
    only = rows(again)
    assert len(only) == 1
    assert {k: v for k, v in only[0].items() if k != "plan"} == {
        k: v for k, v in row.items() if k != "plan"
    }


def test_a_finished_run_is_looked_at_again(tmp_path):
    out = tmp_path / "s"
    assert run(*SMALL, "--out", out)[0] == 0
    before = (out / "stress.jsonl").read_bytes()
    code, _, err = run(*SMALL, "--out", out, "--resume")
    assert code == 0 and "is complete already" in err
    assert (out / "stress.jsonl").read_bytes() == before
    # An edited record is not taken for what the run wrote.
    (out / "stress.jsonl").write_bytes(before.replace(b"unstable", b"stable__"))
    code, _, err = run(*SMALL, "--out", out, "--resume")
    assert code == 2 and "stress.jsonl" in err
    (out / "stress.jsonl").write_bytes(before)
    # Another plan does not write over it.
    code, _, err = run("--cases", "rump_1988", "--types", "double", "--out", out)
    assert code == 2, err


def test_a_killed_run_goes_on_to_the_same_bytes(tmp_path):
    cases = [
        f"robertson/{i}_to_40" for i in ("radau3", "radau5", "gauss4n", "rodas3")
    ] + ["chemakzo/radau3_to_180"]
    words = ["--cases", ",".join(cases), "--types", "double,mpfr62"]
    code, whole, err = run(*words, "--json")
    assert code == 0, err
    out = tmp_path / "s"
    with program.started("stress", *words, "--threads", "1", "--out", out) as process:
        program.wait_for_pieces(out, 3)
        process.send_signal(signal.SIGKILL)
        process.wait()
    assert not (out / "stress.jsonl").exists()
    code, _, err = run(*words, "--out", out, "--resume")
    assert code == 0, err
    assert (out / "stress.jsonl").read_text() == whole


def test_truth_prints_every_component_with_the_digits_asked_for():
    code, out, _ = run("--truth", "--cases", "robertson,kepler,e5", "--digits", 30)
    assert code == 0
    lines = [line.split("\t") for line in out.splitlines()]
    assert all(len(line) == 4 for line in lines)
    assert [line[:3] for line in lines if line[0] == "kepler"] == [
        ["kepler", "2 pi", str(i)] for i in (1, 2, 3, 4)
    ]
    assert [line[1] for line in lines if line[0] == "robertson" and line[2] == "1"] == [
        "40",
        "1e11",
        "4e11",
    ]
    value = next(line[3] for line in lines if line[:3] == ["robertson", "40", "1"])
    assert (
        value.startswith("7.1582706871940509")
        and len(value.split("e")[0].replace(".", "")) == 30
    )


def test_truth_says_which_published_values_are_wrong():
    code, _, err = run("--truth", "--cases", "e5")
    assert code == 0
    lines = err.splitlines()
    assert len(lines) == 5
    for line, holds in zip(
        lines,
        (
            "is WRONG: 0.0 of 16 digits hold",
            "is WRONG: 3.1 of 16",
            "is WRONG: 3.1 of 16",
            "holds",
        ),
    ):
        assert holds in line
    assert "published 0.1152903278711829e-290" in lines[0] and "e-3441" in lines[0]
    assert "3 are wrong: e5 t = 1e13 component 1, " in lines[4]
    code, _, err = run("--truth", "--cases", "kepler")
    assert code == 0 and err == ""


@pytest.mark.parametrize(
    "words, said",
    [
        (["--cases", "rump_198"], "rump_1988"),
        (["--kinds", "formulas"], "formula"),
        (["--types", "half"], "half"),
        (["--cases", "rump_1988", "--kinds", "scene"], "no case"),
        (["--resume"], "--out"),
        (["--truth", "--cases", "rump_1988"], "rump_1988"),
        (["--truth", "--digits", "0"], "--digits"),
        (["--digits", "30"], "--truth"),
        (["--truth", "--json"], "--json"),
    ],
)
def test_bad_usage_names_what_is_wrong(words, said):
    code, out, err = run(*words)
    assert code == 2 and out == ""
    assert said in err


def test_the_list_names_every_case_and_what_it_is():
    code, out, _ = run("--list")
    assert code == 0
    lines = out.splitlines()
    assert len(lines) > 150
    assert all(len(line.split(None, 1)) == 2 for line in lines)
    for kind in (
        "formula",
        "trajectory",
        "state",
        "scene",
        "metamorphic",
        "step_limit",
    ):
        assert any(line.startswith(kind + "/") for line in lines), kind
