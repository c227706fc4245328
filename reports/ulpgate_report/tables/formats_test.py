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
