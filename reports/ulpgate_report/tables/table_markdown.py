"""Writes a table as GitHub Markdown; arguments stand whole, so that they can be copied."""
from ulpgate_report.tables import cell_text

_SPECIAL = str.maketrans({c: "\\" + c for c in "\\`*_{}[]<>#|~"})


def _text(cell, kind):
    value, mark = cell_text.value_and_mark(cell)
    shown = cell_text.short(cell, kind)
    if kind in cell_text.CODE_KINDS and value and "`" not in shown:
        # A bar ends a cell even inside code.
        shown = "`" + shown.replace("|", "\\|") + "`"
    else:
        shown = shown.translate(_SPECIAL)
    return f"{shown} **{mark}**" if mark else shown


def render(table):
    """The table, its caption above."""
    lines = [table.caption.translate(_SPECIAL), ""]
    lines.append(
        "| " + " | ".join(c.title.translate(_SPECIAL) for c in table.columns) + " |"
    )
    rules = [
        "--:" if c.kind in cell_text.NUMERIC_KINDS else ":--" for c in table.columns
    ]
    lines.append("| " + " | ".join(rules) + " |")
    for row in table.rows:
        cells = [_text(cell, c.kind) for cell, c in zip(row, table.columns)]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"
