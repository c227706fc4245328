"""Tests of several libraries side by side, through the program: names, gaps, times, and what is refused."""
import csv
import json

import pytest

from ulpgate_report.app import cli
from ulpgate_report.libraries import beside
from ulpgate_report.testing import sample_records

TYPES = sample_records.TYPES[:2]
TIMES = {"sin": 10.0, "exp": 20.0}


def write_run(directory, names, library, factor=1.0, timed=True):
    """A synthetic run whose functions are of `library`."""
    context = sample_records.context(names, TYPES)
    lines = sample_records.math_records(context, TYPES)
    for line in lines:
        line["implementation"] = f"{library} {line['function']}"
        if isinstance(line["max_ulp"], float):
            line["max_ulp"] *= factor
    sample_records.write(directory, context, lines)
    if timed:
        rows = [
            {
                "what": name,
                "type": row[0],
                "ns_per_eval": TIMES[name] * factor,
                "repeats": 7,
                "batch": 512,
            }
            for name in names
            for row in TYPES
        ]
        text = "".join(json.dumps(row) + "\n" for row in rows)
        (directory / "timing.jsonl").write_text(text)


@pytest.mark.parametrize(
    "names, expected, why",
    [
        (
            ["libsleef.so.3.5.1 Sleef_sin_u10", "libsleef.so.3.5.1 Sleef_exp_u10"],
            "libsleef.so.3.5.1",
            "a symbol each",
        ),
        (
            ["musl 1.2.3 sin", "musl 1.2.3 sinh"],
            "musl 1.2.3",
            "one symbol begins another",
        ),
        (["libmvec.so.1 _ZGVdN4v_sin"], "libmvec.so.1", "one function alone"),
        (["glibc 2.36", "glibc 2.36", "processor"], "glibc 2.36", "what most have"),
    ],
)
def test_a_library_is_named_by_its_records(names, expected, why):
    found = beside.library_of([{"implementation": name} for name in names])
    assert found == expected, why


@pytest.fixture
def two(tmp_path):
    write_run(tmp_path / "a", ["sin", "exp"], "liba.so.1")
    write_run(tmp_path / "b", ["sin"], "libb.so.2", factor=2.0)
    return tmp_path / "a", tmp_path / "b"


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def test_functions_stand_side_by_side(two, tmp_path):
    assert (
        cli.main([str(two[0]), f"mine={two[1]}", "--out", str(tmp_path / "out")]) == 0
    )
    rows = {
        (r["function"], r["type"]): r for r in rows_of(tmp_path / "out/library_ulp.csv")
    }
    assert rows.keys() == {(f, t[0]) for f in ("sin", "exp") for t in TYPES}
    sine = rows["sin", "double"]
    assert float(sine["mine"]) == pytest.approx(2 * float(sine["liba.so.1"]))
    assert rows["exp", "float"]["mine"] == ""
    times = {
        (r["function"], r["type"]): r
        for r in rows_of(tmp_path / "out/library_time.csv")
    }
    assert (times["sin", "double"]["liba.so.1"], times["sin", "double"]["mine"]) == (
        "10.0",
        "20.0",
    )
    assert (tmp_path / "out/figures/libraries.pdf").stat().st_size > 1000
    page = (tmp_path / "out/index.html").read_text()
    assert "Libraries side by side" in page and "libb" not in page
    # The same input gives the same bytes.
    before = {
        p.name: p.read_bytes() for p in (tmp_path / "out").rglob("*") if p.is_file()
    }
    assert (
        cli.main([str(two[0]), f"mine={two[1]}", "--out", str(tmp_path / "out")]) == 0
    )
    assert before == {
        p.name: p.read_bytes() for p in (tmp_path / "out").rglob("*") if p.is_file()
    }


def test_libraries_of_one_name_are_told_apart(two, capsys):
    assert cli.main([str(two[0]), str(two[0]), "--print"]) == 0
    shown = capsys.readouterr().out
    assert "liba.so.1 (1)" in shown and "liba.so.1 (2)" in shown


def test_runs_without_times_have_no_figure(tmp_path):
    for name in ("a", "b"):
        write_run(tmp_path / name, ["sin"], f"lib{name}.so", timed=False)
    assert (
        cli.main(
            [str(tmp_path / "a"), str(tmp_path / "b"), "--out", str(tmp_path / "out")]
        )
        == 0
    )
    assert not list((tmp_path / "out").rglob("libraries.pdf"))
    assert "Nothing was timed" in (tmp_path / "out/index.html").read_text()


def test_what_has_no_functions_is_refused(two, tmp_path, capsys):
    assert cli.main([str(two[0]), str(tmp_path / "none"), "--print"]) == 2
    assert "none" in capsys.readouterr().err
