"""Tests of the report of stiff and extreme cases: records, tables, links of the page, figures."""
import json
import re
import shutil

import pytest
from matplotlib import pyplot

from ulpgate_report.app import cli
from ulpgate_report.records import reading, records, stress_records, suite
from ulpgate_report.records.errors import NothingMeasured
from ulpgate_report.stability import figure_matrix, kind, tables, verdicts
from ulpgate_report.testing import sample_stress
from ulpgate_report.testing.changes import edit_line, with_fields, without
from ulpgate_report.testing.page_check import References
from ulpgate_report.testing.sample_records import TYPES
from ulpgate_report.testing.table_check import compile_tables, csv_rows, needs_latex

FEW = (TYPES[0], TYPES[1], TYPES[4])


@pytest.fixture
def run_directory(tmp_path):
    """A small good run."""
    return sample_stress.write(tmp_path / "run", sample_stress.lines(FEW))


def stress_of(*rows):
    """Lines as a report has them."""
    return stress_records.made_of(rows)


def one(token="double", **changes):
    """A line of one case."""
    bits = {row[0]: row[-1] for row in TYPES}[token]
    return sample_stress.line("formula", "sum", "naive", token, bits, **changes)


def test_lines_come_in_display_order(run_directory):
    path = run_directory / "stress.jsonl"
    good = records.load(run_directory).stress
    path.write_text("\n".join(reversed(path.read_text().splitlines())) + "\n\n")
    assert records.load(run_directory).stress == good
    assert good.kinds == list(stress_records.KINDS)
    assert good.type_tokens == ["float", "double", "mpfr62"]
    names = ["spring_1e2", "spring_1e10", "spring_1e4"]
    sorted_names = [r["case"] for r in stress_of(*(one(case=n) for n in names)).rows]
    assert sorted_names == ["spring_1e2", "spring_1e4", "spring_1e10"], "by number"


LINE = "stress.jsonl:2"


@pytest.mark.parametrize(
    "change, named, why",
    [
        (lambda s: s[:40], LINE, "truncated"),
        (lambda s: s.replace("{", '{"error": NaN, ', 1), LINE, "NaN is no JSON"),
        (without("condition"), LINE, "field missing"),
        (with_fields(odd=1), LINE, "unknown field"),
        (with_fields(kind="poem"), f"{LINE}: kind", "no kind"),
        (with_fields(verdict="good"), f"{LINE}: verdict", "no verdict"),
        (with_fields(expected=""), f"{LINE}: expected", "no verdict"),
        (with_fields(as_known="yes"), f"{LINE}: as_known", "no truth value"),
        (with_fields(error=-1), f"{LINE}: error", "negative"),
        (with_fields(error="-inf"), f"{LINE}: error", "negative"),
        (with_fields(roundoff=None), f"{LINE}: roundoff", "no number"),
        (with_fields(figures={"z": "2"}), f"{LINE}: figures/z", "no number"),
        (lambda s: s + "\n" + s, "stress.jsonl:3", "twice the same case and type"),
    ],
)
def test_bad_input_is_refused(run_directory, capsys, change, named, why):
    edit_line(run_directory, "stress.jsonl", 2, change)
    assert cli.main([str(run_directory), "--print"]) == 2, why
    assert named in capsys.readouterr().err, why


@pytest.mark.parametrize("text", ["", "\n\n"])
def test_an_empty_file_is_nothing_measured(run_directory, capsys, text):
    (run_directory / "stress.jsonl").write_text(text)
    with pytest.raises(NothingMeasured):
        records.load(run_directory)
    assert cli.main([str(run_directory), "--print"]) == 3
    assert "stress.jsonl" in capsys.readouterr().err


def test_matrix_has_a_letter_for_each_verdict():
    rows = [one("float", verdict="refused", as_known=False)]
    rows += [one("mpfr62", verdict="stable", as_known=True)]
    rows += [one("double", case="other", verdict="wrong_outcome", as_known=True)]
    first, second = csv_rows(tables.stress_matrix(stress_of(*rows)))
    assert first["case"] == "formula/other/naive"
    assert (first["float"], first["double"]) == ("", "W")
    assert (second["float"], second["float_standing"]) == ("R", "new")
    assert (second["mpfr62"], second["mpfr62_standing"]) == ("S", "as known")
    letters = [verdict.letter for verdict in verdicts.ALL]
    assert letters == list("SIUWDR"), "as the program has them"


