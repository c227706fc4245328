"""LaTeX of the paper: a table or figure as a fragment for `\\input`, findings, and the document of all of them."""
import dataclasses
import itertools
import math
import re
import struct

from ulpgate_report.tables import cell_text, table_latex

TEXT_WIDTH_MM, FIGURE_HEIGHT_MM = 183.0, 205.0
PAGE_HEIGHT_MM = 257.0
# Narrower, and prose is a word a line.
LEAST_PROSE_MM = 24.0
# What is no longer looked at on paper.
MOST_LINES, PROSE_LINE = 420, 70
# Tables of so many rows and many columns stand on their side.
FEW_ROWS = 3
_MM_PER_INCH = 25.4
# What is set as mathematics in a caption: 2^-p, 1e6 beside a unit stays as it is typed in commands.
_POWER = re.compile(r"\b(\w+)\^(-?\w+|-?\([\w-]+\))")

_HEAD = r"""\documentclass[a4paper,10pt]{article}
\usepackage[utf8]{inputenc}
\usepackage[textwidth=183mm,textheight=257mm]{geometry}
\usepackage{array,booktabs,longtable,pdflscape,graphicx,siunitx}
\usepackage[font=footnotesize,labelfont=bf,skip=4pt]{caption}
\usepackage[hidelinks]{hyperref}
\pdfinfoomitdate=1
\pdftrailerid{}
\pdfsuppressptexinfo=-1
\setlength{\parindent}{0pt}
\setlength{\emergencystretch}{3em}
\title{Numerical accuracy, measured}
\author{made by \texttt{scripts/paper} of ulpgate %s}
\date{}
\begin{document}
\maketitle
%s
"""
_TAIL = "\\end{document}\n"


def tex_command(text, every=6):
    """Typewriter text that may break anywhere, whole: a command is there to be copied."""
    pieces = [text[i : i + every] for i in range(0, len(text), every)]
    return (
        r"\texttt{" + r"\allowbreak{}".join(map(table_latex.escape_code, pieces)) + "}"
    )


def caption(said):
    """A caption whose text between backquotes is a command."""
    parts = said.split("`")
    return "".join(
        tex_command(part) if place % 2 else _prose(part)
        for place, part in enumerate(parts)
    )


def _prose(text):
    """Text with its powers raised and t_s as the symbol it is."""
    lines, last = [], 0
    for found in re.finditer(rf"{_POWER.pattern}|\bt_s\b", text):
        lines.append(table_latex.escape(text[last : found.start()]))
        base, exponent = found.group(1, 2)
        symbol = "t_s" if base is None else f"\\mathrm{{{base}}}^{{{exponent}}}"
        lines.append(f"${symbol}$")
        last = found.end()
    return "".join([*lines, table_latex.escape(text[last:])])


def _column_mm(column, cells):
    """About how wide a column is in the small type of tables."""
    texts = [column.title]
    for cell in cells:
        _, mark = cell_text.value_and_mark(cell)
        shown = cell_text.short(cell, column.kind, table_latex.ARGUMENT_DIGITS)
        # A power of ten is set out: 1.2 x 10^-5.
        longer = 4 * ("e" in shown and column.kind in cell_text.NUMERIC_KINDS)
        texts.append(shown + mark + " " * longer)
    each = 1.32 if column.kind in cell_text.CODE_KINDS else 1.2
    return max(map(len, texts)) * each


def _prose_mm(column, cells):
    """What a column of prose wants: its longest text on one line, unless most of them are much shorter."""
    lengths = [len(cell_text.short(cell, column.kind)) for cell in cells]
    line = min(max(lengths), 3 * sum(lengths) / len(lengths))
    return 1.2 * max(line, len(column.title) + 2) + 2


def _lines_of(row, columns):
    """About how many lines a row takes."""
    lengths = [
        len(cell_text.short(cell, c.kind))
        for cell, c in zip(row, columns)
        if c.kind == "prose"
    ]
    return max((1, *(math.ceil(n / PROSE_LINE) for n in lengths)))


