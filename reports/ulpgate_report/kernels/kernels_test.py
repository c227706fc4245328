"""Tests of the kernels' report: combining, verdicts and readings, reproducers, figures, bad input, the page."""
import json

import pytest

from ulpgate_report.app import build, cli
from ulpgate_report.figures import figure_style
from ulpgate_report.kernels import combine, figure_condition, kind, tables
from ulpgate_report.records import reading, records
from ulpgate_report.tables import table_latex, table_markdown, table_text
from ulpgate_report.testing import sample_kernels
from ulpgate_report.testing.changes import edit_line, with_fields, without
from ulpgate_report.testing.table_check import compile_tables, csv_rows, needs_latex


def combined_run(change=lambda record: None):
    """The combined sample, each record passed through `change`."""
    lines = sample_kernels.records()
    for line in lines:
        change(line)
    run = records.Run(sample_kernels.context(), [], {}, tuple(lines))
    return combine.combine_run(run)


def is_at(record, *key):
    """Whether a record is of this quantity, type and stratum."""
    return (record["part"], record["type"], record["stratum"]) == key


def row_of(rows, **wanted):
    """The one line that has these values."""
    (found,) = [r for r in rows if all(r[k] == v for k, v in wanted.items())]
    return found


def test_ill_conditioned_is_not_unstable():
    rows = csv_rows(tables.kernel_errors(combined_run()))
    row = row_of(rows, quantity="sphere_sphere overlap", type="double")
    assert float(row["max_ulp"]) > 5e15
    assert float(row["max_normwise_over_condition"]) < 2
    assert float(row["condition"]) == 2.0**53 and row["ulp_stratum"] == "touching"
    assert row["reading"] == "ill-conditioned, not unstable"
    normal = row_of(rows, quantity="sphere_sphere normal", type="double")
    assert normal["reading"] == "small component of a vector"
    energy = row_of(rows, quantity="body_energy kinetic", type="float")
    assert energy["reading"] == "unstable"
    double = row_of(rows, quantity="body_energy kinetic", type="double")
    assert double["reading"] == "accurate"


def test_stability_matrix_names_the_verdict():
    table = tables.kernel_stability(combined_run())
    assert [row[0] for row in table.rows] == [
        "sphere_sphere overlap",
        "sphere_sphere normal",
        "body_energy kinetic",
    ]
    row = row_of(csv_rows(table), quantity="body_energy kinetic")
    assert (row["float"], row["float_verdict"]) == ("61000.0", "unstable")
    assert row["double_verdict"] == "stable"
    assert "6.10e4 **unstable**" in table_markdown.render(table)
    assert r"\num{6.10e4}\,{\tiny unstable}" in table_latex.render(table)
    assert "6.10e4 unstable" in table_text.render(table)


def test_unstable_rows_can_be_reproduced():
    (row,) = csv_rows(tables.kernel_unstable(combined_run()))
    assert (row["type"], row["stratum"]) == ("float", "ratio")
    (line,) = [r for r in sample_kernels.records() if r["verdict"] == "unstable"]
    state = " ".join(line["normwise_argmax"])
    assert row["reproducer"] == f"ulpgate at body_energy float {state}"
    assert row["reproducer"] in table_text.render(
        tables.kernel_unstable(combined_run())
    )


def test_mismatches_can_be_reproduced():
    def change(record):
        record["mismatch"], record["mismatch_first"] = {"nan": 0}, {}
        if is_at(record, "normal", "mpfr62", "ratio"):
            record["mismatch"] = {"nan": 2, "inf": 1}
            record["mismatch_first"] = {"nan": ["0x1p+0", "-0x1p-3"]}

    table = tables.kernel_mismatches(combined_run(change))
    found = [(r["class"], r["count"], r["reproducer"]) for r in csv_rows(table)]
    command = "ulpgate at sphere_sphere mpfr62 0x1p+0 -0x1p-3"
    assert found == [("inf", "1", ""), ("nan", "2", command)]
    row = row_of(
        csv_rows(tables.kernel_ulp(combined_run(change))),
        quantity="sphere_sphere normal",
    )
    assert row["mpfr62_mismatches"] == "3"


@pytest.mark.parametrize(
    "values, expected, stratum, why",
    [
        ([1.0, 3.0, 2.0], 3.0, "touching", "the largest"),
        ([2.0, 2.0, 1.0], 2.0, "typical", "a tie goes to the first stratum"),
        ([5.0, "inf", None], float("inf"), "touching", "inf is larger than any number"),
        ([None, None, None], None, None, "nothing judged"),
    ],
)
def test_maximum_over_strata(values, expected, stratum, why):
    def change(record):
        if record["part"] == "normal":
            value = values[sample_kernels.STRATA.index(record["stratum"])]
            record["max_normwise_over_condition"] = record["max_normwise"] = value
            record["max_ulp"] = value

    run = combined_run(change)
    cell = run.cells[run.rows[1], "double"]
    assert cell.max_normwise_over_condition == expected, why
    assert cell.over_condition_stratum == cell.normwise_stratum == stratum, why
    assert run.stratum_cells[run.rows[1], "typical"].samples == 7 * 200


