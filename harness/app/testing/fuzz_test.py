"""A few hundred cases of fuzz.py: the night runs thousands."""

import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))

import fuzz

ROOT = pathlib.Path(__file__).resolve().parents[3]
ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))


def test_random_input_keeps_the_contract():
    found = fuzz.fuzz(ULPGATE, {"scenes": 150, "records": 250, "lines": 150})
    assert not found, "\n".join(found)


def test_a_broken_contract_is_noticed(tmp_path):
    crash, pass_all = tmp_path / "crash", tmp_path / "pass"
    crash.write_text("#!/bin/sh\nkill -SEGV $$\n")
    pass_all.write_text("#!/bin/sh\nexit 0\n")
    for program in (crash, pass_all):
        program.chmod(0o755)
    code, fault = fuzz.Program(crash).run([], tmp_path)
    assert code < 0 and "exit code -11" in fault
    f = fuzz.Fuzz(fuzz.Program(pass_all), 1, tmp_path)
    records, budgets = tmp_path / "records", tmp_path / "budgets"
    for directory, name in ((records, "math.jsonl"), (budgets, "float.toml")):
        directory.mkdir()
        (directory / name).write_text('{"max_ulp": 1.5}\n')
    f.samples = {"math": (records, budgets)}
    assert any(
        "passes edited records" in (f.run("records", k) or "") for k in range(20)
    )
