"""LaTeX of the paper: a table or figure as a fragment for `\\input`, findings, and the document of all of them."""
import re
import struct

from ulpgate_report.paper import layout
from ulpgate_report.tables import table_latex

FIGURE_HEIGHT_MM = 205.0
_MM_PER_INCH = 25.4
_LONGEST_WORD = 30
_LANDSCAPE = r"\begin{landscape}"

_HEAD = r"""\documentclass[a4paper,10pt]{article}
\usepackage[utf8]{inputenc}
\usepackage[textwidth=183mm,textheight=257mm]{geometry}
\usepackage{array,booktabs,longtable,pdflscape,graphicx,siunitx}
\usepackage[font=footnotesize,labelfont=bf,skip=4pt,justification=raggedright]{caption}
\usepackage[hidelinks]{hyperref}
\pdfinfoomitdate=1
\pdftrailerid{}
\pdfsuppressptexinfo=-1
\setlength{\parindent}{0pt}
\setlength{\emergencystretch}{3em}
\title{Numerical accuracy, measured}
\author{made by \texttt{scripts/paper} of ulpgate %s}
\date{}
\hypersetup{pdftitle={Numerical accuracy, measured},pdfauthor={ulpgate}}
\begin{document}
\maketitle
\begin{abstract}\noindent
%s
\end{abstract}
\tableofcontents
"""
_TAIL = "\\end{document}\n"


def _breakable(word):
    """A word of a command; a long list may break after its commas, and what is longer yet anywhere."""
    if len(word) <= _LONGEST_WORD:
        return table_latex.escape_code(word)
    pieces = re.findall(rf"[^,]{{1,{_LONGEST_WORD}}},?", word)
    return r"\allowbreak{}".join(map(table_latex.escape_code, pieces))


def tex_command(text):
    """Typewriter text, whole: a command is there to be copied, so that it breaks between its words."""
    return r"\texttt{" + " ".join(map(_breakable, text.split(" "))) + "}"


def caption(said):
    """A caption whose text between backquotes is a command."""
    parts = said.split("`")
    return "".join(
        tex_command(part) if place % 2 else table_latex.prose(part)
        for place, part in enumerate(parts)
    )


def table(found):
    """The table, laid out so that all of it is on the page."""
    text, shown, sideways = layout.laid_out(found)
    # Commands in a caption may break between any two letters.
    plain = table_latex.escape(shown.caption)
    text = text.replace(plain, caption(shown.caption))
    if sideways:
        return f"{_LANDSCAPE}\n{text}\\end{{landscape}}\n"
    return text


def is_sideways(path):
    """Whether a table's fragment turns the page."""
    return path.read_text(encoding="utf-8").startswith(_LANDSCAPE)


def inches(png, dots_per_inch):
    """Width and height of a picture."""
    width, height = struct.unpack(">II", png[16:24])
    return width / dots_per_inch, height / dots_per_inch


def figure(name, said, png, dots_per_inch):
    """The figure at its own size, smaller where the page asks for it."""
    width, height = (s * _MM_PER_INCH for s in inches(png, dots_per_inch))
    scale = min(1.0, layout.TEXT_WIDTH_MM / width, FIGURE_HEIGHT_MM / height)
    return "\n".join(
        (
            r"\begin{figure}[htbp]",
            r"\centering",
            rf"\includegraphics[width={width * scale:.1f}mm]{{figures/{name}.pdf}}",
            rf"\caption{{{caption(said)}}}\label{{fig:{name}}}",
            r"\end{figure}",
            "",
        )
    )


def _symbol(name):
    return rf"\texttt{{{table_latex.escape_code(name)}}}"


def findings(by_library):
    """A list a library, each finding with its command."""
    lines = []
    for library, found, more in by_library:
        lines.append(rf"\subsection*{{{table_latex.escape(library)}}}")
        lines.append(r"\begin{itemize}\setlength{\itemsep}{1pt}\small\raggedright")
        for same in found:
            worst = same[0]
            command = f" {tex_command(worst.command)}" if worst.command else ""
            alike = [one for one in same if one.subject == worst.subject]
            types = list(dict.fromkeys(one.type for one in alike))
            where = f"in {worst.type} " if len(types) > 1 else ""
            others = dict.fromkeys(one.subject for one in same)
            others.pop(worst.subject)
            also = ", ".join(_symbol(one) for one in others)
            also = f" Something of the kind: {also}." if also else ""
            lines.append(
                rf"\item {_symbol(worst.subject)} ({table_latex.escape(', '.join(types))}): "
                rf"{table_latex.escape(where + worst.says)}.{command}{also}"
            )
        if more:
            lines.append(rf"\item and {more} more, in \texttt{{data/findings.csv}}.")
        lines.append(r"\end{itemize}")
    return "\n".join([*lines, ""])


def document(version, abstract, chapters):
    """The whole; a chapter is (title, what it says, names of its fragments)."""
    lines = []
    for title, says, inputs in chapters:
        lines.append(rf"\section{{{table_latex.escape(title)}}}")
        lines.append(caption(says) + "\n")
        lines += [rf"\input{{{name}}}" for name in inputs]
        lines.append(r"\clearpage")
    head = _HEAD % (table_latex.escape(version), caption(abstract))
    return head + "\n".join(lines) + "\n" + _TAIL
