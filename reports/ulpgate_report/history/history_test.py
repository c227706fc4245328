"""Tests of the report of a history: what the program put into the file stands in tables, figure and page."""
import json
import sqlite3

import pytest
from matplotlib import pyplot

from ulpgate_report.app import cli
from ulpgate_report.history import figure_trends, history_file, kind, tables
from ulpgate_report.records import reading
from ulpgate_report.records.errors import InvalidInput, NothingMeasured
from ulpgate_report.testing import sample_records

# As the program makes it (harness/app/history/history_file.cpp), which its own tests hold to this report.
SCHEMA = """
CREATE TABLE platforms(id INTEGER PRIMARY KEY, facts TEXT);
CREATE TABLE runs(id INTEGER PRIMARY KEY, digest TEXT, commit_id TEXT, time_s INTEGER, platform INTEGER, verb TEXT,
  plan TEXT, version TEXT, noise REAL);
CREATE TABLE series(id INTEGER PRIMARY KEY, kind TEXT, name TEXT, part TEXT, type TEXT, setting TEXT);
CREATE TABLE results(id INTEGER PRIMARY KEY, kind TEXT, figures TEXT, error REAL, argument TEXT, mismatches INTEGER);
CREATE TABLE measurements(run INTEGER, series INTEGER, result INTEGER, implementation INTEGER);
CREATE TABLE times(run INTEGER, series INTEGER, seconds TEXT, baseline_s TEXT);
CREATE TABLE steps(id INTEGER PRIMARY KEY, run INTEGER, before INTEGER, series INTEGER, what TEXT, change TEXT,
  text TEXT, platform TEXT);
"""
HASH = "0123456789abcdef0123456789abcdef0123456"


def make(path, runs=6, steps=True, version=1):
    """Runs of two rows: pow is worse from the third on, exp slower from the fourth, with another C library."""
    with sqlite3.connect(path) as connection:
        connection.executescript(SCHEMA)
        connection.execute(f"PRAGMA application_id = {history_file.APPLICATION}")
        connection.execute(f"PRAGMA user_version = {version}")
        put = connection.execute
        for number, libm in ((1, "2.36"), (2, "2.41")):
            put(
                "INSERT INTO platforms VALUES(?, ?)",
                (number, json.dumps({"glibc": libm})),
            )
        put("INSERT INTO series VALUES(1, 'math', 'pow', 'value', 'double', 'uniform')")
        put("INSERT INTO series VALUES(2, 'time', 'exp', '', 'double', '')")
        for number, error in ((1, 0.52), (2, 1.52), (3, None)):
            put(
                "INSERT INTO results VALUES(?, 'math', '{}', ?, '', 0)", (number, error)
            )
        for i in range(runs):
            row = (i + 1, "", f"{HASH}{i}", 1_700_000_000 + 86_400 * i, 1 + (i >= 3))
            put("INSERT INTO runs VALUES(?, ?, ?, ?, ?, 'math', '', '', 0)", row)
            put(
                "INSERT INTO measurements VALUES(?, 1, ?, 1)",
                (i + 1, 1 + (i >= 2) + (i == 5)),
            )
            times = [
                1e-8 * (1.2 if i >= 3 else 1) * f for f in (1.3, 1, 1.01, 1.02, 1.1)
            ]
            put("INSERT INTO times VALUES(?, 2, ?, '[]')", (i + 1, json.dumps(times)))
        if steps:
            put(
                "INSERT INTO steps VALUES(1, 3, 2, 1, 'accuracy', 'worse', 'max_ulp 0.52 -> 1.52', '')"
            )
            put(
                "INSERT INTO steps VALUES(2, 4, 3, 2, 'speed', 'worse', 'time 10 -> 12 ns', 'glibc 2.36 -> 2.41')"
            )
    connection.close()
    return path


def test_tables_name_commit_and_platform(tmp_path):
    history = history_file.load(make(tmp_path / "h.sqlite"))
    rows = tables.history_steps(history).rows
    assert [row[2] for row in rows] == ["exp double", "pow double, uniform"]
    assert [row[3] for row in rows] == [HASH[:12]] * 2 and rows[0][
        -1
    ] == "glibc 2.36 -> 2.41"
    assert [row[4] for row in rows] == ["2023-11-17", "2023-11-16"]
    runs = tables.history_runs(history).rows
    assert [row[-1] for row in runs] == [None] * 3 + ["glibc 2.36 -> 2.41"] + [None] * 2
    assert tables.short_commit("v1.2-dirty") == "v1.2-dirty"
    assert tables.short_commit(f"{HASH}0-dirty") == f"{HASH[:12]}-dirty"


def test_the_figure_has_a_panel_for_each_row_that_stepped(tmp_path):
    name, caption, figure = figure_trends.draw(history_file.load(make(tmp_path / "h")))
    assert name == "history" and "step" in caption
    times, errors = figure.axes
    assert times.get_title(loc="left") == "exp double"
    line = times.get_lines()[0]
    assert list(line.get_ydata()) == pytest.approx([10.1] * 3 + [12.12] * 3)
    # The error of the last run is no number: it is marked, not drawn.
    assert list(errors.get_lines()[0].get_ydata()) == [0.52] * 2 + [1.52] * 3
    assert list(errors.get_lines()[1].get_xdata()) == [5]
    places = [axes.get_lines()[-1].get_xdata()[0] for axes in (times, errors)]
    assert places == [2.5, 1.5]
    pyplot.close(figure)


def test_nothing_stepped(tmp_path):
    history = history_file.load(make(tmp_path / "h", steps=False))
    assert figure_trends.draw(history)[2] is None
    assert kind.printed(history) == [] and not any(
        alert for _, alert in kind.headline(history)
    )


def test_the_page_has_the_history(tmp_path):
    directory, file, out = (
        tmp_path / "run",
        make(tmp_path / "h.sqlite"),
        tmp_path / "out",
    )
    sample_records.write_sample(directory, ["sin"])
    assert cli.main([str(directory), "--history", str(file), "--out", str(out)]) == 0
    page = (out / "index.html").read_text("utf-8")
    assert (
        'id="history"' in page and "glibc 2.36 -&gt; 2.41" in page and HASH[:12] in page
    )
    assert {p.name for p in out.glob("history_*")} >= {
        "history_steps.csv",
        "history_runs.md",
    }
    assert (out / "figures/history.svg").stat().st_size > 0
    reading.validator("summary").validate(
        json.loads((out / "summary.json").read_text("utf-8"))
    )
    # Without it an older one would pass for this report's.
    assert cli.main([str(directory), "--out", str(out)]) == 0
    assert (
        not list(out.glob("history_*")) and not (out / "figures/history.svg").exists()
    )
    assert 'id="history"' not in (out / "index.html").read_text("utf-8")


def test_what_is_no_history_is_refused(tmp_path):
    text = tmp_path / "text"
    text.write_text("no database" * 100)
    foreign = tmp_path / "foreign"
    sqlite3.connect(foreign).execute("CREATE TABLE t(x)").connection.close()
    newer = make(tmp_path / "newer", version=2)
    for path, words in (
        (text, "not a database"),
        (foreign, "no history"),
        (newer, "newer"),
        (tmp_path / "none", "no file"),
    ):
        with pytest.raises(InvalidInput, match=words):
            history_file.load(path)
    assert not (tmp_path / "none").exists()
    with pytest.raises(NothingMeasured):
        history_file.load(make(tmp_path / "empty", runs=0, steps=False))
