"""Tests of `ulpgate advise` through the program: what it recommends is run, and its error is below what was wanted."""

import json
import pathlib
import shlex
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

from program import run  # noqa: E402


TYPES = ["--types", "float,double,long_double"]
LATE = ["--until", "1e11", "--integrators", "radau3,radau5,rodas3,rk4"]
CASES = {
    "kepler": (1e-4, []),
    "robertson": (1e-8, LATE),
    "pendulum3": (1e-9, ["--until", "0.005"]),
    "collision": (1e-5, []),
}


def advice(name, error, *more):
    code, out, err = run("advise", name, "--error", error, *TYPES, *more, "--json")
    assert code in (0, 3), out + err
    return code, json.loads(out), err


@pytest.mark.parametrize("name", sorted(CASES))
def test_the_recommended_command_keeps_what_was_promised(name):
    error, more = CASES[name]
    code, found, err = advice(name, error, *more)
    assert code == 0, err
    setting = found["setting"]
    assert setting["failure"] is None and found["met"]
    # Measured once more, by a command of its own with a reference of its own.
    command = shlex.split(found["measure_again"])
    assert command[0] == "ulpgate"
    code, out, err = run(*command[1:], "--repeats", "0", "--json")
    assert code == 0, err
    rows = [json.loads(x) for x in out.splitlines()]
    again = next(r for r in rows if r["what"] == "work_precision")
    assert again["type"] == setting["type"] and again["steps"] == setting["steps"]
    # A scene is to be true all along, a problem at its end.
    counts = ["final_error"]
    counts += ["largest_error"] if again["subject"] == "scene" else []
    for key in counts:
        assert again[key] <= error
    for key in ("final_error", "largest_error", "instants"):
        assert again[key] is not None
    command = shlex.split(found["command"])
    code, out, err = run(*command[1:], "--json")
    assert code == 0, err
    row = json.loads(out.splitlines()[0])
    assert row["steps"] == setting["steps"] and row["type"] == setting["type"]


def test_nothing_cheaper_that_was_looked_at_meets_the_error():
    error = 1e-6
    _, found, _ = advice("kepler", error)
    best = found["setting"]["seconds"]
    for p in found["looked_at"]:
        if p["failure"] is None and p["final_error"] + p["reference_error"] <= error:
            # Rivals were timed again, together.
            assert p["seconds"] >= 0.6 * best
    assert len(found["curves"]) == len(
        {(c["type"], c["integrator"], c["planned"]) for c in found["curves"]}
    )


def test_equal_steps_do_not_follow_a_stiff_problem_to_its_late_end():
    error = 1e-8
    _, found, _ = advice("robertson", error, *LATE)
    assert found["setting"]["planned"] and "--dt plan:" in found["command"]
    planned = {c["planned"] for c in found["curves"]}
    assert planned == {True, False}, "both were tried"


def test_an_error_on_the_way_is_asked_for():
    error = 1e-6
    _, end, _ = advice("robertson", error, *LATE)
    _, along, _ = advice("robertson", error, *LATE, "--along")
    assert end["setting"]["largest_error"] > error >= along["setting"]["largest_error"]
    assert along["setting"]["evaluations"] > end["setting"]["evaluations"]


def test_it_looks_between_doublings():
    error = 1e-5
    _, found, _ = advice("kepler", error, "--integrators", "pefrl")
    mine = [
        p
        for p in found["looked_at"]
        if p["type"] == found["setting"]["type"] and not p.get("planned")
    ]
    steps = sorted(p["steps"] for p in mine)
    fails = [p["steps"] for p in mine if p["final_error"] > error]
    meets = [p["steps"] for p in mine if p["final_error"] <= error]
    assert len(steps) == len(set(steps))
    if meets:
        assert min(meets) <= 1.25 * max(fails)


def test_it_says_what_limits_the_setting():
    _, found, _ = advice("collision", 1e-5)
    assert found["limited_by"].startswith("time-stepping")
    assert "steps a contact" in found["contacts"]
    _, smooth, _ = advice("pendulum3", 1e-4, "--until", "0.005")
    assert smooth["contacts"] == "" and smooth["limited_by"]


def test_an_error_that_nothing_meets_is_exit_3_with_the_best():
    code, out, err = run(
        *["advise", "kepler", "--error", "1e-12", "--types", "double"],
        *["--integrators", "leapfrog", "--time", "0.05"],
    )
    assert code == 3 and "no setting meets" in err
    assert "the nearest" in out and "leapfrog" in out


def test_records_are_rested_on(tmp_path):
    records = tmp_path / "records"
    code, _, err = run(
        *["work-precision", "--cases", "kepler", "--integrators", "gauss4,yoshida8"],
        *[
            "--types",
            "double",
            "--steps",
            "16..32768",
            "--repeats",
            "2",
            "--out",
            records,
        ],
    )
    assert code == 0, err
    more = [
        "--integrators",
        "gauss4,yoshida8",
        "--types",
        "double",
        "--records",
        records,
    ]
    code, out, err = run("advise", "kepler", "--error", "1e-4", *more, "--json")
    assert code == 0, err
    looked = json.loads(out)["looked_at"]
    # How many of them depends on which rival is the quicker.
    assert any("work_precision.jsonl:" in p["from"] for p in looked)
    with open(records / "work_precision.jsonl", "a", encoding="utf-8") as file:
        file.write("{}\n")
    code, _, err = run("advise", "kepler", "--error", "1e-4", *more)
    assert code == 2 and "work_precision.jsonl" in err


def test_a_directory_of_advice_can_be_rested_on(tmp_path):
    first = ["advise", "kepler", "--error", "1e-3", *TYPES, "--out", tmp_path]
    code, out, err = run(*first)
    assert code == 0, err
    kept = json.loads((tmp_path / "advice.json").read_text())
    assert kept["met"] and kept["command"] in out
    code, out, err = run(
        *[
            "advise",
            "kepler",
            "--error",
            "1e-3",
            *TYPES,
            "--records",
            tmp_path,
            "--json",
        ]
    )
    assert code == 0, err
    again = json.loads(out)
    recorded = sum("work_precision.jsonl:" in p["from"] for p in again["looked_at"])
    assert recorded > len(again["looked_at"]) / 2


REFUSED = [
    (2, ["keplr", "--error", "1e-3"], "kepler"),
    (2, ["kepler"], "--error"),
    (2, ["kepler", "--error", "0"], "--error"),
    (2, ["kepler", "--error", "nan"], "--error"),
    (2, ["kepler", "--error", "1e-3", "--until", "7"], "2 pi"),
    (2, ["kepler", "--error", "1e-3", "--set", "damping=0"], "--set"),
    (2, ["robertson", "--error", "1e-3", "--time", "1e11"], "--until 1e11"),
    (3, ["kepler", "--error", "1e-30", "--types", "float,double"], "roundoff"),
    (3, ["collision", "--error", "1e-3", "--integrators", "gauss2"], "applies"),
]


@pytest.mark.parametrize("code,more,message", REFUSED)
def test_what_is_asked_wrongly_is_refused(code, more, message):
    got, out, err = run("advise", *more)
    assert got == code and message in err, out + err