def test_counts_add_up(run_directory):
    stress = records.load(run_directory).stress
    rows = csv_rows(tables.stress_counts(stress))
    names = [verdict.name for verdict in verdicts.ALL]
    for row in rows:
        assert sum(int(row[name]) for name in names) == int(row["cases"])
    of_all = [int(row["cases"]) for row in rows if row["kind"] == "all"]
    assert sum(of_all) == len(stress.rows) and len(of_all) == len(FEW)


def test_findings_put_new_ones_first_and_types_together():
    bad = {"verdict": "unstable", "as_known": True, "cause": "cancellation"}
    rows = [one(token, **bad) for token in ("float", "double")]
    rows.append(one("mpfr62", verdict="stable", as_known=True))
    rows.append(one("float", case="gone", verdict="diverged", as_known=False))
    rows[-1].update(cause="", why="not finite at step 3", expected="unstable")
    rows.append(one("double", case="gone", verdict="stable", as_known=False))
    rows[-1]["expected"] = "unstable"
    first, second, third = csv_rows(tables.stress_findings(stress_of(*rows)))
    assert (first["standing"], first["verdict"]) == ("new", "diverged")
    assert first["cause"] == "Not finite at step 3." and first["expected"] == "unstable"
    assert second["verdict"] == "stable", "better than known is a finding too"
    assert (third["types"], third["cause"]) == ("float, double", "Cancellation.")
    assert third["reproducer"].startswith("ulpgate stress --cases formula/sum/naive")
    good = stress_of(one(verdict="stable", as_known=True))
    assert tables.stress_findings(good).rows == ()


def test_causes_are_sentences():
    row = one("float", verdict="wrong_outcome", as_known=True)
    row.update(cause="A property of the method.", why="it slides", first_wrong="step 3")
    (found,) = csv_rows(tables.stress_findings(stress_of(row)))
    told = "A property of the method. It slides. First wrong: step 3."
    assert found["cause"] == told
    row.update(cause="v + a dt is v", why="sphere[0].radius: must be finite")
    (found,) = csv_rows(tables.stress_findings(stress_of(row)))
    assert found["cause"].startswith("v + a dt is v. sphere[0].radius: must")


def test_null_and_infinite_values(run_directory):
    rows = [
        one("float", correct_digits="-inf", roundoff=0),
        one("double", error="inf", correct_digits=None, figures={"largest": -1e300}),
    ]
    rows[0].update(dict.fromkeys(("error", "stepping_error", "condition"), "nan"))
    sample_stress.write(run_directory, rows)
    table = tables.stress_records(records.load(run_directory).stress)
    first, second = csv_rows(table)
    assert (first["error"], first["condition"]) == ("nan", "nan")
    assert (second["error"], second["correct_digits"]) == ("inf", "")
    assert cli.main([str(run_directory), "--out", str(run_directory / "out")]) == 0
    assert cli.main([str(run_directory), "--print"]) == 0


def test_each_letter_leads_to_its_record(tmp_path):
    rows = sample_stress.lines(FEW) + [
        one("float", case="a b"),
        one("float", case="a-b"),
        one("float", case="<script>alert(1)</script>", why="<b>why</b>"),
    ]
    run = sample_stress.write(tmp_path / "run", rows)
    assert cli.main([str(run), "--out", str(tmp_path / "out")]) == 0
    text = (tmp_path / "out" / "index.html").read_text("utf-8")
    page = References()
    page.feed(text)
    links = [value[1:] for tag, value in page.fetched if value.startswith("#stress-")]
    assert len(links) == len(set(links)) == len(rows)
    assert set(links) <= set(page.ids) and len(set(page.ids)) == len(page.ids)
    assert "<script>alert" not in text and "<b>why" not in text
    anchor = 'id="stress-trajectory-robertson-rk4-double"'
    line = next(line for line in text.split("\n") if anchor in line)
    assert "--cases trajectory/robertson/rk4 --types double" in line
    # A coloured cell has its letter and says more where the pointer rests.
    cell = re.search(r"<td style=[^>]*title=[^>]*>\s*<a href=[^>]*>R</a>", text)
    assert cell and verdicts.BY_LETTER["R"].back in cell.group()
    summary = json.loads((tmp_path / "out" / "summary.json").read_text("utf-8"))
    reading.validator("summary").validate(summary)
    assert len(summary["stress"]) == len(rows)


