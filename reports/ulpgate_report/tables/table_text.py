"""Writes a table as aligned plain text for a terminal; `!n` marks n mismatches."""
import textwrap

from ulpgate_report.tables import cell_text

ARGUMENT_DIGITS = 10
NARROWEST_CAPTION = 72
WIDEST_PROSE = 60


def _text(cell, kind):
    _, mark = cell_text.value_and_mark(cell)
    # A command is there to be copied.
    digits = None if kind == "command" else ARGUMENT_DIGITS
    shown = cell_text.short(cell, kind, digits)
    if kind == "prose":
        shown = textwrap.shorten(shown, WIDEST_PROSE, placeholder=" ...")
    return f"{shown} {mark}" if mark else shown


def render(table):
    """The table, its caption below."""
    lines = [[column.title for column in table.columns]]
    for row in table.rows:
        lines.append([_text(c, column.kind) for c, column in zip(row, table.columns)])
    widths = [max(len(line[i]) for line in lines) for i in range(len(table.columns))]
    texts = []
    for line in lines:
        parts = []
        for text, width, column in zip(line, widths, table.columns):
            numeric = column.kind in cell_text.NUMERIC_KINDS
            parts.append(text.rjust(width) if numeric else text.ljust(width))
        texts.append("  ".join(parts).rstrip())
    # A command may be as long as a page is wide many times over; the rule and the caption are not.
    shown = [
        len(column.title) if column.kind == "command" else width
        for width, column in zip(widths, table.columns)
    ]
    total = sum(shown) + 2 * (len(shown) - 1)
    texts.insert(1, "-" * total)
    caption = textwrap.wrap(table.caption, max(total, NARROWEST_CAPTION))
    return "\n".join([*texts, "", *caption, ""])
