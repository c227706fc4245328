"""Tests of the verbs `kernels` and `scene` through the program: determinism, verdicts, bad input, reproducers."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import time

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))
SMALL = [
    "--kernels",
    "sphere_sphere,cundall_strack,rotation",
    "--types",
    "float,double",
]


def run(*words, **more):
    done = subprocess.run(
        [ULPGATE, *map(str, words)], capture_output=True, text=True, cwd=ROOT, **more
    )
    return done.returncode, done.stdout, done.stderr


def kernels(out, *words):
    code, _, err = run("kernels", *SMALL, "--samples", "150", "--out", out, *words)
    assert code == 0, err
    return (out / "kernels.jsonl").read_bytes()


def test_kernel_records_do_not_depend_on_threads_or_shards(tmp_path):
    # More states than a unit of work has.
    size = ["--kernels", "rotation", "--types", "float", "--samples", 2500]

    def many(name, *words):
        out = tmp_path / name
        code, _, err = run("kernels", *size, "--out", out, *words)
        assert code == 0, err
        return (out / "kernels.jsonl").read_bytes()

    one = many("one", "--threads", 1)
    assert many("two", "--threads", 2) == one
    for i in range(3):
        many(f"s{i}", "--shard", f"{i}/3")
    code, _, err = run(
        "merge", *(tmp_path / f"s{i}" for i in range(3)), "--out", tmp_path / "all"
    )
    assert code == 0, err
    assert (tmp_path / "all/kernels.jsonl").read_bytes() == one


def test_a_kernel_record_is_reproduced_by_at(tmp_path):
    rows = [json.loads(line) for line in kernels(tmp_path / "a").splitlines()]
    row = next(
        r
        for r in rows
        if (r["function"], r["part"], r["type"], r["stratum"])
        == ("sphere_sphere", "overlap", "double", "touching")
    )
    assert row["verdict"] == "stable" and row["max_ulp"] > 1e6
    code, out, err = run(
        "at", "sphere_sphere", "double", *row["normwise_argmax"], "--json"
    )
    assert code == 0, err
    quantity = json.loads(out)["quantities"][0]
    assert quantity["quantity"] == "overlap"
    assert quantity["normwise_error"] == pytest.approx(row["max_normwise"], rel=1e-9)


def test_kernel_budgets_pass_then_catch_a_worse_record(tmp_path):
    kernels(tmp_path / "a")
    budgets = tmp_path / "budgets"
    assert run("gate", tmp_path / "a", "--budgets", budgets, "--update")[0] == 0
    assert run("gate", tmp_path / "a", "--budgets", budgets)[0] == 0
    file = budgets / "double.toml"
    lines = file.read_text().splitlines()
    at = lines.index('[budget."rotation.new_orientation"]')
    assert lines[at + 1] == 'implementation = "ulpgate"'
    while not lines[at].startswith("over_condition = {"):
        at += 1
    lines[at] = "over_condition = { typical = 0.001 }"
    file.write_text("\n".join(lines) + "\n")
    code, out, _ = run("gate", tmp_path / "a", "--budgets", budgets)
    assert code == 1 and out.startswith("FAIL         rotation.new_orientation double")
    assert "reproduce: ulpgate at rotation double" in out


def test_no_kernel_holds_a_double():
    code, out, _ = run("kernels", "--audit")
    assert code == 0 and "0 hidden doubles" in out


BAD = [
    (["kernels", "--kernels", "sphere_spere", "--out", "x"], "did you mean"),
    (["kernels", "--strata", "deepest", "--out", "x"], "unknown stratum"),
    (["kernels"], "--out DIR is required"),
    (["at", "sphere_sphere", "double", "1", "2"], "takes 8 numbers"),
    (["scene", "run", "depositoin"], "did you mean 'deposition'"),
    (["scene", "run", "collision", "--dt", "-1"], "--dt '-1'"),
    (["scene", "run", "collision", "--set", "colour=red"], "colour"),
    (["scene", "run", "collision", "--record"], "--out"),
    (["scene", "run", "/nonexistent/scene.toml"], "/nonexistent/scene.toml"),
]


@pytest.mark.parametrize("words,message", BAD, ids=lambda x: " ".join(x)[:40])
def test_bad_usage_is_exit_2_or_names_the_file(words, message):
    code, _, err = run(*words)
    assert code in (2, 4) and message in err, (code, err)


def test_a_broken_scene_file_names_line_and_key(tmp_path):
    file = tmp_path / "mine.toml"
    text = (ROOT / "kernels/scenes/collision.toml").read_text()
    file.write_text(text.replace('radius = "0.01"', 'radius = "-0.01"', 1))
    line = file.read_text().splitlines().index('radius = "-0.01"') + 1
    code, _, err = run("scene", "run", file)
    assert code == 2 and f"mine.toml:{line}" in err and "radius" in err, err
    file.write_text(text)
    assert run("scene", "run", file)[0] == 0, "a user's file works like one built in"


def state(*words):
    code, out, err = run("scene", "run", *words, "--json")
    assert code == 0, err
    return [json.loads(line)["state_hash"] for line in out.splitlines()]


SCENES = "beam bouncing collision cradle packing pendulum3 rolling".split()


@pytest.mark.parametrize("scene", SCENES)
def test_threads_and_all_parts_give_the_same_bytes(scene):
    words = [scene, "--steps", "300", "--types", "float,double,mpfr62"]
    one = state(*words)
    assert state(*words, "--threads", "2") == one
    assert state(*words, "--threads", "4") == one
    assert state(*words, "--all-parts") == one


def test_deposition_facts():
    code, out, _ = run("scene", "run", "deposition", "--steps", "2", "--json")
    record = json.loads(out)
    assert code == 0 and record["bodies"] == 10009 + 12


def test_scene_writes_what_the_report_reads(tmp_path):
    code, _, err = run(
        *["scene", "compare", "collision", "--types", "float,double", "--record"],
        *["--snapshots", "0,1e-3", "--vtk", "--out", tmp_path],
    )
    assert code == 0, err
    assert len((tmp_path / "scenes.jsonl").read_text().splitlines()) == 2
    divergence = (tmp_path / "series/divergence_collision_float.csv").read_text()
    assert divergence.startswith("step,time_s,max_position_error_m")
    assert (tmp_path / "snapshots/collision_double_1000.csv").exists()
    vtk = (tmp_path / "vtk/collision_double_0.vtk").read_text()
    assert vtk.startswith("# vtk DataFile Version 3.0") and "POINTS 2 double" in vtk
    assert json.loads((tmp_path / "context.json").read_text())["complete"] is True
    report = tmp_path / "report"
    done = subprocess.run(
        [sys.executable, ROOT / "reports/report.py", tmp_path, "--out", report],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert (report / "figures/divergence_collision.pdf").exists()


def test_the_ladder_names_the_double_mass():
    code, out, _ = run("scene", "ladder", "pendulum3", "--types", "mpfr62")
    assert code == 0 and "every constant fills its precision" in out
    code, out, _ = run(
        *["scene", "ladder", "pendulum3", "--types", "mpfr62"],
        *["--set", "mass=yade"],
    )
    assert code == 1 and "4.18879020478639" in out and "16 digits only" in out


def test_an_interrupted_scene_says_so(tmp_path):
    process = subprocess.Popen(
        [ULPGATE, *"scene run collision --steps 100000000000 --out".split(), tmp_path],
        stderr=subprocess.PIPE,
        text=True,
    )
    time.sleep(3)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=120)
    assert process.returncode == 3 and "interrupted" in err
    assert json.loads((tmp_path / "context.json").read_text())["complete"] is False
