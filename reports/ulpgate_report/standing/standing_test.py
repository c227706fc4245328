"""Tests of the standing: the verdict stands first, what changed is told by row, and broken files are named."""
import json

import pytest

from ulpgate_report.app import cli
from ulpgate_report.records import records
from ulpgate_report.records.errors import InvalidInput
from ulpgate_report.standing import kind, standing
from ulpgate_report.testing import sample_records

FINDING = {
    "kind": "FAIL",
    "function": "sin",
    "type": "double",
    "message": "max ULP 3.1 above its budget 0.516",
    "stratum": "uniform",
    "what": "max_ulp",
    "measured": 3.1,
    "budget": 0.516,
    "reproduce": "ulpgate at sin double 0x1p0",
}
UNMEASURED = {**FINDING, "kind": "NOT MEASURED", "message": "budgeted but not measured"}
ANOTHER_PLAN = {**FINDING, "kind": "ANOTHER PLAN", "message": "1000 points of seed 1"}
NOTE = {**FINDING, "kind": "note", "message": "could be 0.4"}


def _gate(*findings, exit_code=None):
    """What the gate prints."""
    failed = any(one["kind"] != "note" for one in findings)
    remarks = ["no context"] if exit_code else []
    return {
        "exit_code": int(failed) if exit_code is None else exit_code,
        "verdict": "in words",
        "sets": [{"records": "now", "remarks": remarks}],
        "findings": list(findings),
    }


def _loaded(tmp_path, *findings, exit_code=None):
    file = tmp_path / "gate.json"
    file.write_text(json.dumps(_gate(*findings, exit_code=exit_code)))
    return standing.load_gate(file)


def _write(place, change=None):
    context = sample_records.context(["sin", "ctan"])
    rows = sample_records.math_records(context)
    if change is not None:
        change(rows)
    return sample_records.write(place, context, rows, [])


def _worse(rows):
    """One record's largest error doubled, and in another a result of the wrong kind less."""
    rows[0]["max_ulp"] *= 2


def _standing(tmp_path, gate=None, change=None):
    now = records.load(_write(tmp_path / "now", change))
    before = records.load(_write(tmp_path / "before"))
    now = records.Run(**{**vars(now), "gate": gate, "before": before})
    return kind.of(now)


def test_nothing_is_said_where_nothing_was_asked(tmp_path):
    assert kind.of(records.load(_write(tmp_path / "run"))) is None


@pytest.mark.parametrize(
    "gate, first, alert",
    [
        ((), "PASSED: all", False),
        ((NOTE,), "PASSED: all", False),
        ((FINDING, NOTE), "FAILED: 1 finding (fail 1).", True),
        ((FINDING, UNMEASURED), "FAILED: 2 findings (fail 1, not measured 1).", True),
        (
            (UNMEASURED, UNMEASURED),
            "NOT PASSED: nothing that was judged failed, and 2 rows could not be judged (not measured 2).",
            True,
        ),
        (
            (ANOTHER_PLAN,),
            "NOT PASSED: nothing that was judged failed, and 1 row could not be judged (another plan 1).",
            True,
        ),
        (None, "Not held to budgets.", False),
    ],
    ids=[
        "clean",
        "a limit that could be lower",
        "a failure",
        "a failure and a row without records",
        "rows without records",
        "another plan",
        "no gate",
    ],
)
def test_the_verdict_stands_first(tmp_path, gate, first, alert):
    loaded = None if gate is None else _loaded(tmp_path, *gate)
    said = kind.headline(_standing(tmp_path, loaded))
    assert said[0][0].startswith(first) and said[0][1] == alert


def test_a_gate_that_judged_nothing_has_not_passed(tmp_path):
    said = kind.headline(_standing(tmp_path, _loaded(tmp_path, exit_code=3)))
    assert said[0] == ("NOT PASSED: nothing failed, and there is no verdict.", True)
    assert said[1] == ("no context", False)


def test_the_same_run_has_changed_nothing(tmp_path):
    found = _standing(tmp_path)
    assert found.changes == []
    assert ("no row", False) in kind.headline(found)


def test_a_row_that_is_worse_is_named_with_both_errors(tmp_path):
    found = _standing(tmp_path, None, _worse)
    (change,) = found.changes
    assert change.change == standing.WORSE
    assert change.after > change.before
    assert change.command.startswith("ulpgate at ")
    assert ("1 worse", True) in kind.headline(found)


def test_rows_that_came_and_went(tmp_path):
    def drop(rows):
        rows[:] = [r for r in rows if (r["function"], r["type"]) != ("sin", "double")]

    found = _standing(tmp_path, None, drop)
    assert [(c.label, c.type, c.change) for c in found.changes] == [
        ("sin", "double", standing.GONE)
    ]
    now = records.load(_write(tmp_path / "all"))
    before = records.load(_write(tmp_path / "less", drop))
    came = standing.of(records.Run(**{**vars(now), "before": before}))
    assert [(c.label, c.type, c.change) for c in came.changes] == [
        ("sin", "double", standing.NEW)
    ]


def test_a_row_of_which_nothing_is_judged_any_more_is_worse():
    assert standing._change((0.5, 0, ()), (None, 0, ())) == standing.WORSE
    assert standing._change((None, 0, ()), (0.5, 0, ())) == standing.WORSE
    assert standing._change((0.5, 2, ()), (0.9, 1, ())) == standing.BETTER


def test_an_incomplete_run_has_not_passed():
    passed = standing.Gate(0, "passes", [])
    said = kind.headline(standing.Standing(passed, None, 3, {}, 0, False))
    assert said[0][0].startswith("NOT PASSED") and said[0][1]


@pytest.mark.parametrize(
    "content",
    ["{", "{}", "[]", json.dumps(_gate({"kind": 1})), None],
    ids=["torn", "object", "list", "kind", "none"],
)
def test_a_file_that_is_none_of_the_gate_is_named(tmp_path, content):
    file = tmp_path / "gate.json"
    if content is not None:
        file.write_text(content)
    with pytest.raises(InvalidInput, match="gate.json"):
        standing.load_gate(file)


def test_the_page_answers_first(tmp_path):
    now, before = _write(tmp_path / "now", _worse), _write(tmp_path / "before")
    (tmp_path / "gate.json").write_text(json.dumps(_gate(FINDING)))
    words = ["--gate", str(tmp_path / "gate.json"), "--before", str(before)]
    assert cli.main([str(now), *words, "--out", str(tmp_path / "out")]) == 0
    page = (tmp_path / "out" / "index.html").read_text("utf-8")
    body = page[page.index("<h1>") :]
    first = body.index("FAILED: 1 finding")
    assert (
        first
        < body.index("Changed since the earlier run:")
        < body.index("functions in")
    )
    assert 'id="gate_findings"' in page and 'id="changed_rows"' in page
    assert (tmp_path / "out" / "changed_rows.csv").exists()
