"""Tests of what the gate accepts of rows of scenes and correlations: nothing that the run did not write."""

import pathlib
import shutil
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from edited_records import edit, put, run, without  # noqa: E402


@pytest.fixture(scope="module")
def scenes(tmp_path_factory):
    """A correlated pendulum and its budgets."""
    there = tmp_path_factory.mktemp("scenes")
    words = ["scene", "correlate", "pendulum3", "--types", "float", "--steps", "20000"]
    code, _, err = run(*words, "--reference", "double", "--out", there / "run")
    assert code == 0, err
    budgets = ["--budgets", there / "budgets", "--update"]
    assert run("gate", there / "run", *budgets)[0] == 0
    return there


@pytest.mark.parametrize(
    "file,change,named",
    [
        ("correlation.jsonl", without("against"), "correlation.jsonl:1: 'against'"),
        ("correlation.jsonl", put(t_s=-1), "correlation.jsonl:1: 't_s'"),
        ("correlation.jsonl", put(to_the_end=False), "correlation.jsonl:1:"),
        ("scenes.jsonl", put(scene=7), "scenes.jsonl:1: 'scene'"),
        ("scenes.jsonl", put(scene="../../evil"), "scenes.jsonl:1: 'scene'"),
        ("scenes.jsonl", put(steps="many"), "scenes.jsonl:1: 'steps'"),
        ("scenes.jsonl", put(energy=[]), "scenes.jsonl:1: 'energy'"),
        ("scenes.jsonl", put(max_energy_error=-1), "scenes.jsonl:1:"),
        ("scenes.jsonl", put(mood=1), "scenes.jsonl:1: unknown key 'mood'"),
        ("scenes.jsonl", put(plan="0123456789abcdef"), "scenes.jsonl:1: plan"),
    ],
)
def test_b7_and_c_rows_of_scenes(scenes, tmp_path, file, change, named):
    directory = shutil.copytree(scenes / "run", tmp_path / "run")
    gate = ["gate", directory, "--budgets", scenes / "budgets"]
    code, _, err = run(*gate)
    assert code == 0, err
    edit(directory, file, 0, change)
    code, _, err = run(*gate)
    assert code == 2 and named in err, err
