"""Tests of the program: exit codes, output that cannot be written, packages that are missing."""
import subprocess
import sys
from pathlib import Path

import pytest

from ulpgate_report.app import cli, interpreter
from ulpgate_report.records import errors
from ulpgate_report.testing import sample_records

REPORT = Path(__file__).resolve().parents[2] / "report.py"


@pytest.fixture
def run_directory(tmp_path):
    """A small good run."""
    return sample_records.write_sample(tmp_path / "run", ["sin"])


def test_unwritable_output(run_directory, tmp_path):
    (tmp_path / "file").write_text("")
    assert cli.main([str(run_directory), "--out", str(tmp_path / "file" / "out")]) == 4


def _start(*arguments, **how):
    command = [sys.executable, str(REPORT), *map(str, arguments)]
    return subprocess.run(command, stderr=subprocess.PIPE, text=True, **how)


def test_program_exit_codes(run_directory, tmp_path):
    assert _start(run_directory).returncode == 2, "neither --out nor --print"
    missing = _start(tmp_path / "none", "--print")
    assert missing.returncode == 2 and "none" in missing.stderr
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = _start(run_directory, "--print", stdout=full)
    assert done.returncode == 4, done.stderr
    assert done.stderr.startswith("report: cannot print")


def test_missing_package_is_named():
    found = interpreter.missing_packages(["json", "no_such_package"])
    assert found == ["no_such_package"]
    assert "python3-jinja2" in interpreter.missing_message(["jinja2"])


def test_missing_package_exits_4(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(interpreter, "missing_packages", lambda: ["jsonschema"])
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(SystemExit) as stop:
        interpreter.ensure_packages()
    assert stop.value.code == errors.OutputFailure.exit_code
    assert "python3-jsonschema" in capsys.readouterr().err
