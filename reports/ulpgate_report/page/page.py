"""The page: one self-contained HTML file with the tables, figures and distributions of every kind of record."""
from pathlib import Path

import jinja2

from ulpgate_report.page.page_views import shown

_TEMPLATES = Path(__file__).resolve().parent / "templates"


def _is_long_list(value):
    """Functions, kernels, types, planned rows: the page shows them as tables, or the tables name them anyway."""
    entries = value.values() if isinstance(value, dict) else value
    return isinstance(value, (dict, list)) and any(
        isinstance(one, dict) for one in entries
    )


def _context_view(context):
    """(name, text) of everything in the context but the long lists."""
    order = ("tool", "plan", "seed", "complete", "shards", "samples", "strata")
    order += ("compiler", "flags", "build_type", "libraries", "cpu", "threads")
    rest = sorted(set(context) - set(order))
    names = [
        name
        for name in (*order, *rest)
        if name in context and not _is_long_list(context[name])
    ]
    return [(name.replace("_", " "), shown(context[name])) for name in names]


def _machine_view(context):
    """One sentence: where the run was made, and of what."""
    libraries = context.get("libraries", {})
    named = [
        f"{name} {libraries[name]}"
        for name in ("glibc", "Boost", "MPFR")
        if name in libraries
    ]
    parts = [context.get("cpu"), ", ".join(named), context.get("compiler")]
    if "seed" in context:
        seed = context["seed"]
        # Of several runs each has its own; most have the same.
        seeds = dict.fromkeys(seed.values() if isinstance(seed, dict) else [seed])
        parts.append("seed " + ", ".join(str(one) for one in seeds))
    return "; ".join(part for part in parts if part)


def _types_view(context):
    fields = ("token", "cpp_type", "total_bits", "decimal_places", "exponent_bits")
    fields += ("significand_bits", "reference_bits")
    rows = [
        [shown("-" if entry.get(f) is None else entry[f]) for f in fields]
        for entry in context.get("types", ())
    ]
    return {"columns": [f.replace("_", " ") for f in fields], "rows": rows}


def render(context, headlines, sections, distributions=None):
    """The whole page; a headline is a list of (text, whether it alerts), a section comes from page_views."""
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
    return environment.get_template("page.html.j2").render(
        context=_context_view(context),
        complete=context.get("complete", True),
        machine=_machine_view(context),
        types=_types_view(context),
        headlines=headlines,
        sections=sections,
        distributions=distributions,
    )
