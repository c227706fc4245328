"""Tests of how numbers, names and empty values on the command line are read.

The rows in the names are those of harness/FAULTS.md."""

import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))

MATH = ["math", "--functions", "sqrt", "--types", "float", "--strata", "edges"]
MATH += ["--timing", "off"]


def run(*words):
    done = subprocess.run(
        [ULPGATE, *words], capture_output=True, text=True, cwd=ROOT, timeout=20
    )
    return done.returncode, done.stderr


NO_NUMBERS = [
    ("--seed", "-5", "no whole number"),
    ("--seed", "99999999999999999999", "more than 64 bits"),
    ("--seed", "18446744073709551616", "more than 64 bits"),
    ("--seed", "1.5", "no whole number"),
    ("--seed", "0x10", "no whole number"),
    ("--seed", "+1", "no whole number"),
    ("--seed", " 1", "no whole number"),
    ("--samples", "010", "begins with a zero"),
    ("--samples", "1e3", "--samples"),
    ("--threads", "08", "--threads"),
]


@pytest.mark.parametrize("option, value, words", NO_NUMBERS)
def test_c_numbers_are_decimal_and_fit(tmp_path, option, value, words):
    code, err = run(*MATH, option, value, "--out", str(tmp_path / "out"))
    assert code == 2 and option in err and words in err
    assert not (tmp_path / "out").exists()


def test_c_the_largest_seed_is_one(tmp_path):
    for seed in ("0", "18446744073709551615"):
        assert run(*MATH, "--seed", seed, "--out", str(tmp_path / seed))[0] == 0


EMPTY = [
    [*MATH, "--out", ""],
    [*MATH, "--out", "x", "--seed", ""],
    [*MATH, "--out", "x", "--shard", ""],
    ["math", "--functions", "", "--out", "x"],
    ["kernels", "--kernels", "", "--out", "x"],
    ["kernels", "--strata", "", "--out", "x"],
    ["gate", "", "--budgets", "ci/budgets"],
    ["merge", "", "--out", "x"],
    ["scene", "run", "collision", "--dt", ""],
    ["scene", "run", "collision", "--until", ""],
    ["search", "sin", "double", "--out", ""],
]


@pytest.mark.parametrize("words", EMPTY, ids=" ".join)
def test_a3_c_an_empty_value_is_none(words):
    code, err = run(*words)
    assert code == 2 and err.strip()


@pytest.mark.parametrize("option", ["--kernels", "--types", "--strata"])
def test_a3_a_list_of_nothing_is_refused(tmp_path, option):
    code, err = run("kernels", option, ",", "--out", str(tmp_path / "out"))
    assert code == 2 and option in err
    assert not (tmp_path / "out").exists()


NOT_FINITE = [
    ["search", "sin", "double", "--seconds", "nan"],
    ["search", "sin", "double", "--seconds", "inf"],
    ["integrators", "--tolerance", "nan"],
    ["integrators", "--tolerance", "inf"],
    ["scene", "run", "collision", "--out", "x", "--checkpoint-seconds", "nan"],
    ["scene", "run", "collision", "--steps", "-1"],
    ["scene", "run", "collision", "--steps", "18446744073709551616"],
]


@pytest.mark.parametrize("words", NOT_FINITE, ids=" ".join)
def test_b5_no_wait_for_what_is_no_number(words):
    code, err = run(*words)
    assert code == 2 and words[-2] in err
