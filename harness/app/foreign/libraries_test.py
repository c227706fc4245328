"""Tests of scripts/libraries and its lists: what they name is there, and libraries stand side by side."""

import csv
import json
import os
import pathlib
import re
import subprocess
import sys

import pytest

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "testing"))

from program import ROOT, ULPGATE, run  # noqa: E402


def records(out):
    lines = (out / "math.jsonl").read_text().splitlines()
    return [json.loads(line) for line in lines]


LISTS = sorted((ROOT / "ci/libraries").glob("*.toml"))


@pytest.mark.parametrize("file", LISTS, ids=[f.stem for f in LISTS])
def test_the_lists_of_libraries_name_what_there_is(tmp_path, file):
    out = tmp_path / "run"
    words = ["math", "--samples", "60", "--timing", "off", "--types", "double,float"]
    code, _, err = run(*words, "--implementations", file, "--out", out)
    if "cannot be loaded" in err or code == 3:
        pytest.skip(err.strip())
    # Results that are wrong are the libraries' own.
    assert code in (0, 1), err
    assert "this program's own is measured" not in err
    named = re.findall(r'"([a-z0-9]+)"', file.read_text())
    measured_ones = {(row["function"], row["type"]) for row in records(out)}
    assert {f for f, _ in measured_ones} == set(named) - {"double", "float"}
    assert len(measured_ones) == 2 * len({f for f, _ in measured_ones})


def test_libraries_side_by_side(tmp_path):
    words = ["--samples", "60", "--functions", "exp,hypot", "--timing", "off"]
    done = subprocess.run(
        [ROOT / "scripts/libraries", tmp_path / "out", *words],
        capture_output=True,
        text=True,
        env=os.environ | {"ULPGATE": ULPGATE},
    )
    if done.returncode == 3:
        pytest.skip(done.stderr)
    assert done.returncode == 0, done.stderr
    with (tmp_path / "out/report/library_ulp.csv").open() as table:
        rows = list(csv.DictReader(table))
    assert {(r["function"], r["type"]) for r in rows} == {
        (f, t) for f in ("exp", "hypot") for t in ("double", "float")
    }
    assert "glibc" in rows[0] and len(rows[0]) > 3
    assert (tmp_path / "out/report/index.html").exists()
    # A wrong option is bad input to each of them.
    done = subprocess.run(
        [ROOT / "scripts/libraries", tmp_path / "bad", "--samples", "none"],
        capture_output=True,
        text=True,
        env=os.environ | {"ULPGATE": ULPGATE},
    )
    assert done.returncode == 3 and "--samples" in done.stderr


def test_a_run_that_was_stopped_is_not_reported_as_all(tmp_path):
    # Stands for a program that is interrupted in its second run: what it wrote before is there.
    program = tmp_path / "ulpgate"
    program.write_text(
        """#!/bin/sh
while [ "$1" != --out ]; do shift; done
mkdir -p "$2" && touch "$2/context.json"
echo "$2" >>"$(dirname "$0")/runs"
[ "$(wc -l <"$(dirname "$0")/runs")" -lt 2 ] || exit 3
"""
    )
    program.chmod(0o755)
    done = subprocess.run(
        [ROOT / "scripts/libraries", tmp_path / "out"],
        capture_output=True,
        text=True,
        env=os.environ | {"ULPGATE": str(program)},
    )
    # Of lists: musl has none where it is not installed, and that is said.
    assert done.returncode == 3 and ".toml is left out" not in done.stderr
    assert len((tmp_path / "runs").read_text().splitlines()) == 2
    assert not (tmp_path / "out/report").exists()
