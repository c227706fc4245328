"""Tests of error against run time: records, what is refused, tables, the whole report, hard records."""
import json
import re
import shutil

import pytest

from ulpgate_report.app import cli
from ulpgate_report.records import reading, records, suite
from ulpgate_report.testing import sample_work_precision as sample
from ulpgate_report.testing.changes import edit_line, with_fields, without
from ulpgate_report.testing.page_check import References
from ulpgate_report.testing.table_check import compile_tables, csv_rows, needs_latex
from ulpgate_report.work_precision import kind, tables

TOKENS = ("float", "double", "mpfr62")


def few():
    """(lines, their times, fits) of a problem with five integrators, a scene with one, and a few functions."""
    found = [
        sample.settings("kepler", TOKENS, sample.INTEGRATORS[:5]),
        sample.settings("deposition", TOKENS, sample.INTEGRATORS[1:2], "scene", 0.02),
        sample.subjects("function", ("sin", "fmod"), TOKENS),
    ]
    rows = [row for lines, _ in found for row in lines]
    fits = [sample.fit("kepler", "leapfrog", token) for token in TOKENS]
    return rows, [one for _, times in found for one in times], fits


@pytest.fixture
def run_directory(tmp_path):
    """A small good run."""
    return sample.write(tmp_path / "run", *few())


def test_times_are_those_of_their_settings(run_directory):
    found = records.load(run_directory).work_precision
    rows, times, fits = few()
    assert len(found.rows) == len(rows) and len(found.fits) == len(fits)
    assert found.untold == 0
    timed = [row for row in found.rows if not row["failure"]]
    assert [row["seconds"] for row in timed] == [time["seconds"] for time in times]
    failed = [row for row in found.rows if row["failure"]]
    assert failed and all(row["seconds"] is None for row in failed)
    sample.write(run_directory, rows[5:], times[5:])
    some = records.load(run_directory).work_precision
    assert sum(row["seconds"] is not None for row in some.rows) == len(times[5:])
    sample.write(run_directory, [row for row in rows if row["failure"]], times[5:])
    assert records.load(run_directory).work_precision.untold == len(times[5:])


def test_ends_tell_settings_apart(tmp_path):
    rows = [
        sample.of_run("trajectory", "robertson", "double", "radau3", 10, 1e-9, end=end)
        for end in ("40", "1e11")
    ]
    times = [sample.timing(row, 1.0 + n) for n, row in enumerate(rows)]
    fits = [sample.fit("robertson", "radau3", "double", end="40")]
    found = records.load(sample.write(tmp_path, rows, times, fits)).work_precision
    names = {row["name"]: row["seconds"] for row in found.rows}
    assert names == {"robertson_40": 1.0, "robertson_1e11": 2.0}
    assert found.fits[0]["name"] == "robertson_40"
    assert len(report(tmp_path, tmp_path / "out")) == 2


LINE = "work_precision.jsonl:2"
TIMING, FITS = "work_precision_timing.jsonl", "work_precision_fits.jsonl"


def other_line(name):
    """A change that puts the first line of another file in the place of a line."""
    parts = few()
    place = ("work_precision.jsonl", TIMING, FITS).index(name)
    return lambda _: json.dumps(parts[place][0])


@pytest.mark.parametrize(
    "name, change, named, why",
    [
        (
            "work_precision.jsonl",
            with_fields(planned=False),
            LINE,
            "said of plans alone",
        ),
        ("work_precision.jsonl", with_fields(instants=0), LINE, "the end is one"),
        ("work_precision.jsonl", lambda s: s[:40], LINE, "truncated"),
        ("work_precision.jsonl", without("final_error"), LINE, "field missing"),
        ("work_precision.jsonl", with_fields(subject="poem"), LINE, "no kind"),
        ("work_precision.jsonl", with_fields(failure="luck"), LINE, "no failure"),
        ("work_precision.jsonl", with_fields(largest_error="big"), LINE, "no number"),
        ("work_precision.jsonl", with_fields(what="work"), LINE, "of another kind"),
        (
            "work_precision.jsonl",
            lambda s: s + "\n" + s,
            "work_precision.jsonl:3",
            "twice",
        ),
        ("work_precision.jsonl", other_line(FITS), LINE, "a line of another file"),
        (TIMING, lambda s: s[:40], f"{TIMING}:2", "truncated"),
        (TIMING, other_line("work_precision.jsonl"), f"{TIMING}:2", "likewise"),
        (TIMING, with_fields(seconds="soon"), f"{TIMING}:2", "no number"),
        (TIMING, lambda s: s + "\n" + s, f"{TIMING}:3", "twice"),
        (FITS, with_fields(bad="no"), f"{FITS}:2", "no truth value"),
        (FITS, lambda s: s + "\n" + s, f"{FITS}:3", "twice"),
    ],
)
def test_bad_input_is_refused(run_directory, capsys, name, change, named, why):
    edit_line(run_directory, name, 2, change)
    assert cli.main([str(run_directory), "--print"]) == 2, why
    assert named in capsys.readouterr().err, why


