"""One wrong float of 2^32 turns the gate over all floats red."""

import os
import pathlib
import subprocess

import narrow_bugs

ROOT = pathlib.Path(__file__).resolve().parents[3]
ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))
BUDGETS = ROOT / "ci/budgets/exhaustive"


def run(*words, env=None):
    done = subprocess.run(
        [ULPGATE, *[str(w) for w in words]],
        capture_output=True,
        text=True,
        cwd=ROOT,
        env=env,
    )
    return done.returncode, done.stdout, done.stderr


def test_a16_one_wrong_float_turns_the_gate_red(tmp_path):
    # 1 ULP at one float: less than the largest error of many a function at another.
    library = narrow_bugs.build(tmp_path)
    env = narrow_bugs.environment(library, "log2f 2.5 2.5 1")
    words = "--functions log2 --types float --strata exhaustive --timing off".split()
    code, _, err = run("math", *words, "--out", tmp_path / "o", env=env)
    assert code == 0, err
    gate = ["gate", tmp_path / "o", "--budgets", BUDGETS, "--only-measured"]
    code, out, err = run(*gate)
    assert code == 1, out + err
    assert "log2" in out and "exhaustive" in out
