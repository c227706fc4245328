"""Tests of what each format escapes."""
import pytest

from ulpgate_report.tables import table_latex, table_markdown
from ulpgate_report.tables.table import Column, Table


@pytest.mark.parametrize(
    "text, latex, markdown, why",
    [
        ("a_b", r"a\_b", "`a_b`", "underscore"),
        ("a|b", r"a\textbar{}b", r"`a\|b`", "bar ends a Markdown cell"),
        ("*", "*", "`*`", "star"),
        ("5%&#", r"5\%\&\#", "`5%&#`", "LaTeX's own"),
        ("\\x", r"\textbackslash{}x", "`\\x`", "backslash"),
        ("--", "{-}{-}", "`--`", "no dash is made of two minus signs"),
    ],
)
def test_names_are_escaped(text, latex, markdown, why):
    table = Table("t", "c", (Column("f", "f", "code"),), ((text,),))
    assert table_latex.escape(text) == latex, why
    assert f"| {markdown} |" in table_markdown.render(table), why


def test_prose_has_its_powers_raised_and_its_rows_apart():
    columns = (Column("why", "why", "prose"),)
    assert table_latex.prose("inf: of t_s") == r"$\infty$: of $t_s$"
    rows = (("a root of 2^-24 and t^2",), ("x",), ("y",))
    found = table_latex.render(Table("t", "c", columns, rows)).splitlines()
    assert r"a root of $\mathrm{2}^{-24}$ and $\mathrm{t}^{2}$ \\*[2pt]" in found
    assert found[found.index(r"x \\*[2pt]") + 1] == r"y \\*", "none after the last"
