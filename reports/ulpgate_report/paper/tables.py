"""Tables that only the paper has: types, ours beside the published ones, what libraries claim."""
from ulpgate_report.paper import published
from ulpgate_report.tables.table import Column, Table, columns_of
from ulpgate_report.values import numbers


def types(context):
    """The types and what the machine holds of each."""
    fields = ("total_bits", "decimal_places", "exponent_bits", "significand_bits")
    fields += ("reference_bits",)
    rows = [
        (entry["token"], entry.get("cpp_type"), *(entry.get(f) for f in fields))
        for entry in context.get("types", ())
    ]
    columns = (
        Column("type", "type", "code"),
        Column("cpp_type", "C++ type", "code"),
        *columns_of("count", total_bits="bits", decimal_places="decimal places"),
        *columns_of("count", exponent_bits="exponent bits"),
        *columns_of("count", significand_bits="significand bits"),
        *columns_of("count", reference_bits="bits of RealHP<4>"),
    )
    caption = "The types under test; -: the type has its exponent outside the number and states no width of it."
    return Table("types", caption, columns, tuple(rows))


def beside_published(combined):
    """Largest errors of real functions: the published integer distance, ours by the same measure, and ours in ULP."""
    tokens = [t for t in published.LARGEST_DISTANCE if t in combined.type_tokens]
    rows = []
    for row in combined.rows:
        for token in tokens:
            theirs = published.LARGEST_DISTANCE[token].get(row.function)
            same = combined.paper_cells.get((row, token))
            every = combined.cells.get((row, token))
            if theirs is None or every is None:
                continue
            rows.append(
                (
                    row.label,
                    token,
                    theirs,
                    same and same.max_float_distance,
                    same and same.max_ulp,
                    every.max_ulp,
                    every.mismatches,
                )
            )
    order = {token: place for place, token in enumerate(tokens)}
    rows.sort(key=lambda one: order[one[1]])
    columns = (
        *columns_of("code", function="function", type="type"),
        Column("published", "theirs", "distance"),
        Column("distance", "ours, the same measure", "distance"),
        *columns_of("ulp", paper_ulp="ours (ULP)", max_ulp="all strata (ULP)"),
        Column("mismatches", "wrong kind", "count"),
    )
    caption = (
        "Largest errors beside the published ones (gcc 9.3, Boost 1.71, 2e7 arguments): the integer distance to the rounded reference over its two "
        "strata, the error in ULP against the unrounded reference over the same strata, and over all, with what is of the wrong kind there. "
        "Fewer arguments find smaller maxima as a rule: how many ours has is said at the end."
    )
    return Table("beside_published", caption, columns, tuple(rows))


def _domain(found):
    """Where a bound is documented; None of all arguments. Records have no infinity: an end that is none is null."""

    def end(value, beyond):
        return beyond if value is None else f"{value:g}"

    intervals = (f"{end(low, '-inf')}, {end(high, 'inf')}" for low, high in found or ())
    return "; ".join(intervals) or None


def _told(mismatch):
    return f"{mismatch['outcome'].replace('_', ' ')} {mismatch['count']}"


def claims(found):
    """Every row of a library's claims: what is documented and what was found."""
    rows = [
        (
            one["symbol"],
            one["function"],
            one["type"],
            _domain(one.get("domain")),
            one["claim_ulp"],
            numbers.measured(one["largest_ulp"]),
            ", ".join(_told(m) for m in one["mismatches"]) or None,
            one["arguments"],
            "holds" if one["holds"] else "violated",
        )
        for one in found
    ]
    columns = (
        *columns_of("code", symbol="symbol", function="function", type="type"),
        Column("domain", "arguments from, to", "text"),
        Column("claim_ulp", "claim (ULP)", "real"),
        Column("largest_ulp", "found (ULP)", "ulp"),
        Column("wrong", "wrong kind", "prose"),
        Column("arguments", "evaluations", "count"),
        Column("verdict", "verdict", "text"),
    )
    caption = (
        "Documented bounds, and the largest error found by strata and search. Of the wrong kind (with how many arguments) a zero for one of "
        "the smallest numbers counts as the error that it is, what depends on the other lanes is told alone, all else violates; a bound holds "
        "where no error is beyond it by more than a millionth."
    )
    return Table("claims", caption, columns, tuple(rows))