def report(run, out, *options):
    """(names of the figures, what is said) of a report, which must succeed."""
    assert cli.main([str(run), "--out", str(out), *options]) == 0
    text = (out / "summary.json").read_text("utf-8")
    reading.validator("summary").validate(json.loads(text))
    assert cli.main([str(run), "--print"]) == 0
    return {path.name.split(".")[0] for path in (out / "figures").glob("*")}


def test_whole_report(run_directory, tmp_path, capsys):
    out = tmp_path / "out"
    names = report(run_directory, out)
    base = "work_precision"
    assert names == {
        f"{base}_trajectory_kepler",
        f"{base}_scene_deposition",
        f"{base}_function",
        f"{base}_fits_trajectory_kepler",
    }
    assert "report:" not in capsys.readouterr().err
    page = (out / "index.html").read_text("utf-8")
    found = References()
    found.feed(page)
    links = {value[1:] for _, value in found.fetched if value.startswith("#")}
    assert links <= set(found.ids)
    assert (
        sum(re.fullmatch(r"work-precision-\d+", link) is not None for link in links)
        == 6
    )
    assert page.count("<figure") == 4 and 'id="work_precision_fits"' in page
    for make, formats in kind.TABLES:
        for form in formats:
            assert (out / f"{make.__name__}.{form}").stat().st_size > 0
    caption = (out / "figures" / f"{base}_trajectory_kepler.caption.txt").read_text()
    rows = [row for row in few()[0] if row["name"] == "kepler"]
    failed = sum(row["failure"] is not None for row in rows)
    assert f"{failed} of {len(rows)} settings failed" in caption
    asked = report(run_directory, out, "--axes", "dt,energy_error")
    assert asked == {
        f"{base}_trajectory_kepler_dt_energy_error",
        f"{base}_scene_deposition_dt_energy_error",
        f"{base}_fits_trajectory_kepler",
    }
    said = capsys.readouterr().err
    assert "functions: no setting with dt and energy_error" in said


def test_axes_that_are_none_are_refused(run_directory, tmp_path, capsys):
    with pytest.raises(SystemExit) as stop:
        cli.main([str(run_directory), "--out", str(tmp_path), "--axes", "error,price"])
    assert stop.value.code == 2 and "'error,price'" in capsys.readouterr().err


def test_planned_steps_are_read_beside_equal_ones(tmp_path):
    rows = [sample.of_run("trajectory", "kepler", "double", "radau5", 64, 1e-9)]
    plan = {
        "planned": True,
        "dt_text": "plan:1e-6",
        "largest_error": 2e-9,
        "instants": 64,
    }
    rows.append({**rows[0], **plan})
    times = [sample.timing(row, 1.0) for row in rows]
    times[1]["planned"] = True
    fits = [
        sample.fit("kepler", "radau5", "double", **how)
        for how in ({}, {"planned": True})
    ]
    found = records.load(sample.write(tmp_path, rows, times, fits))
    assert len(found.work_precision.rows) == len(found.work_precision.fits) == 2
    every = csv_rows(tables.work_precision_records(kind.of(found)))
    assert [row["integrator"] for row in every] == ["radau5", "radau5, planned"]
    assert (every[1]["tolerance"], every[1]["instants"]) == ("1e-06", "64")
    assert every[1]["command"].endswith("--dt plan:1e-6 --until 10")


