"""Tests of planted_bugs: what it plants is there, and what it says of a gate."""

import json
import os
import pathlib
import re
import sys

import pytest

sys.path.insert(0, os.path.dirname(__file__))
import planted_bugs
from planted_bugs import Bug, Failure, Size, Trials, first_finding, planted, read_bugs

ROOT = pathlib.Path(__file__).resolve().parents[2]
TYPES, BUGS = read_bugs()


@pytest.mark.parametrize("bug", BUGS, ids=lambda b: b.name)
def test_every_bug_can_be_planted(bug):
    assert bool(bug.preload) != bool(bug.file)
    assert any(size.found for size in bug.sizes), "a bug that nothing finds"
    if bug.file:
        text = (ROOT / bug.file).read_text()
        assert planted(text, bug) != text
    else:
        function, low, high, ulp = bug.preload.split()
        assert re.search(rf"PLANT\(\w+, {function},", planted_bugs.LIBRARY.read_text())
        assert float.fromhex(low) <= float.fromhex(high) and int(ulp) >= 0


def test_a_place_that_is_gone_is_said():
    bug = Bug("b", "w", "c", [], file="f.hpp", before="a + b", after="b + a")
    assert planted("x = a + b;", bug) == "x = b + a;"
    for text in ("x = 0;", "a + b; a + b;"):
        with pytest.raises(Failure, match="b: f.hpp holds `a [+] b`"):
            planted(text, bug)


def sarif(tmp_path, *rows):
    results = [
        {
            "level": level,
            "message": {"text": f"{row}: worse\ngot: 1"},
            "locations": [{"logicalLocations": [{"fullyQualifiedName": row}]}],
        }
        for level, row in rows
    ]
    file = tmp_path / "gate.sarif"
    file.write_text(json.dumps({"runs": [{"results": results}]}))
    return file


def test_the_first_finding_is_the_worst_that_fails(tmp_path):
    rows = [("warning", "a/x"), ("error", "functions/double/sin"), ("error", "z")]
    found = first_finding(sarif(tmp_path, *rows))
    assert found == ("functions/double/sin", "functions/double/sin: worse", 2)
    assert first_finding(sarif(tmp_path, ("warning", "a/x"))) is None


@pytest.mark.parametrize(
    ("code", "finding", "found", "good", "says"),
    [
        (1, ("f/double/sin", "m", 1), True, True, "red, 1 rows, first f/double/sin"),
        (1, ("f/double/cos", "m", 1), True, False, "NOT sin"),
        (1, ("f/double/sin", "m", 1), False, False, "says that this size misses it"),
        (0, None, False, True, "missed, as is known"),
        (0, None, True, False, "MISSED"),
        (3, None, True, False, "NO VERDICT, exit 3"),
        (1, None, True, False, "NO VERDICT"),
    ],
)
def test_an_outcome_is_held_to_what_is_known(
    monkeypatch, tmp_path, code, finding, found, good, says
):
    monkeypatch.setattr(planted_bugs, "gated", lambda *_: (code, finding))
    said = []
    bug = Bug("b", "w", "sin", [Size(found, ["--parts", "math"])], preload="sin 1 1 0")
    trials = Trials(tmp_path, said.append)
    assert trials.attempt(bug, bug.sizes[0], 0, "p", tmp_path, {}) is good
    assert says in said[0] and "ci/gate --parts math" in said[0]
    assert bug.outcomes[0]["exit"] == code


def test_a_control_is_run_once_a_program_and_size(monkeypatch, tmp_path):
    runs = []
    monkeypatch.setattr(planted_bugs, "gated", lambda *a: runs.append(a) or (0, None))
    trials = Trials(tmp_path, lambda text: None)
    for program in ("p", "p", "q"):
        trials.control(Size(True, ["--parts", "math"]), program, tmp_path)
    assert [r[1] for r in runs] == ["p", "q"]


def test_bad_usage(capsys):
    with pytest.raises(Failure, match="no bug 'cos'") as failure:
        planted_bugs.main(["--bugs", "cos"])
    assert failure.value.code == 2
    with pytest.raises(Failure, match="no program /nowhere"):
        planted_bugs.main(["--bugs", "sin_3_ulp", "--ulpgate", "/nowhere"])
    assert planted_bugs.main(["--list"]) == 0
    assert "sin_3_ulp: 3 ULP" in capsys.readouterr().out
