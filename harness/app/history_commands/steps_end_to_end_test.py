"""Ten runs of the program, from one of which on exp is slower by a fifth and from another on pow is off by 1 ULP more: both are named,
and nothing else."""

import json
import os
import pathlib
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

from program import run  # noqa: E402

SOURCE = pathlib.Path(__file__).with_name("altered_functions.c")
COMMITS = [f"commit{i}" for i in range(10)]
SLOW_FROM, INEXACT_FROM = 5, 7
# None of them calls exp or pow of double within another's, but for the two.
MATH = "math --functions exp,pow,sin,cos,log,atan,cbrt,exp2,log1p --types float,double --strata uniform,edges"
MATH += " --samples 400 --timing repeats --timing-processes 5 --timing-rounds 5 --out"


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    made = tmp_path_factory.mktemp("library") / "altered_functions.so"
    subprocess.run(
        ["cc", "-O2", "-shared", "-fPIC", "-o", made, SOURCE, "-ldl", "-lm"], check=True
    )
    return made


def measured(folder, library):
    """Steps that the file of ten runs, each of its own process, is said to have."""
    # Shuffled, so that what the machine does meanwhile is no step from one commit to the next.
    for i in (3, 8, 0, 6, 1, 9, 4, 7, 2, 5):
        plan = ["slow-exp"] * (i >= SLOW_FROM) + ["ulp-pow"] * (i >= INEXACT_FROM)
        env = {
            **os.environ,
            "LD_PRELOAD": str(library),
            "ALTERED_FUNCTIONS": " ".join(plan),
        }
        code, _, err = run(*MATH.split(), folder / COMMITS[i], env=env)
        assert code in (0, 1), err
    for i, commit in enumerate(COMMITS):
        words = ["--commit", commit, "--time", 1_700_000_000 + 86_400 * i]
        added = ["history", "--add", folder / commit, "--db", folder / "h.sqlite"]
        assert run(*added, *words)[0] == 0
    code, out, err = run("history", "--steps", "--json", "--db", folder / "h.sqlite")
    assert code == 0, err
    return json.loads(out)


def slower(steps):
    return [
        (s["name"], s["type"], s["commit"], s["before"], s["change"])
        for s in steps
        if s["what"] == "speed"
    ]


def changed_times(first, second):
    """What `compare` says to be slower or faster in the second of two runs; exit code, the rest of what it says."""
    code, out, err = run("compare", first, second, "--json")
    found = json.loads(out)
    changed = {
        (t["name"], t["type"]) for t in found["times"] if t["change"] != "the same"
    }
    return changed, code, found["rows"], err


EXP = ("exp", "double", COMMITS[SLOW_FROM], COMMITS[SLOW_FROM - 1], "worse")


@pytest.fixture(scope="module")
def history(tmp_path_factory, library):
    """Folder and steps of a history.  Times are taken again, four times at most, where the machine was busy with something
    else: a step that is not there and is found five times is not the machine's."""
    for _ in range(5):
        folder = tmp_path_factory.mktemp("history")
        steps = measured(folder, library)
        runs = folder / COMMITS[SLOW_FROM - 1], folder / COMMITS[SLOW_FROM]
        if slower(steps) == [EXP] and changed_times(*runs)[0] <= {EXP[:2]}:
            break
    return folder, steps


def test_exactly_what_was_planted_is_named(history):
    _, steps = history
    assert slower(steps) == [EXP], steps
    inexact = [s for s in steps if s["what"] == "accuracy"]
    assert inexact, steps
    assert {(s["name"], s["type"], s["commit"]) for s in inexact} == {
        ("pow", "double", COMMITS[INEXACT_FROM])
    }
    assert all(s["change"] == "worse" and s["platform"] == "" for s in inexact)


def test_the_trend_of_each_names_its_commit(history):
    folder, _ = history
    for name, commit in (("exp", SLOW_FROM), ("pow", INEXACT_FROM)):
        code, out, err = run("history", name, "double", "--db", folder / "h.sqlite")
        assert code == 0, err
        assert all(c in out for c in COMMITS), "a line for every run"
        steps = [line for line in out.splitlines() if line.startswith("WORSE")]
        assert steps and all(f" at {COMMITS[commit]} " in line for line in steps)
        assert "▁" in out and "█" in out
    code, out, _ = run("history", "sin", "double", "--db", folder / "h.sqlite")
    assert code == 0 and "no step" in out


def test_compare_says_the_same_of_two_of_the_runs(history):
    folder, _ = history
    first, slow, last = (
        folder / COMMITS[i] for i in (SLOW_FROM - 1, SLOW_FROM, INEXACT_FROM)
    )
    # One run against one: the noise floor of a busy machine may hide a fifth, but nothing else may be named.
    changed, code, rows, err = changed_times(first, slow)
    assert changed <= {EXP[:2]}
    assert rows == [] and code == (1 if changed else 0), err
    code, out, _ = run("compare", slow, last, "--json")
    found = json.loads(out)
    assert code == 1
    assert {(r["name"], r["type"], r["change"]) for r in found["rows"]} == {
        ("pow", "double", "worse")
    }
    row = found["rows"][0]
    assert row["after"]["error"] > row["before"]["error"] + 0.4
