"""Reads tables back from CSV and compiles them with pdflatex, for the tests."""
import csv
import io
import shutil
import subprocess

import pytest

from ulpgate_report.tables import table_csv, table_latex

needs_latex = pytest.mark.skipif(
    shutil.which("pdflatex") is None, reason="pdflatex is not installed"
)


def csv_rows(table):
    """A rendered CSV, read again."""
    return list(csv.DictReader(io.StringIO(table_csv.render(table))))


def compile_tables(tables, folder):
    """What pdflatex says about a document of the tables; it must take them."""
    for table in tables:
        text = table_latex.render(table)
        (folder / f"{table.name}.tex").write_text(text, "utf-8")
    (folder / "tables.tex").write_text(table_latex.document(tables), "utf-8")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "tables.tex"]
    done = subprocess.run(command, cwd=folder, capture_output=True, check=False)
    log = done.stdout.decode("latin-1")
    assert done.returncode == 0, log[-2000:]
    assert (folder / "tables.pdf").stat().st_size > 0
    return log