def test_colours_are_readable():
    def luminance(colour):
        parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
        parts = [p / 12.92 if p < 0.04 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
        return sum(w * p for w, p in zip((0.2126, 0.7152, 0.0722), parts))

    for verdict in verdicts.ALL:
        light, dark = sorted(map(luminance, (verdict.back, verdict.front)))[::-1]
        assert (light + 0.05) / (dark + 0.05) > 4.5, verdict.name


@pytest.mark.parametrize("count", [1, 45, 46, 150])
def test_long_catalogues_are_split_evenly(count):
    cases = list(range(count))
    figures = figure_matrix.figures_of(cases)
    parts = [part for one in figures for part in figure_matrix.blocks(one)]
    assert [case for part in parts for case in part] == cases
    assert max(map(len, parts)) <= 48
    assert all(len(figure_matrix.blocks(one)) <= 2 for one in figures)
    assert max(map(len, parts)) - min(map(len, parts)) <= len(parts)


def test_figures_have_every_letter(run_directory):
    stress = records.load(run_directory).stress
    for name, caption, figure in figure_matrix.draw(stress):
        of_kind = stress.of_kind(name.removeprefix("stability_"))
        expected = sorted(
            verdicts.BY_NAME[row["verdict"]].letter
            for of_type in of_kind.values()
            for row in of_type.values()
        )
        *plots, legend = figure.axes
        letters = sorted(t.get_text() for plot in plots for t in plot.texts)
        assert letters == expected and "case by type" in caption
        assert len(legend.texts) == 2 * len(verdicts.ALL) + 1
        pyplot.close(figure)


def test_the_report_of_cases_alone(run_directory, tmp_path, capsys):
    assert sorted(p.name for p in run_directory.iterdir()) == [
        "context.json",
        "stress.jsonl",
    ]
    out = tmp_path / "out"
    assert cli.main([str(run_directory), "--out", str(out)]) == 0
    assert capsys.readouterr().err == ""
    for make, formats in kind.TABLES:
        for form in formats:
            assert (out / f"{make.__name__}.{form}").stat().st_size > 0
    figures = {path.name.split(".")[0] for path in (out / "figures").iterdir()}
    assert figures == {f"stability_{name}" for name in stress_records.KINDS}
    # Of other kinds than now: their figures would pass for this run's.
    rows = [r for r in sample_stress.lines(FEW) if r["kind"] == "scene"]
    sample_stress.write(run_directory, rows)
    assert cli.main([str(run_directory), "--out", str(out)]) == 0
    figures = {path.name.split(".")[0] for path in (out / "figures").iterdir()}
    assert figures == {"stability_scene"}


def test_cases_of_a_suite(run_directory, tmp_path):
    base = tmp_path / "suite"
    shutil.copytree(run_directory, base / "first")
    assert suite.load(base).stress == records.load(run_directory).stress
    shutil.copytree(run_directory, base / "second")
    merged = suite.load(base).stress
    assert len(merged.rows) == 2 * len(sample_stress.lines(FEW))
    assert {row["case"][-6:] for row in merged.rows} == {"_first", "second"}


@needs_latex
def test_latex_compiles(run_directory, tmp_path):
    stress = records.load(run_directory).stress
    made = [make(stress) for make, formats in kind.TABLES if "tex" in formats]
    log = compile_tables(made, tmp_path)
    wide = [float(found) for found in re.findall(r"Overfull \\hbox \(([\d.]+)pt", log)]
    assert max(wide, default=0) < 40, "the tables fit the paper"
