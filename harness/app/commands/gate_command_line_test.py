"""The gate through the program: other plans, updates, files of budgets, records of scenes."""

import json
import os
import pathlib
import shutil
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))


def run(*words):
    done = subprocess.run([ULPGATE, *map(str, words)], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def measure(out, samples=400, seed=1, strata="uniform,stratified,edges,hard"):
    code, _, err = run(
        *("math", "--types", "double", "--functions", "sin,exp", "--timing", "off"),
        *("--samples", samples, "--seed", seed, "--strata", strata, "--out", out),
    )
    assert code == 0, err
    return out


@pytest.fixture(scope="module")
def measured(tmp_path_factory):
    """A run, its budgets with bounds, and a run of another seed."""
    place = tmp_path_factory.mktemp("gate")
    seeds = [measure(place / f"seed{s}", seed=s) for s in (11, 12, 13, 14)]
    whole = measure(place / "whole")
    words = ["gate", whole, "--budgets", place / "budgets", "--update", "--seeds"]
    code, _, err = run(*words, ",".join(map(str, seeds)))
    assert code == 0, err
    return place


def gate(place, records, *words):
    return run("gate", records, "--budgets", place / "budgets", *words)


def test_a12_another_seed_or_size_needs_a_word_and_enough_samples(measured, tmp_path):
    other = measure(tmp_path / "other", seed=7)
    code, out, _ = gate(measured, other)
    assert code == 2 and "ANOTHER PLAN" in out
    code, out, err = gate(measured, other, "--other-plan")
    assert code == 0, out + err
    few = measure(tmp_path / "few", samples=2, seed=7)
    assert gate(measured, few)[0] == 2
    code, out, _ = gate(measured, few, "--other-plan")
    assert code == 3 and "too few" in out
    assert gate(measured, few, "--other-plan", "--least-samples", 1)[0] == 0


def test_a4_another_plan_does_not_replace_budgets(measured, tmp_path):
    before = (measured / "budgets/double.toml").read_bytes()
    for words in ({"samples": 2, "strata": "edges"}, {"seed": 2}):
        out = measure(tmp_path / f"{len(words)}", **words)
        code, _, err = gate(measured, out, "--update", "--reason", "no")
        assert code == 2 and "with seed" in err
    alone = measure(tmp_path / "alone", strata="uniform")
    code, _, err = gate(measured, alone, "--update")
    assert code == 2 and "points" in err
    assert (measured / "budgets/double.toml").read_bytes() == before


@pytest.mark.parametrize(
    "plan", ["", "[plan]\nseed = 1\n", "[plan]\nsamples = 0\nseed = 1\n"]
)
def test_a4_budgets_without_a_plan_are_refused(measured, tmp_path, plan):
    text = (measured / "budgets/double.toml").read_text()
    (tmp_path / "double.toml").write_text(plan + text[text.index('[budget."exp"]') :])
    for words in ([], ["--update"]):
        code, _, err = run("gate", measured / "whole", "--budgets", tmp_path, *words)
        assert code == 2 and "[plan]" in err


def test_a5_no_limit_is_infinite():
    for file in (ROOT / "ci/budgets").glob("*.toml"):
        assert "= inf" not in file.read_text(), file


def test_a5_an_infinite_limit_is_refused(measured, tmp_path):
    text = (measured / "budgets/double.toml").read_text()
    (tmp_path / "double.toml").write_text(
        text.replace("max_ulp = { edges = ", "max_ulp = { edges = inf #", 1)
    )
    code, _, err = run("gate", measured / "whole", "--budgets", tmp_path)
    assert code == 2 and "double.toml:" in err


def test_b4_what_is_written_can_be_read(measured, tmp_path):
    shutil.copytree(measured / "budgets", tmp_path / "budgets")
    file = tmp_path / "budgets/double.toml"
    tight = file.read_text().replace(
        "max_ulp = { edges = 0.5", "max_ulp = { edges = 0.1"
    )
    file.write_text(tight)
    words = ["gate", measured / "whole", "--budgets", tmp_path / "budgets"]
    code, out, _ = run(*words, "--update")
    assert code == 1 and "WOULD LOOSEN" in out and file.read_text() == tight
    done = subprocess.run(
        [*map(str, [ULPGATE, *words, "--update", "--reason"]), b"\xff\xfe"],
        capture_output=True,
    )
    assert done.returncode == 2 and file.read_text() == tight
    code, out, err = run(
        *words, "--update", "--reason", 'tab\t bell\x07 "q" \\ line\n é'
    )
    assert code == 0 and "loosened" in out, err
    code, out, err = run(*words)
    assert code == 0, out + err


def test_c_reason_without_update_and_a_missing_directory_are_exit_2(measured, tmp_path):
    assert gate(measured, measured / "whole", "--reason", "x")[0] == 2
    for records in (measured / "whole", scene_run(tmp_path / "scene")):
        code, _, err = run("gate", records, "--budgets", tmp_path / "none")
        assert code == 2 and "no such directory" in err


def scene_run(out, *words):
    code, _, err = run(
        *("scene", "run", "pendulum3", "--types", "double", "--steps", 50),
        *("--series", "--out", out, *words),
    )
    assert code == 0, err
    return out


def change_rows(directory, change):
    """Edits the rows of scenes.jsonl and drops the checksums that would tell."""
    rows = [
        json.loads(line)
        for line in (directory / "scenes.jsonl").read_text().splitlines()
    ]
    for row in rows:
        change(row)
    text = "".join(json.dumps(row) + "\n" for row in rows)
    (directory / "scenes.jsonl").write_text(text)


def test_a7_the_integrator_is_part_of_the_run(tmp_path):
    budgets = tmp_path / "budgets"
    run("gate", scene_run(tmp_path / "a"), "--budgets", budgets, "--update")
    assert run("gate", tmp_path / "a", "--budgets", budgets)[0] == 0
    other = scene_run(tmp_path / "b", "--integrator", "velocity_verlet")
    code, out, _ = run("gate", other, "--budgets", budgets)
    assert code == 3 and "NO BUDGET" in out


def test_a7_scenes_of_no_whole_run_are_refused(tmp_path):
    budgets = tmp_path / "budgets"
    good = scene_run(tmp_path / "good")
    assert run("gate", good, "--budgets", budgets, "--update")[0] == 0

    def code_of(change):
        shutil.rmtree(tmp_path / "x", ignore_errors=True)
        shutil.copytree(good, tmp_path / "x")
        change(tmp_path / "x")
        return run("gate", tmp_path / "x", "--budgets", budgets)[0]

    def incomplete(directory):
        file = directory / "context.json"
        file.write_text(
            file.read_text().replace('"complete": true', '"complete": false')
        )

    assert code_of(lambda d: None) == 0
    assert code_of(lambda d: (d / "context.json").unlink()) in (2, 3, 4)
    assert code_of(incomplete) in (2, 3)
    assert code_of(lambda d: change_rows(d, lambda r: r.update(plan="0" * 16))) == 2
    assert (
        code_of(lambda d: change_rows(d, lambda r: r.update(max_energy_error=-1))) == 2
    )
    assert (
        code_of(lambda d: change_rows(d, lambda r: r.update(max_energy_error=None)))
        != 0
    )
    file = budgets / "pendulum3.toml"
    text = file.read_text()
    file.write_text(text[: text.index("max_energy")])
    code, _, err = run("gate", good, "--budgets", budgets)
    assert code == 2 and "limits nothing" in err


def test_a14_names_of_scenes_stay_inside_the_directory(tmp_path):
    good = scene_run(tmp_path / "good")
    for name in ("../evil", str(tmp_path / "evil"), ".hidden", "a/b", ""):
        change_rows(good, lambda row: row.update(scene=name))
        assert (
            run("gate", good, "--budgets", tmp_path / "in/budgets", "--update")[0] == 2
        )
    assert not list(tmp_path.rglob("*.toml"))
