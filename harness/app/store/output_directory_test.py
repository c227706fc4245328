"""Tests of who owns a directory of records: locks, other verbs, plans, selections and shards, what --overwrite takes.

The rows in the names are those of harness/FAULTS.md."""

import json
import os
import pathlib
import signal
import subprocess
import time

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))

MATH = ["math", "--functions", "sqrt", "--types", "float", "--strata", "edges"]
MATH += ["--timing", "off"]
KERNELS = [
    "kernels",
    "--kernels",
    "sphere_sphere",
    "--types",
    "float",
    "--samples",
    "2",
]
ORDERS = ["integrators", "--types", "double", "--problems", "oscillator"]
ORDERS += ["--integrators", "forest_ruth", "--most-steps", "512"]
SCENE = ["scene", "run", "collision", "--steps", "20", "--types", "float", "--series"]
VERBS = {"math": MATH, "kernels": KERNELS, "integrators": ORDERS, "scene": SCENE}
# Minutes of work, in units of milliseconds.
LONG = ["math", "--functions", "tgamma", "--types", "mpfr150", "--strata", "uniform"]
LONG += ["--samples", "2000000", "--timing", "off"]


def run(*words):
    done = subprocess.run(
        [ULPGATE, *map(str, words)], capture_output=True, text=True, cwd=ROOT
    )
    return done.returncode, done.stderr


def bytes_of(directory):
    return {
        str(p.relative_to(directory)): p.read_bytes()
        for p in sorted(directory.rglob("*"))
        if p.is_file()
    }


@pytest.fixture
def busy(tmp_path):
    """A directory in which a process works, with units kept already."""
    out = tmp_path / "busy"
    process = subprocess.Popen(
        [ULPGATE, *LONG, "--out", str(out)],
        stderr=subprocess.DEVNULL,
        cwd=ROOT,
        start_new_session=True,
    )
    log = out / "units/log.txt"
    while process.poll() is None and not (log.exists() and log.stat().st_size > 2000):
        time.sleep(0.02)
    assert process.poll() is None, "the run ended too early"
    os.kill(process.pid, signal.SIGSTOP)
    yield out
    process.kill()
    process.wait()


@pytest.mark.parametrize("second", VERBS)
@pytest.mark.parametrize("first", VERBS)
def test_b1_records_of_another_verb_are_not_written_over(tmp_path, first, second):
    if first == second:
        pytest.skip("the same run")
    out = tmp_path / "out"
    assert run(*VERBS[first], "--out", out)[0] == 0
    before = bytes_of(out)
    code, err = run(*VERBS[second], "--out", out)
    assert code == 2 and "another plan" in err and str(out) in err
    assert bytes_of(out) == before


def test_b1_a_scene_of_another_plan_is_not_written_over(tmp_path):
    out = tmp_path / "out"
    assert run(*SCENE, "--out", out)[0] == 0
    before = bytes_of(out)
    code, err = run(*SCENE[:3], "--steps", "30", *SCENE[5:], "--out", out)
    assert code == 2 and "another plan" in err
    assert bytes_of(out) == before


def test_b1_a_scene_of_other_types_is_not_written_over(tmp_path):
    out = tmp_path / "out"
    assert run(*SCENE, "--out", out)[0] == 0
    code, err = run(*SCENE[:-3], "--types", "double", "--series", "--out", out)
    assert code == 2 and "another selection" in err
    assert (out / "series/collision_float.csv").exists()


def test_b1_overwrite_leaves_no_stale_series(tmp_path):
    out = tmp_path / "out"
    assert run(*SCENE, "--out", out)[0] == 0
    (out / "notes.txt").write_text("mine")
    words = [
        "scene",
        "run",
        "cradle",
        "--steps",
        "5",
        "--types",
        "float",
        "--overwrite",
    ]
    assert run(*words, "--out", out)[0] == 0
    assert sorted(bytes_of(out)) == ["context.json", "notes.txt", "scenes.jsonl"]


def test_b1_another_shard_of_the_same_plan_is_not_written_over(tmp_path):
    out = tmp_path / "out"
    assert run(*MATH, "--shard", "0/2", "--out", out)[0] == 0
    before = bytes_of(out)
    code, err = run(*MATH, "--shard", "1/2", "--out", out)
    assert code == 2 and "another shard (0/2)" in err
    assert bytes_of(out) == before


def test_b1_records_without_a_context_are_not_written_over(tmp_path):
    out = tmp_path / "out"
    assert run(*MATH, "--out", out)[0] == 0
    (out / "context.json").unlink()
    code, err = run(*MATH, "--out", out)
    assert code == 2 and "math.jsonl without a context.json" in err


def test_b1_a_context_that_is_none_is_no_licence(tmp_path):
    out = tmp_path / "out"
    assert run(*MATH, "--out", out)[0] == 0
    for text in ("[]", "{", '{"plan": 7}', '{"plan": null, "shards": 3}'):
        (out / "context.json").write_text(text)
        code, err = run(*MATH, "--out", out)
        assert code == 2 and "choose another --out" in err, text


