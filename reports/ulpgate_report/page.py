"""The page: one self-contained HTML file with the tables, the heat map, the figures and the distributions."""
import json
import re
from pathlib import Path

import jinja2
from markupsafe import Markup

from ulpgate_report import cell_text, figure_style, heat_colours, numbers, tables

_TEMPLATES = Path(__file__).resolve().parent / "templates"
ARGUMENT_DIGITS = 13
# Inline figures; the heat map and the distributions are drawn by the page itself.
_INLINE_FIGURES = (("error_vs_time", "Error against time"),)


def _sort_key(value, kind):
    """What the page sorts by; numbers first, null last."""
    if value is None:
        return ""
    if kind in cell_text.NUMERIC_KINDS:
        return "Infinity" if value == numbers.INFINITE else repr(value)
    return None


def _cell_view(cell, kind):
    value, mismatches = cell_text.value_and_mark(cell)
    text = cell_text.short(cell, kind, ARGUMENT_DIGITS)
    whole = cell_text.short(cell, kind) if kind == "arguments" else None
    return {
        "text": text,
        "key": _sort_key(value, kind),
        "title": whole if whole != text else None,
        "mismatches": mismatches,
        "numeric": kind in cell_text.NUMERIC_KINDS,
        "code": kind in ("code", "arguments"),
        "style": None,
    }


def _table_view(table):
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


def _hover(row, token, cell):
    lines = [f"{row.label}, {token}: {numbers.short_ulp(cell.max_ulp)} ULP"]
    if cell.argmax:
        lines.append(f"at {', '.join(cell.argmax)} ({cell.stratum})")
    lines.append(
        f"p99 {numbers.short_ulp(cell.p99_ulp)}, mean {numbers.short_ulp(cell.mean_ulp)}, "
        f"{cell.correctly_rounded} of {cell.judged} correctly rounded"
    )
    lines += [f"{name}: {count}" for name, count in cell.mismatch.items()]
    return "\n".join(lines)


def _heat_view(combined):
    """The matrix of maximum errors with colours and hover text."""
    view = _table_view(tables.ulp_matrix(combined))
    for row, line in zip(combined.rows, view["rows"]):
        for token, shown in zip(combined.type_tokens, line[1:]):
            cell = combined.cells.get((row, token))
            if cell is None:
                continue
            shown["title"] = _hover(row, token, cell)
            if cell.max_ulp is not None:
                back = heat_colours.background(cell.max_ulp)
                front = heat_colours.foreground(cell.max_ulp)
                shown["style"] = f"background:{back};color:{front}"
    return view


def _distributions(combined):
    """What the page draws: per row and type the judged and exact counts and the buckets, types by index."""
    found = {}
    for row in combined.rows:
        curves = {}
        for index, token in enumerate(combined.type_tokens):
            cell = combined.cells.get((row, token))
            if cell is not None and cell.judged:
                curves[index] = [cell.judged, cell.exact_count, list(cell.buckets)]
        if curves:
            found[row.label] = curves
    types = [
        {"token": token, "colour": figure_style.colour(index)}
        for index, token in enumerate(combined.type_tokens)
    ]
    return {"types": types, "curves": found}


def _inline_svg(text):
    """The svg element alone: no prolog, and no metadata, whose links nobody follows."""
    element = text[text.index("<svg") :]
    return re.sub(r"<metadata>.*?</metadata>", "", element, flags=re.DOTALL)


def _shown(value):
    if isinstance(value, dict):
        return ", ".join(f"{name} {shown}" for name, shown in sorted(value.items()))
    if isinstance(value, list):
        return ", ".join(map(str, value))
    return value if isinstance(value, str) else json.dumps(value)


def _context_view(context):
    """(name, text) of everything in the context but the two long lists."""
    order = ("tool", "plan", "seed", "complete", "shards", "samples", "strata")
    order += ("compiler", "flags", "build_type", "libraries", "cpu", "threads")
    rest = sorted(set(context) - set(order) - {"types", "functions"})
    names = [name for name in (*order, *rest) if name in context]
    return [(name.replace("_", " "), _shown(context[name])) for name in names]


def _types_view(combined):
    fields = ("token", "cpp_type", "total_bits", "decimal_places", "exponent_bits")
    fields += ("significand_bits", "reference_bits")
    rows = [
        [_shown("-" if entry.get(f) is None else entry[f]) for f in fields]
        for entry in combined.types
    ]
    return {"columns": [f.replace("_", " ") for f in fields], "rows": rows}


def render(combined, drawn):
    """The whole page; `drawn` has the SVG text and caption of each figure by name."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(_TEMPLATES),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    # Jinja would sort the keys; the functions stay in display order.
    environment.policies["json.dumps_kwargs"] = {}
    figures = [
        {
            "title": title,
            "caption": drawn[name][1],
            "svg": Markup(_inline_svg(drawn[name][0])),
        }
        for name, title in _INLINE_FIGURES
        if name in drawn
    ]
    cells = combined.cells.values()
    disagreed = sum(cell.oracle_disagreed for cell in cells)
    return environment.get_template("page.html.j2").render(
        context=_context_view(combined.context),
        complete=combined.context["complete"],
        samples=sum(cell.samples for cell in cells),
        mismatches=sum(cell.mismatches for cell in cells),
        oracle_compared=sum(cell.oracle_compared for cell in cells),
        oracle_disagreed=disagreed,
        timed=bool(combined.time_ns),
        types=_types_view(combined),
        heat=_heat_view(combined),
        paper=_table_view(tables.paper_table(combined)),
        ulp=_table_view(tables.ulp_table(combined)),
        mismatch=_table_view(tables.mismatch_table(combined)),
        long=_table_view(tables.long_table(combined)),
        figures=figures,
        distributions=_distributions(combined),
    )
