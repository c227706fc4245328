"""Writes a table as a LaTeX longtable (booktabs, siunitx), and a document that shows all of them."""
from ulpgate_report import cell_text, numbers

ARGUMENT_DIGITS = 13
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
\usepackage[margin=15mm]{geometry}
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


def _number(text):
    if text == "inf":
        return r"$\infty$"
    return text if text == "-" else rf"\num{{{text}}}"


def _text(cell, kind):
    value, mismatches = cell_text.value_and_mark(cell)
    shown = cell_text.short(cell, kind, ARGUMENT_DIGITS)
    if kind in cell_text.NUMERIC_KINDS:
        shown = "--" if value is None else _number(shown)
    elif kind in ("code", "arguments"):
        shown = rf"\texttt{{{escape(shown)}}}"
    else:
        shown = escape(shown)
    return shown + rf"\textsuperscript{{!{mismatches}}}" if mismatches else shown


def _caption(table):
    text = table.caption
    cut = any(
        numbers.short_arguments(cell, ARGUMENT_DIGITS) != ", ".join(cell)
        for row in table.rows
        for cell, column in zip(row, table.columns)
        if column.kind == "arguments" and cell
    )
    if cut:
        text += " Long arguments are cut (...); the CSV file has them whole."
    return escape(text)


def render(table):
    """The longtable; it repeats its head on every page."""
    kinds = [column.kind for column in table.columns]
    shape = "".join("r" if kind in cell_text.NUMERIC_KINDS else "l" for kind in kinds)
    titles = []
    for column in table.columns:
        title = escape(column.title)
        # Types are told by their token, in the columns' heads as in the command line.
        code = column.name == column.title and column.kind in ("ulp", "distance")
        titles.append(rf"\texttt{{{title}}}" if code else title)
    head = [r"\toprule", " & ".join(titles) + r" \\", r"\midrule"]
    lines = [
        r"{\scriptsize\setlength{\tabcolsep}{3pt}",
        rf"\begin{{longtable}}{{@{{}}{shape}@{{}}}}",
        rf"\caption{{{_caption(table)}}}\label{{tab:{table.name}}}\\",
        *head,
        r"\endfirsthead",
        *head,
        r"\endhead",
        r"\bottomrule",
        r"\endfoot",
    ]
    for row in table.rows:
        lines.append(" & ".join(map(_text, row, kinds)) + r" \\")
    return "\n".join([*lines, r"\end{longtable}}", ""])


def document(names):
    """A complete document of the tables `names`, each in NAME.tex beside it."""
    return _DOCUMENT % "\n".join(rf"\input{{{name}.tex}}" for name in names)
