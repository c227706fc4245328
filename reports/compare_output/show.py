"""What was found, as text for people and as JSON for programs."""
import json
import math


def _digits(d):
    if d is None:
        return "-"
    return " ".join(
        f"{x:4.1f}" if math.isfinite(x) else " all"
        for x in (d.least, d.one_percent, d.median)
    )


def _number(x):
    return "-" if x is None else f"{x:.3g}"


def _row(f, with_wide):
    verdict = "ignored" if f.limit.kind == "noise" else "FAIL" if f.failed else "ok"
    held = f.limit.text
    if f.limit.kind == "derived":
        held = f"derived:{_number(f.allowed)}"
    cells = [
        f.name,
        verdict,
        held,
        _number(f.measured),
        str(f.different),
        _digits(f.digits),
    ]
    if with_wide:
        cells += [_digits(f.digits_ref), _digits(f.digits_out), f.whose or "-"]
    return cells


def _table(rows):
    widths = [max(len(r[i]) for r in rows) for i in range(len(rows[0]))]
    return [
        "  ".join(c.ljust(w) for c, w in zip(r, widths, strict=True)).rstrip()
        for r in rows
    ]


def _listed(names, most=5):
    shown = ", ".join(names[:most])
    return shown + (f" and {len(names) - most} more" if len(names) > most else "")


def _of_comparison(c, lines):
    with_wide = c.wide is not None
    rows = len(c.matched.rows[0])
    by = f"by {', '.join(c.matched.key)}" if c.matched.key else "by their place"
    title = f"{c.name}: " if c.name else ""
    lines.append(f"{title}{rows} rows, matched {by}")
    head = [
        "field",
        "verdict",
        "held to",
        "measured",
        "differ",
        "digits of REF and OUT",
    ]
    second = ["", "", "", "", "", "least 1 % median"]
    if with_wide:
        head += ["REF and WIDE", "OUT and WIDE", "whose error"]
        second += ["least 1 % median", "least 1 % median", ""]
    if c.fields:
        lines += [
            "  " + t
            for t in _table([head, second] + [_row(f, with_wide) for f in c.fields])
        ]
    for who, names in (("REF", c.only_in_ref), ("OUT", c.only_in_out)):
        if names:
            lines.append(
                f"  FAIL only {who} has the field{'s' * (len(names) > 1)} {_listed(names)}"
            )
    for who, names in zip(("REF", "OUT"), c.matched.only_in, strict=False):
        if names:
            lines.append(f"  FAIL only {who} has {_listed(names)}")
    for f in c.fields:
        if f.not_finite:
            lines.append(
                f"  {f.name}: NaN or infinite in one and not in the other: {f.not_finite} values"
            )
        if (
            f.whose == "REF"
            and f.digits_ref is not None
            and math.isfinite(f.digits_ref.median)
        ):
            lines.append(
                f"  {f.name}: beyond its {f.digits_ref.median:.1f} digits (median; {f.digits_ref.least:.1f} at the worst) "
                "what REF holds is its own error"
            )
    parting = c.first_parting()
    if parting:
        row, fields = parting
        lines.append(f"  first record that parts: {c.row_name(row)}")
        for f in fields:
            for who, value, where in c.values_at(f.column, row):
                lines.append(f"    {f.name:<12} {who:<4} {value}  ({where})")


def summary(pairs):
    """One line: what of how much failed."""
    fields = [f for p in pairs for c in p.comparisons for f in c.fields]
    failed = [f.name for f in fields if f.failed]
    rest = [
        what
        for p in pairs
        for c in p.comparisons
        for what in (c.only_in_ref, c.only_in_out, *c.matched.only_in[:2])
        if what
    ]
    missing = sum(bool(p.missing) for p in pairs)
    text = f"{len(fields)} fields in {len(pairs)} file{'s' * (len(pairs) != 1)}: "
    found = []
    if failed:
        found.append(f"{len(failed)} beyond their limit ({_listed(failed)})")
    if rest:
        found.append("rows or fields that only one has")
    if missing:
        found.append(f"{missing} files that only one has")
    return text + ("; ".join(found) if found else "all within their limits")


def text_of(pairs):
    lines = [f"compare-output: {summary(pairs)}"]
    for p in pairs:
        lines.append("")
        lines.append(
            f"REF {p.ref}  OUT {p.out}" + (f"  WIDE {p.wide}" if p.wide else "")
        )
        if p.missing:
            lines.append(f"  FAIL {p.missing}")
        for c in p.comparisons:
            _of_comparison(c, lines)
    return "\n".join(lines)


def _json_number(x):
    if x is None or math.isnan(x):
        return None
    return x if math.isfinite(x) else "inf"


def _json_digits(d):
    if d is None:
        return None
    of = {k: getattr(d, k) for k in ("least", "one_percent", "median")}
    return {k: x if math.isfinite(x) else "all" for k, x in of.items()}


def json_of(pairs):
    out = []
    for p in pairs:
        for c in p.comparisons:
            for f in c.fields:
                out.append(
                    {
                        "ref": str(p.ref),
                        "out": str(p.out),
                        "wide": str(p.wide) if p.wide else None,
                        "field": f.name,
                        "rows": f.rows,
                        "limit": f.limit.text,
                        "failed": f.failed,
                        "measured": _json_number(f.measured),
                        "allowed": _json_number(f.allowed),
                        "different": f.different,
                        "not_finite": f.not_finite,
                        "digits": _json_digits(f.digits),
                        "digits_ref": _json_digits(f.digits_ref),
                        "digits_out": _json_digits(f.digits_out),
                        "whose_error": f.whose or None,
                    }
                )
    return json.dumps({"summary": summary(pairs), "fields": out}, indent=2)
