"""Tests of the functions' tables: numbers, marks, order; and that LaTeX takes them."""
from ulpgate_report.math import combine, kind, tables
from ulpgate_report.records import records
from ulpgate_report.tables import table_latex, table_text
from ulpgate_report.testing import sample_records
from ulpgate_report.testing.hard_records import hard_values, is_at
from ulpgate_report.testing.table_check import compile_tables, csv_rows, needs_latex


def combined_run(names, change=lambda record: None):
    """A combined sample run, each record passed through `change`."""
    context = sample_records.context(names)
    math = sample_records.math_records(context)
    for record in math:
        change(record)
    return combine.combine_run(records.Run(context, math, {}))


def test_rows_stand_in_display_order():
    names = ["tan", "add", "ctan", "sin", "factorial"]
    table = tables.paper_table(combined_run(names))
    expected = ["add", "sin", "tan", "ctan re", "ctan im", "factorial"]
    assert [row[0] for row in table.rows] == expected
    long_rows = csv_rows(tables.long_table(combined_run(["tan", "add"])))
    assert [row["stratum"] for row in long_rows[:6]] == list(sample_records.STRATA)
    assert long_rows[0]["function"] == "add" and long_rows[0]["type"] == "float"


def test_infinite_null_and_huge_values():
    run = combined_run(["tan"], hard_values)
    (row,) = csv_rows(tables.ulp_matrix(run))
    assert row["float"] == "inf"
    assert row["double"] == "" and row["double_mismatches"] == "6000"
    (paper,) = csv_rows(tables.paper_table(run))
    assert paper["float"] != "inf", "the stratum hard is not of the paper"
    assert paper["mpfr150"] == str(10**400)
    text = table_text.render(tables.ulp_matrix(run))
    assert " inf " in text and "- !6000" in text
    latex = table_latex.render(tables.paper_table(run))
    assert r"\num{1.00e400}" in latex and r"--\,{\tiny !2000}" in latex
    assert r"$\infty$" in table_latex.render(tables.ulp_matrix(run))


def test_where_it_happens():
    def change(record):
        if is_at(record, "double", "edges"):
            record.update(max_ulp=99.5, argmax=["0x1.8p+1"])

    rows = csv_rows(tables.ulp_table(combined_run(["tan"], change)))
    (row,) = [row for row in rows if row["type"] == "double"]
    assert (row["max_ulp"], row["stratum"], row["argument"]) == (
        "99.5",
        "edges",
        "0x1.8p+1",
    )


def test_mismatches_are_listed_by_class():
    def change(record):
        record["mismatch"] = {"nan": 0}
        record["mismatch_first"] = {}
        if is_at(record, "float128", "edges"):
            record["mismatch"] = {"nan": 2, "inf": 1}
            record["mismatch_first"] = {"nan": ["0x1p+0"], "inf": ["-0x1p+0"]}

    rows = csv_rows(tables.mismatch_table(combined_run(["tan"], change)))
    found = [(row["class"], row["count"], row["first_argument"]) for row in rows]
    assert found == [("inf", "1", "-0x1p+0"), ("nan", "2", "0x1p+0")]


def test_a_type_without_records_stays_visible():
    context = sample_records.context(["tan"])
    math = [r for r in sample_records.math_records(context) if r["type"] != "double"]
    run = combine.combine_run(records.Run(context, math, {}))
    (row,) = tables.ulp_matrix(run).rows
    assert row[2] is None
    (line,) = csv_rows(tables.ulp_matrix(run))
    assert line["double"] == "" and line["double_mismatches"] == ""


def test_terminal_table_fits():
    text = table_text.render(tables.ulp_matrix(combined_run(None)))
    assert max(map(len, text.split("\n"))) <= 110
    assert "!3" in text


@needs_latex
def test_latex_compiles_and_breaks_over_pages(tmp_path):
    run = combined_run(None, hard_values)
    made = [make(run) for make, formats in kind.TABLES if "tex" in formats]
    assert "(1 page" not in compile_tables(made, tmp_path)


def test_a_result_of_the_wrong_kind_is_not_rounded_correctly():
    def exact(record):
        record.update(max_ulp=0.5, mismatch={})

    def wrong_in_double(record):
        exact(record)
        if is_at(record, "double", "edges"):
            record.update(mismatch={"zero_sign": 1})

    run = combined_run(["sin"], exact)
    ((said, _),) = kind.headline(run)
    types = len(run.type_tokens)
    assert f"Of {types} rows {types} are rounded correctly" in said
    run = combined_run(["sin"], wrong_in_double)
    ((said, _),) = kind.headline(run)
    assert f"Of {types} rows {types - 1} are rounded correctly" in said
    (row,) = [r for r in csv_rows(tables.type_table(run)) if r["type"] == "double"]
    assert (row["wrong_kind"], row["causes"]) == ("1", "zero_sign 1")


def test_the_largest_errors_come_first_with_their_commands():
    def change(record):
        if is_at(record, "double", "edges"):
            record.update(max_ulp=1e9, argmax=["0x1.8p+1"])

    run = combined_run(["tan", "sin"], change)
    rows = csv_rows(tables.worst_table(run))
    errors = [float(row["max_ulp"]) for row in rows]
    assert errors == sorted(errors, reverse=True) and errors[0] == 1e9
    assert rows[0]["command"] in (
        f"ulpgate at {name} double 0x1.8p+1" for name in ("sin", "tan")
    )


def test_the_headline_counts_errors_that_no_number_tells():
    def change(record):
        record.update(max_ulp=2.0)
        if record["type"] == "double":
            record.update(max_ulp="inf")
        if record["type"] == "float128":
            record.update(max_ulp=3e5)

    ((said, _),) = kind.headline(combined_run(["sin"], change))
    assert "; 1 err by more ULP than a double can tell; " in said
    assert (
        said.count("the largest error of the others is 3.00e5 ULP, of sin in float128.")
        == 1
    )
    ((said, _),) = kind.headline(
        combined_run(["sin"], lambda record: record.update(max_ulp="inf"))
    )
    assert (
        f"{len(sample_records.TYPES)} err by more ULP than a double can tell." in said
    )
    assert "of the others" not in said
