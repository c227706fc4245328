"""Tests of a directory that was changed since its run: refused by checksum, by counts, by rows that are not there."""
import json

import pytest

from ulpgate_report.app import cli
from ulpgate_report.records import checksums
from ulpgate_report.testing import sample_records
from ulpgate_report.testing.changes import edit_line, with_fields


@pytest.fixture
def sealed_run(tmp_path):
    """A small good run with what was planned and the checksums of both files."""
    directory = sample_records.write_sample(tmp_path / "run", ["sin", "ctan"])
    path = directory / "context.json"
    context = json.loads(path.read_text("utf-8"))
    points = {"uniform": 1000}
    context["planned"] = {"double": {"sin": points, "ctan": points}}
    text = (directory / "math.jsonl").read_text("utf-8")
    context["records_checksum"] = {"math.jsonl": checksums.fnv1a(text)}
    path.write_text(checksums.sealed(json.dumps(context, indent=2)), "utf-8")
    return directory


def refused(directory, capsys, code):
    """What is said of a directory that is refused."""
    assert cli.main([str(directory), "--print"]) == code
    return capsys.readouterr().err


def test_the_checksum_is_fnv1a():
    assert checksums.fnv1a("") == "cbf29ce484222325"
    assert checksums.fnv1a("a") == "af63dc4c8601ec8c"


def test_a11_what_the_run_wrote_is_reported(sealed_run):
    assert cli.main([str(sealed_run), "--print"]) == 0


def test_a11_an_edited_record_is_refused(sealed_run, capsys):
    edit_line(sealed_run, "math.jsonl", 1, with_fields(got="0x1.8p+0"))
    assert "math.jsonl: not as the run wrote it" in refused(sealed_run, capsys, 2)


def test_a11_an_edited_context_is_refused(sealed_run, capsys):
    path = sealed_run / "context.json"
    path.write_text(path.read_text().replace('"seed": 42', '"seed": 43'), "utf-8")
    assert "context.json: not as the run wrote it" in refused(sealed_run, capsys, 2)


def test_a11_a_planned_row_that_is_not_there_is_named(sealed_run, capsys):
    path = sealed_run / "math.jsonl"
    lines = path.read_text("utf-8").splitlines()
    gone = [
        s for s in lines if all(f'"{w}"' in s for w in ("sin", "double", "uniform"))
    ]
    path.write_text("".join(s + "\n" for s in lines if s not in gone), "utf-8")
    error = refused(sealed_run, capsys, 3)
    assert "sin value double uniform: 0 of 1000 samples" in error


@pytest.mark.parametrize(
    "fields",
    [
        {"samples": 999},
        {"planned": 10},
        {"correctly_rounded": 10**6},
        {"histogram": {"exact": 1, "buckets": []}},
        {"max_ulp": None},
    ],
)
def test_a11_counts_that_do_not_add_up_are_refused(sealed_run, capsys, fields):
    edit_line(sealed_run, "math.jsonl", 2, with_fields(**fields))
    error = refused(sealed_run, capsys, 2)
    assert "math.jsonl:2: " in error and "do not add up" in error
