"""Writes a table as a LaTeX longtable (booktabs, siunitx), and a document that shows all of them."""
import re

from ulpgate_report.tables import cell_text
from ulpgate_report.tables.table import Table

ARGUMENT_DIGITS = 13
COLUMNS_OF_PORTRAIT = 9
# Beside more columns than these a command has no room.
COLUMNS_OF_COMMANDS = 10
MANY_COLUMNS = 8
_ROWS_TOGETHER = 3
PROSE_MM, SHARED_PROSE_MM = 70, 80
# Rows of several lines each are told apart.
_BETWEEN_PROSE = "[2pt]"
_SYMBOLS = {"t_s": "t_s", "inf": r"\infty"}
_POWER = re.compile(r"\b(\w+)\^(-?\w+|-?\([\w-]+\))")
_SPECIAL = {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    "-": "{-}",
    **{c: "\\" + c for c in "#$%&_{}"},
}

_DOCUMENT = r"""\documentclass[a4paper]{article}
\usepackage[utf8]{inputenc}
\usepackage[margin=15mm%s]{geometry}
\usepackage{array}
\usepackage{booktabs}
\usepackage{longtable}
\usepackage{siunitx}
\begin{document}
%s
\end{document}
"""


def escape(text):
    """Text that LaTeX prints as it is; other than ASCII becomes `?`, which every font has."""
    plain = text.encode("ascii", "replace").decode("ascii")
    return "".join(_SPECIAL.get(c, c) for c in plain)


def escape_code(text):
    """The same in typewriter type, which has the signs of less and greater where others have none."""
    plain = escape(text)
    plain = plain.replace(r"\textless{}", "<").replace(r"\textgreater{}", ">")
    # The underscore of its own font, which can be copied; others draw a line.
    return plain.replace(r"\_", r"\char95{}")


def prose(text):
    """The same with its powers raised, and t_s and an inf that is explained as the symbols that they are."""
    parts, last = [], 0
    for found in re.finditer(rf"{_POWER.pattern}|\bt_s\b|\binf(?=:)", text):
        parts.append(escape(text[last : found.start()]))
        base, exponent = found.group(1, 2)
        power = f"\\mathrm{{{base}}}^{{{exponent}}}"
        parts.append(f"${_SYMBOLS.get(found.group(), power)}$")
        last = found.end()
    return "".join([*parts, escape(text[last:])])


def _number(text):
    if text in ("inf", "-inf"):
        return r"$-\infty$" if text[0] == "-" else r"$\infty$"
    return text if text in ("-", "nan") else rf"\num{{{text}}}"


def _text(cell, kind):
    value, mark = cell_text.value_and_mark(cell)
    shown = cell_text.short(cell, kind, ARGUMENT_DIGITS)
    if kind in cell_text.NUMERIC_KINDS:
        shown = "--" if value is None else _number(shown)
    elif kind in cell_text.CODE_KINDS:
        shown = rf"\texttt{{{escape_code(shown)}}}"
    else:
        shown = prose(shown)
    # Not raised: beside a power of ten it would be one more exponent.
    return shown + rf"\,{{\tiny {escape(mark)}}}" if mark else shown


def _shape(kind, prose_mm):
    if kind == "prose":
        return rf">{{\raggedright\arraybackslash}}p{{{prose_mm}mm}}"
    return "r" if kind in cell_text.NUMERIC_KINDS else "l"


def _caption(table):
    text = table.caption
    cut = any(
        cell_text.is_cut(cell, column.kind, ARGUMENT_DIGITS)
        for row in table.rows
        for cell, column in zip(row, table.columns)
    )
    if cut:
        text += " Long arguments are cut (...); the CSV file has them whole."
    return escape(text)


def without_commands(table):
    """The table without its commands; the caption says so."""
    kept = [i for i, c in enumerate(table.columns) if c.kind != "command"]
    rows = tuple(tuple(row[i] for i in kept) for row in table.rows)
    caption = f"{table.caption} The commands are in the CSV file."
    return Table(table.name, caption, tuple(table.columns[i] for i in kept), rows)


def _titles(table):
    titles = []
    for column in table.columns:
        title = escape(column.title)
        # Types are told by their token, in the columns' heads as in the command line.
        is_type = column.kind in ("ulp", "distance") and column.name == column.title
        titles.append(rf"\texttt{{{title}}}" if is_type else title)
    return titles


def turned(table):
    """The table on its side, for one of few rows and many columns: a line for each column, its unit in its title."""
    lines = [
        r"{\scriptsize\setlength{\tabcolsep}{3pt}",
        rf"\begin{{longtable}}{{@{{}}l{'r' * len(table.rows)}@{{}}}}",
        rf"\caption{{{_caption(table)}}}\label{{tab:{table.name}}}\\",
        r"\toprule",
        r"\endfirsthead",
        r"\toprule",
        r"\endhead",
        r"\bottomrule",
        r"\endfoot",
    ]
    for title, column, cells in zip(_titles(table), table.columns, zip(*table.rows)):
        shown = [_text(cell, column.kind) for cell in cells]
        lines.append(" & ".join([title, *shown]) + r" \\")
    return "\n".join([*lines, r"\end{longtable}}", ""])


def render(table, prose_mm=None):
    """The longtable; it repeats its head on every page.  `prose_mm` are the widths of its columns of prose."""
    if len(table.columns) > COLUMNS_OF_COMMANDS:
        has_command = any(c.kind == "command" for c in table.columns)
        table = without_commands(table) if has_command else table
    kinds = [column.kind for column in table.columns]
    if prose_mm is None:
        # One column of prose has room; several are in tables that are wide already.
        several = kinds.count("prose")
        prose_mm = [PROSE_MM if several < 2 else SHARED_PROSE_MM // several] * several
    widths = iter(prose_mm)
    shape = "".join(
        _shape(kind, next(widths) if kind == "prose" else None) for kind in kinds
    )
    head = [r"\toprule", " & ".join(_titles(table)) + r" \\", r"\midrule"]
    # Many columns stand closer: together their gaps are as wide as one more.
    gap = "3pt" if len(kinds) < MANY_COLUMNS else "2.3pt"
    lines = [
        rf"{{\scriptsize\setlength{{\tabcolsep}}{{{gap}}}",
        rf"\begin{{longtable}}{{@{{}}{shape}@{{}}}}",
        rf"\caption{{{_caption(table)}}}\label{{tab:{table.name}}}\\",
        *head,
        r"\endfirsthead",
        rf"\multicolumn{{{len(kinds)}}}{{@{{}}l}}{{\footnotesize\bfseries Table \thetable, continued}}\\",
        *head,
        r"\endhead",
        r"\bottomrule",
        r"\endfoot",
    ]
    last = len(table.rows) - 1
    for place, row in enumerate(table.rows):
        # No page begins or ends with one or two rows of a table.
        together = place < _ROWS_TOGETHER or last - _ROWS_TOGETHER < place < last
        lines.append(
            " & ".join(map(_text, row, kinds))
            + (r" \\*" if together else r" \\")
            + (_BETWEEN_PROSE if "prose" in kinds and place < last else "")
        )
    return "\n".join([*lines, r"\end{longtable}}", ""])


def document(tables):
    """A complete document of the tables, each in NAME.tex beside it; wide ones turn the paper."""
    wide = any(len(table.columns) > COLUMNS_OF_PORTRAIT for table in tables)
    inputs = "\n".join(rf"\input{{{table.name}.tex}}" for table in tables)
    return _DOCUMENT % (",landscape" if wide else "", inputs)
