"""How a table stands on a page: widths of its columns, its commands left out, itself or the page turned, rows left out."""
import dataclasses
import itertools
import math

from ulpgate_report.tables import cell_text, table_latex

TEXT_WIDTH_MM, PAGE_HEIGHT_MM = 183.0, 257.0
# Narrower, and prose is a word a line.
LEAST_PROSE_MM = 24.0
# What is no longer looked at on paper.
MOST_LINES, PROSE_LINE = 420, 70
# Tables of so many rows and many columns stand on their side.
FEW_ROWS = 3


def _column_mm(column, cells):
    """About how wide a column is in the small type of tables."""
    texts = [column.title]
    for cell in cells:
        _, mark = cell_text.value_and_mark(cell)
        shown = cell_text.short(cell, column.kind, table_latex.ARGUMENT_DIGITS)
        # A power of ten is set out: 1.2 x 10^-5.
        longer = 4 * ("e" in shown and column.kind in cell_text.NUMERIC_KINDS)
        texts.append(shown + mark + " " * longer)
    each = 1.38 if column.kind in cell_text.CODE_KINDS else 1.2
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


def _without_empty(found):
    """The table without columns that no row has anything in."""
    kept = [
        i
        for i in range(len(found.columns))
        if not found.rows or any(row[i] is not None for row in found.rows)
    ]
    return dataclasses.replace(
        found,
        columns=tuple(found.columns[i] for i in kept),
        rows=tuple(tuple(row[i] for i in kept) for row in found.rows),
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


def laid_out(found):
    """(LaTeX, its table, whether the page is on its side): the first way in which all of it is on the page.

    One that is too wide loses its commands; of few rows it is turned, else the page is.
    """
    found = _shortened(_without_empty(found))
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