def _shortened(found):
    """The table without the rows that would make pages of it; the caption says so."""
    lines = itertools.accumulate(_lines_of(row, found.columns) for row in found.rows)
    most = sum(so_far <= MOST_LINES for so_far in lines)
    if len(found.rows) <= most:
        return found
    said = f" The first {most} of {len(found.rows)} rows; the CSV file has all."
    return dataclasses.replace(
        found, rows=found.rows[:most], caption=found.caption + said
    )


def prose_widths(found, width_mm):
    """The widths of the columns of prose, mm, in a table of that width; None where it has no room for them.

    Each is as wide as its longest text at most; where that is too much, they share what the others leave.
    """
    columns = list(zip(found.columns, zip(*found.rows)))
    widths = [
        _prose_mm(*one) if one[0].kind == "prose" else _column_mm(*one)
        for one in columns
    ]
    is_prose = [c.kind == "prose" for c in found.columns]
    fixed = sum(w for w, prose in zip(widths, is_prose) if not prose)
    room = width_mm - fixed - 2.2 * len(widths)
    wanted = [w for w, prose in zip(widths, is_prose) if prose]
    if not wanted:
        return [] if room >= 0 else None
    if sum(wanted) <= room:
        return [round(w, 1) for w in wanted]
    # Short ones have what they want, the others the same share.
    shares, left = {}, room
    for place in sorted(range(len(wanted)), key=wanted.__getitem__):
        shares[place] = min(wanted[place], left / (len(wanted) - len(shares)))
        left -= shares[place]
    if any(s < min(LEAST_PROSE_MM, w) for s, w in zip(shares.values(), sorted(wanted))):
        return None
    return [round(shares[place], 1) for place in range(len(wanted))]


def _laid_out(found):
    """(LaTeX, its table, whether the page is on its side): the first way in which all of the table is on the page."""
    has_command = any(c.kind == "command" for c in found.columns)
    ways = [found, table_latex.without_commands(found)] if has_command else [found]
    for way in ways:
        widths = prose_widths(way, TEXT_WIDTH_MM)
        if widths is not None:
            return table_latex.render(way, widths), way, False
    few = ways[-1]
    if len(few.rows) <= FEW_ROWS and len(few.columns) > 2 * len(few.rows):
        return table_latex.turned(few), few, False
    for way in ways:
        widths = prose_widths(way, PAGE_HEIGHT_MM)
        if widths is not None:
            return table_latex.render(way, widths), way, True
    return table_latex.render(few), few, True


def table(found):
    """The table; one too wide for the page loses its commands, of few rows it is turned, else the page is."""
    text, shown, sideways = _laid_out(_shortened(found))
    # Commands in a caption may break between any two letters.
    plain = table_latex.escape(shown.caption)
    text = text.replace(plain, caption(shown.caption))
    if sideways:
        return f"\\begin{{landscape}}\n{text}\\end{{landscape}}\n"
    return text


def inches(png, dots_per_inch):
    """Width and height of a picture."""
    width, height = struct.unpack(">II", png[16:24])
    return width / dots_per_inch, height / dots_per_inch


def figure(name, said, png, dots_per_inch):
    """The figure at its own size, smaller where the page asks for it."""
    width, height = (s * _MM_PER_INCH for s in inches(png, dots_per_inch))
    scale = min(1.0, TEXT_WIDTH_MM / width, FIGURE_HEIGHT_MM / height)
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


def findings(by_library):
    """A list a library, each finding with its command."""
    lines = []
    for library, found, more in by_library:
        lines.append(rf"\subsection*{{{table_latex.escape(library)}}}")
        lines.append(r"\begin{itemize}\setlength{\itemsep}{1pt}\small\raggedright")
        for same in found:
            worst = same[0]
            command = f" {tex_command(worst.command)}" if worst.command else ""
            types = ", ".join(one.type for one in same)
            lines.append(
                rf"\item \texttt{{{table_latex.escape_code(worst.subject)}}} ({table_latex.escape(types)}): "
                rf"in {table_latex.escape(worst.type)} {table_latex.escape(worst.says)}.{command}"
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