def test_the_same_run_may_be_made_again(tmp_path):
    for name, words in VERBS.items():
        out = tmp_path / name
        assert run(*words, "--out", out)[0] == 0
        before = bytes_of(out)
        assert run(*words, "--out", out)[0] == 0
        assert bytes_of(out) == before


def test_b2_a_refused_process_removes_nothing(busy):
    before = bytes_of(busy)
    for more in ([], ["--overwrite"], ["--resume"], ["--seed", "9", "--overwrite"]):
        code, err = run(*LONG, *more, "--out", busy)
        assert code == 2 and "another process works in" in err
    assert bytes_of(busy) == before


def test_b3_two_scenes_in_one_directory(tmp_path):
    out = tmp_path / "out"
    words = ["scene", "run", "deposition", "--types", "mpfr62", "--series"]
    first = subprocess.Popen(
        [ULPGATE, *words, "--out", str(out)], stderr=subprocess.DEVNULL, cwd=ROOT
    )
    try:
        while first.poll() is None and not (out / "context.json").exists():
            time.sleep(0.02)
        assert first.poll() is None, "the run ended too early"
        os.kill(first.pid, signal.SIGSTOP)
        before = bytes_of(out)
        for more in ([], ["--overwrite"]):
            code, err = run(*SCENE, *more, "--out", out)
            assert code == 2 and "another process works in" in err
        assert bytes_of(out) == before
    finally:
        first.kill()
        first.wait()


def test_a_run_says_from_its_start_that_it_is_not_finished(busy):
    context = json.loads((busy / "context.json").read_text())
    assert context["verb"] == "math"
    assert context["finished"] is False and context["complete"] is False


def test_what_a_killed_process_wrote_aside_is_removed(tmp_path):
    """A process killed between writing NAME.PID-THREAD.part and renaming it; other files are somebody's."""
    whole, out = tmp_path / "whole", tmp_path / "out"
    for directory in (whole, out):
        assert run(*SCENE, "--out", directory)[0] == 0
    remnants = ["context.json.10313-10313.part", "series/a.csv.1-22.part"]
    others = ["my.part", "notes-1.part", "a.1-.part", "a.-1.part", ".1-2.part"]
    for name in remnants + others:
        (out / name).write_text("torn")
    assert run(*SCENE, "--out", out)[0] == 0
    found = bytes_of(out)
    assert set(found) == set(bytes_of(whole)) | set(others)


def test_a_killed_scene_wants_a_decision(tmp_path):
    out = tmp_path / "out"
    words = ["scene", "run", "deposition", "--types", "mpfr62", "--series"]
    words += ["--checkpoint-seconds", "0.05"]
    process = subprocess.Popen(
        [ULPGATE, *words, "--out", str(out)], stderr=subprocess.DEVNULL, cwd=ROOT
    )
    while process.poll() is None and not (out / "checkpoints").exists():
        time.sleep(0.02)
    process.kill()
    process.wait()
    code, err = run(*words, "--out", out)
    assert code == 2 and "--resume" in err and "--overwrite" in err


def test_b1_merge_replaces_neither_another_plan_nor_its_inputs(tmp_path):
    shards = [tmp_path / "s0", tmp_path / "s1"]
    more = ["--functions", "sqrt,exp", "--strata", "edges,uniform", "--samples", "3000"]
    for i, shard in enumerate(shards):
        words = ["math", "--types", "float", *more, "--timing", "off"]
        assert run(*words, "--shard", f"{i}/2", "--out", shard)[0] == 0
    other = tmp_path / "other"
    assert run(*MATH, "--out", other)[0] == 0
    before = {d: bytes_of(d) for d in (*shards, other)}
    assert run("merge", *shards, "--out", shards[1])[0] == 2
    code, err = run("merge", *shards, "--out", other)
    assert code == 2 and "another plan" in err
    assert {d: bytes_of(d) for d in (*shards, other)} == before
    assert run("merge", *shards, "--out", tmp_path / "all")[0] == 0
    assert run("merge", *shards, "--out", tmp_path / "all")[0] == 0
    assert run("merge", *shards, "--out", other, "--overwrite")[0] == 0
    assert bytes_of(other) == bytes_of(tmp_path / "all")


def test_a_dry_run_measures_nothing(tmp_path):
    done = subprocess.run(
        [ULPGATE, *MATH, "--dry-run", "--out", str(tmp_path / "out")],
        capture_output=True,
        text=True,
        cwd=ROOT,
    )
    facts = json.loads(done.stdout)
    assert done.returncode == 0 and not (tmp_path / "out").exists()
    assert run(*MATH, "--out", tmp_path / "out")[0] == 0
    context = json.loads((tmp_path / "out/context.json").read_text())
    assert facts["plan"] == context["plan"] and facts["units"] == 1