ONE = sample.of_run("trajectory", "kepler", "double", "leapfrog", 10, 1e-9)
TIME = sample.timing(ONE, 1e-3)
FAILED = sample.failed(ONE, "diverged", "not finite at step 7")
NO_ERROR = {**ONE, "final_error": None, "largest_error": None}
OTHER = {**ONE, "type": "decimal"}
# What there is, and how many figures it makes.
HARD = {
    "one point": ([ONE], [TIME], 1),
    "no timing": ([ONE], [], 1),
    "all failed": ([FAILED], [], 0),
    "failed but timed": ([FAILED], [TIME], 0),
    "one of two failed": ([ONE, {**FAILED, "steps": 5}], [TIME], 1),
    "one integrator failed": (
        [ONE, {**FAILED, "integrator": "verlet", "dt_text": "0.5"}],
        [TIME],
        1,
    ),
    "exact": ([{**ONE, "final_error": 0}], [TIME], 1),
    "no error": ([NO_ERROR], [TIME], 0),
    "beyond one": ([{**ONE, "final_error": 1e300}], [TIME], 1),
    "refused": ([sample.failed(ONE, "refused", "above the budget")], [], 0),
    "unknown type": ([OTHER], [sample.timing(OTHER, 1e-3)], 1),
}


@pytest.mark.parametrize("name", list(HARD))
def test_hard_records(tmp_path, name):
    rows, times, count = HARD[name]
    run = sample.write(tmp_path / "run", rows, times)
    assert len(report(run, tmp_path / "out")) == count


def test_hard_functions(tmp_path):
    rows = [sample.line("function", "a", "double", 0)]
    rows.append(sample.line("function", "b", "double", None, failure="mismatch"))
    times = [sample.timing(rows[0], 1e-8)]
    run = sample.write(tmp_path / "run", rows, times)
    assert report(run, tmp_path / "out") == {"work_precision_function"}
    run = sample.write(tmp_path / "other", rows)
    assert report(run, tmp_path / "out") == set()


def test_tables(run_directory):
    measured = kind.of(records.load(run_directory))
    rows = csv_rows(tables.work_precision_front(measured))
    assert {row["name"] for row in rows} == {"kepler", "deposition"}
    for row in rows:
        assert float(row["final_error"]) < 10 and float(row["seconds"]) > 0
    kepler = [r for r in rows if (r["name"], r["type"]) == ("kepler", "double")]
    errors = [float(row["final_error"]) for row in kepler]
    assert errors == sorted(errors, reverse=True), "the cheapest first"
    assert {row["best"] for row in rows} == {"yes", "no"}
    for (_, name), of_type in tables.least_errors(measured).items():
        for token, (place, row) in of_type.items():
            line = rows[place]
            assert (line["name"], line["type"]) == (name, token)
            mine = [r for r in rows if (r["name"], r["type"]) == (name, token)]
            assert line["final_error"] == min(
                (r["final_error"] for r in mine), key=float
            )
            assert line["command"].endswith("--until 10")
    types = csv_rows(tables.work_precision_types(measured))
    assert types[1]["worst"] == "sin" and types[1]["command"].endswith("double")
    assert [row["type"] for row in types] == list(TOKENS)
    assert types[1]["slowdown"] == "1.0" and float(types[2]["slowdown"]) > 10
    fits = csv_rows(tables.work_precision_fits(measured))
    assert [row["type"] for row in fits] == list(TOKENS) and fits[0]["drift"] == ""
    every = csv_rows(tables.work_precision_records(measured))
    failed = [row for row in every if row["failure"]]
    assert failed and all(row["why"] and row["final_error"] == "" for row in failed)


def test_settings_of_a_suite(run_directory, tmp_path):
    base = tmp_path / "suite"
    shutil.copytree(run_directory, base / "first")
    alone = records.load(run_directory).work_precision
    assert suite.load(base).work_precision == alone
    shutil.copytree(run_directory, base / "second")
    found = suite.load(base).work_precision
    assert len(found.rows) == 2 * len(alone.rows)
    assert {row["name"] for row in found.fits} == {"kepler_first", "kepler_second"}


@needs_latex
def test_latex_compiles(run_directory, tmp_path):
    measured = kind.of(records.load(run_directory))
    made = [make(measured) for make, formats in kind.TABLES if "tex" in formats]
    assert "Overfull" not in compile_tables(made, tmp_path)