def hard_values(record):
    """Infinite, exact and unjudged values."""
    names = ("max_ulp", "max_normwise", "condition", "max_normwise_over_condition")
    for token, value in (("float", "inf"), ("double", None), ("mpfr62", 0)):
        if record["type"] == token:
            record.update(dict.fromkeys(names, value))


@pytest.mark.parametrize("draw", kind.FIGURES)
def test_hard_values_are_drawn(draw):
    name, caption, figure = draw(combined_run(hard_values))
    assert figure_style.render(figure, name)["png"]
    assert caption.endswith(".")


def test_points_lie_below_the_diagonal_unless_unstable():
    found = figure_condition.points(combined_run())
    for _, at_risk, lost, record in found:
        assert (lost - at_risk > 0.2) == (record["verdict"] == "unstable")
    run = combined_run(lambda record: record.update(max_normwise="inf"))
    assert figure_condition.draw(run)[2] is None


@pytest.fixture
def run_directory(tmp_path):
    """A small good run."""
    return sample_kernels.write(tmp_path / "run", sample_kernels.records())


@pytest.mark.parametrize(
    "name, change, named, why",
    [
        ("kernels.jsonl", lambda s: s[: len(s) // 2], "kernels.jsonl:2", "truncated"),
        (
            "kernels.jsonl",
            with_fields(condition=-1),
            "kernels.jsonl:2: condition",
            "negative",
        ),
        (
            "kernels.jsonl",
            with_fields(verdict="fine"),
            "kernels.jsonl:2: verdict",
            "no verdict",
        ),
        ("kernels.jsonl", without("max_normwise"), "kernels.jsonl:2", "field missing"),
        (
            "kernels.jsonl",
            with_fields(part="mass"),
            "kernels.jsonl:2: body_energy mass",
            "no such quantity",
        ),
        ("kernels.jsonl", with_fields(plan="f" * 16), "kernels.jsonl:2: plan", "plan"),
        (
            "kernels.jsonl",
            lambda s: s + "\n" + s,
            "kernels.jsonl:3",
            "twice the same record",
        ),
        ("kernels.jsonl", lambda s: "\xff{", "kernels.jsonl:2", "not JSON"),
    ],
)
def test_bad_input_is_refused(run_directory, capsys, name, change, named, why):
    edit_line(run_directory, name, 2, change)
    assert cli.main([str(run_directory), "--print"]) == 2, why
    assert named in capsys.readouterr().err, why


@pytest.mark.parametrize("name", ["kernels", "seed", "types"])
def test_context_of_kernels_must_be_whole(run_directory, capsys, name):
    edit_line(run_directory, "context.json", 1, without(name))
    assert cli.main([str(run_directory), "--print"]) == 2
    assert "context.json" in capsys.readouterr().err


def test_no_sample_is_nothing_measured(run_directory):
    lines = [{**line, "samples": 0} for line in sample_kernels.records()]
    sample_kernels.write(run_directory, lines)
    assert cli.main([str(run_directory), "--print"]) == 3


def test_print(run_directory, capsys):
    assert cli.main([str(run_directory), "--print"]) == 0
    text = capsys.readouterr().out
    assert "sphere_sphere overlap" in text and "ulpgate at body_energy float" in text


def test_whole_report(run_directory, tmp_path):
    first, second = tmp_path / "first", tmp_path / "second"
    for out in (first, second):
        assert cli.main([str(run_directory), "--out", str(out)]) == 0
    files = sorted(p.relative_to(first) for p in first.rglob("*") if p.is_file())
    for name in files:
        assert (first / name).read_bytes() == (second / name).read_bytes(), name
    assert len(list((first / "figures").glob("*.svg"))) == len(kind.FIGURES)
    for make, formats in kind.TABLES:
        for form in formats:
            assert (first / f"{make.__name__}.{form}").stat().st_size > 0
    summary = json.loads((first / "summary.json").read_text("utf-8"))
    reading.validator("summary").validate(summary)
    assert len(summary["kernels"]) == 3 * 7 and "cells" not in summary
    page = (first / "index.html").read_text("utf-8")
    assert "1 unstable" in page and "ill-conditioned, not unstable" in page
    assert 'id="kernel_stability"' in page and 'id="distributions"' not in page


def test_every_table_has_the_name_of_its_function():
    run = combined_run()
    for make, _ in kind.TABLES:
        assert make(run).name == make.__name__
    assert build.KINDS.index(kind) == 2


@needs_latex
def test_latex_compiles(tmp_path):
    run = combined_run(hard_values)
    compile_tables([make(run) for make, f in kind.TABLES if "tex" in f], tmp_path)
