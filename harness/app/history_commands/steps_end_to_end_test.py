"""Ten runs of the program, from one of which on exp is slower by a fifth and from another on pow is off by 1 ULP more: both are named,
and nothing else.

The records are the program's; the times are drawn, from what a shared machine gives, so that a verdict is that of the statistics alone.
With ULPGATE_MEASURE_STEPS=1 they are taken of a slower exp, which a machine with nothing else to do must pass as well."""

import json
import os
import pathlib
import random
import shutil
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

from program import run  # noqa: E402

SOURCE = pathlib.Path(__file__).with_name("altered_functions.c")
COMMITS = [f"commit{i}" for i in range(10)]
SLOW_FROM, INEXACT_FROM = 5, 7
MEASURED = os.environ.get("ULPGATE_MEASURE_STEPS") == "1"
PROCESSES, ROUNDS = 5, 5
# None of them calls exp or pow of double within another's, but for the two.
FUNCTIONS = "exp pow sin cos log atan cbrt exp2 log1p".split()
TYPES = "float", "double"
MATH = f"math --functions {','.join(FUNCTIONS)} --types {','.join(TYPES)} --strata uniform,edges --samples 400"
TAKEN = f"repeats --timing-processes {PROCESSES} --timing-rounds {ROUNDS}"


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    made = tmp_path_factory.mktemp("library") / "altered_functions.so"
    subprocess.run(
        ["cc", "-O2", "-shared", "-fPIC", "-o", made, SOURCE, "-ldl", "-lm"], check=True
    )
    return made


def times(draw, nanoseconds, clock):
    """Processes of rounds: each process has a place in memory of its own, a round now and then is disturbed."""
    processes = [clock * draw.lognormvariate(0, 0.01) for _ in range(PROCESSES)]
    return [
        [
            nanoseconds
            * process
            * (1 + abs(draw.gauss(0, 0.01)))
            * (draw.uniform(1.2, 3) if draw.random() < 0.1 else 1)
            for _ in range(ROUNDS)
        ]
        for process in processes
    ]


def write_times(directory, draw, exp_factor):
    """A run's times: clock differs from run to run, and the baseline with it."""
    clock = draw.uniform(0.9, 1.3)
    lines = []
    for i, name in enumerate(FUNCTIONS):
        for type_ in TYPES:
            slow = exp_factor if (name, type_) == ("exp", "double") else 1
            row = {"what": name, "type": type_, "batch": 512}
            row["ns"] = times(draw, (5 + 2 * i) * slow, clock)
            row["baseline_ns"] = times(draw, 185_000, clock)
            lines.append(json.dumps(row) + "\n")
    (directory / "timing_repeats.jsonl").write_text("".join(lines))


def plan_of(i):
    return ["slow-exp"] * (i >= SLOW_FROM) + ["ulp-pow"] * (i >= INEXACT_FROM)


def run_altered(library, plan, timing, out):
    env = {
        **os.environ,
        "LD_PRELOAD": str(library),
        "ALTERED_FUNCTIONS": " ".join(plan),
    }
    words = [*MATH.split(), "--timing", *timing.split(), "--out", out]
    code, _, err = run(*words, env=env)
    assert code in (0, 1), err


def draw_runs(folder, library, seed):
    draw = random.Random(seed)
    for name, plan in (("right", []), ("inexact", ["ulp-pow"])):
        run_altered(library, plan, "off", folder / name)
    for i, commit in enumerate(COMMITS):
        plan = plan_of(i)
        records = folder / ("inexact" if "ulp-pow" in plan else "right")
        shutil.copytree(records, folder / commit)
        write_times(folder / commit, draw, 1.2 if "slow-exp" in plan else 1)


def measure_runs(folder, library):
    # Shuffled, so that what the machine does meanwhile is no step from one commit to the next.
    for i in (3, 8, 0, 6, 1, 9, 4, 7, 2, 5):
        run_altered(library, plan_of(i), TAKEN, folder / COMMITS[i])


@pytest.fixture(scope="module", params=["measured"] if MEASURED else range(1, 6))
def history(request, tmp_path_factory, library):
    """Folder of ten runs, and the steps that the file of them is said to have."""
    folder = tmp_path_factory.mktemp("history")
    if MEASURED:
        measure_runs(folder, library)
    else:
        draw_runs(folder, library, request.param)
    for i, commit in enumerate(COMMITS):
        words = ["--commit", commit, "--time", 1_700_000_000 + 86_400 * i]
        added = ["history", "--add", folder / commit, "--db", folder / "h.sqlite"]
        code, _, err = run(*added, *words)
        assert code == 0, err
    code, out, err = run("history", "--steps", "--json", "--db", folder / "h.sqlite")
    assert code == 0, err
    return folder, json.loads(out)


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
