"""What the page's template shows: tables as cells with text, sort key and hover text; sections and their blocks."""
import json
import re

from markupsafe import Markup

from ulpgate_report.tables import cell_text
from ulpgate_report.values import numbers

ARGUMENT_DIGITS = 13


def _sort_key(value, kind):
    """What the page sorts by; numbers first, null last."""
    if value is None:
        return ""
    if kind in cell_text.NUMERIC_KINDS:
        if value != value:
            return ""
        infinite = value in (numbers.INFINITE, -numbers.INFINITE)
        return ("-" * (value < 0) + "Infinity") if infinite else repr(value)
    return None


def _cell_view(cell, kind):
    value, mark = cell_text.value_and_mark(cell)
    # A command is there to be copied: whole, in a box that scrolls.
    digits = None if kind == "command" else ARGUMENT_DIGITS
    text = cell_text.short(cell, kind, digits)
    whole = cell_text.short(cell, kind) if kind == "arguments" else None
    return {
        "text": text,
        "key": _sort_key(value, kind),
        "title": whole if whole != text else None,
        "mark": mark,
        "numeric": kind in cell_text.NUMERIC_KINDS,
        "code": kind in cell_text.CODE_KINDS,
        "boxed": kind == "command",
        "prose": kind == "prose",
        "style": None,
        "href": None,
        "anchor": None,
        "command": None,
        "row": None,
    }


def table_view(table):
    """A table for the template."""
    kinds = [column.kind for column in table.columns]
    return {
        "name": table.name,
        "caption": table.caption,
        "columns": [
            {"title": c.title, "numeric": c.kind in cell_text.NUMERIC_KINDS}
            for c in table.columns
        ],
        "rows": [
            [_cell_view(c, kind) for c, kind in zip(row, kinds)] for row in table.rows
        ],
    }


def cells_by_type(groups, tokens):
    """The cells of a matrix for `heat_view`: a line for each {type: cell}, None where there is none."""
    return [[of_type.get(token) for token in tokens] for of_type in groups]


def cells_of(combined):
    """The cells (row, type, what was measured) of what is combined by row and type, for `heat_view`."""
    return [
        [
            (row, token, combined.cells[row, token])
            if (row, token) in combined.cells
            else None
            for token in combined.type_tokens
        ]
        for row in combined.rows
    ]


def heat_view(table, cells, value_of, hover, scale, link=None, command=None, row=None):
    """A matrix with colours and hover text; `cells` has a line of cells for each row of the table.

    `link` gives the anchor on the page that a cell leads to.  With `command` a cell opens: what hovers, the command that
    shows it, and, with `row`, the distribution of that name.
    """
    view = table_view(table)
    for line, shown_line in zip(cells, view["rows"]):
        for cell, shown in zip(line, shown_line[1:]):
            if cell is None:
                continue
            shown["title"] = hover(cell)
            value = value_of(cell)
            if value is not None:
                back, front = scale.background(value), scale.foreground(value)
                shown["style"] = f"background:{back};color:{front}"
            if link is not None:
                shown["href"] = link(cell)
            if command is not None:
                shown["command"] = command(cell)
                shown["row"] = row and row(cell)
    return view


def anchor_rows(view, names):
    """Give each row of a table the anchor that cells of others lead to."""
    for row, name in zip(view["rows"], names, strict=True):
        row[0]["anchor"] = name


def table(view, none_text="None."):
    """A block: a table, or a sentence where it has no row."""
    if view["rows"]:
        return {"kind": "table", "view": view}
    return note(none_text)


def details(view, noun):
    """A block: a long table that is opened by a click."""
    summary = f"{len(view['rows'])} {noun}"
    return {"kind": "details", "summary": summary, "view": view}


def note(text):
    """A block: a sentence."""
    return {"kind": "note", "text": text}


def _inline_svg(name, text):
    """The svg element alone: no prolog, and no metadata, whose links nobody follows.

    Its ids get the figure's name before them: those of two figures would be the same.
    """
    element = text[text.index("<svg") :]
    element = re.sub(r"<metadata>.*?</metadata>", "", element, flags=re.DOTALL)
    prefix = re.sub(r"[^A-Za-z0-9_.-]", "-", name) + "-"
    return Markup(re.sub(r'(\bid="|href="#|url\(#)', rf"\g<1>{prefix}", element))


def _height(svg):
    """The height that a figure was drawn with, as CSS takes it; nothing where it has none."""
    found = re.search(r'<svg[^>]*\bheight="([0-9.]+(?:pt|px|in|cm|mm))"', svg)
    return found.group(1) if found else ""


def figures(drawn, family, title, none_text):
    """Blocks: every drawn figure whose name is `family` or starts with it and `_`, or a sentence."""
    found = [
        {
            "kind": "figure",
            "title": title,
            "svg": _inline_svg(name, svg),
            "tall": _height(svg),
            "caption": caption,
        }
        for name, (svg, caption) in drawn.items()
        if name == family or name.startswith(f"{family}_")
    ]
    return found or [note(none_text)]


def section(name, title, *blocks):
    """A section of the page; `name` is its anchor."""
    return {"name": name, "title": title, "blocks": list(blocks)}


def shown(value):
    """Anything of a context as one text."""
    if isinstance(value, dict):
        return ", ".join(f"{name} {shown(value[name])}" for name in sorted(value))
    if isinstance(value, list):
        return ", ".join(map(str, value))
    return value if isinstance(value, str) else json.dumps(value)
