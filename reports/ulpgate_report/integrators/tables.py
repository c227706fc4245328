"""The tables of the integrators' orders as plain data."""
from ulpgate_report.integrators import orders, wording
from ulpgate_report.tables.table import Column, Table, columns_of
from ulpgate_report.values import numbers

_PROBLEM = Column("problem", "problem", "code")
_INTEGRATOR = Column("integrator", "integrator", "code")
_TYPE = Column("type", "type", "code")
_ORDER = Column("order", "order", "real")


class _Hundredths(float):
    """A number that every format shows with two decimals, as many as tell orders apart; it sorts as what it is."""

    def __str__(self):
        return f"{float(self):.2f}"


def _order_row(one, bits):
    unit = orders.unit_roundoff(one.type, bits)
    reached, dt = one.smallest, one.smallest_dt
    return [
        one.problem,
        one.integrator,
        one.type,
        one.order,
        None if one.measured is None else _Hundredths(one.measured),
        one.pairs or None,
        reached,
        None if None in (reached, unit) else float(f"{reached / unit:.3g}"),
        None if dt is None else wording.power_of_two(dt),
        "yes" if one.floor is not None else "no",
    ]


def order_table(pendulum):
    """The order of each integrator in theory and as measured, and how far down its error comes."""
    bits = pendulum.bits
    found = orders.convergences(pendulum.orders, bits)
    columns = [
        _PROBLEM,
        _INTEGRATOR,
        _TYPE,
        _ORDER,
        # These two kinds show three digits and what a number says of itself.
        Column("measured_order", "measured", "count"),
        Column("measured_pairs", "pairs", "count"),
        Column("smallest_error", "smallest error", "ulp"),
        Column("smallest_error_u", "in units u", "ulp"),
        Column("smallest_error_dt", "at the step", "code"),
        Column("floor", "floor reached", "text"),
    ]
    rows = [_order_row(one, bits) for one in found]
    types, said = {one.type for one in found}, ""
    # A column that says the same in every row is a word of the caption.
    if len(types) == 1:
        said = f" in {found[0].type}"
        place = columns.index(_TYPE)
        for line in (columns, *rows):
            del line[place]
    caption = (
        f"Order of each integrator in theory and as measured{said} on a problem with a known solution: the median over "
        f"at most {orders.POINTS} pairs of neighbouring steps, the smallest whose errors are clear of roundings, that is above "
        f"{orders.CLEAR} u and {orders.CLEAR} times the floor; -: no such pair; one alone is of large steps, where the limit is not reached. {wording.ends(pendulum.orders)}The smallest error "
        "is of the largest step that has it, and also given in units of the roundoff u = 2^-p with p significand bits; the "
        f"floor is reached where it is at most {orders.ROUNDINGS} u, or the last step lowers the error by less than half the order."
    )
    return Table("order_table", caption, tuple(columns), tuple(map(tuple, rows)))


def drift_table(pendulum):
    """Every line of drift.jsonl: whether an integrator keeps the energy, by problem, type and the table of integrators."""
    tokens = pendulum.type_tokens
    found = sorted(
        pendulum.drifts, key=lambda r: (r["problem"], tokens.index(r["type"]))
    )
    rows = [
        (
            row["problem"],
            row["integrator"],
            row["type"],
            row["dt"],
            row["t_end"],
            numbers.signed(row["max_energy_error"]),
            numbers.signed(row["energy_slope"]),
        )
        for row in found
    ]
    columns = (
        _PROBLEM,
        _INTEGRATOR,
        _TYPE,
        *columns_of(
            "real",
            dt="step",
            t_end="end",
            max_energy_error="largest energy error",
            energy_slope="slope",
        ),
    )
    caption = (
        "Largest error of the energy along a problem with a known one, and the slope of the logarithm of the error "
        "against that of time: 0 where the error of a symplectic method stays within bounds, about 1/2 for unbiased "
        "roundings (Brouwer's law), 1 for an error that grows steadily."
    )
    return Table("drift_table", caption, columns, tuple(rows))


def order_records(pendulum):
    """Every line of orders.jsonl."""
    fields = ("problem", "integrator", "type", "order", "dt", "steps")
    found = sorted(
        pendulum.orders,
        key=lambda r: (
            r["problem"],
            r["order"],
            r["integrator"],
            pendulum.type_tokens.index(r["type"]),
            -r["dt"],
        ),
    )
    rows = [
        (
            *(row[name] for name in fields),
            numbers.signed(row["error"]),
            numbers.signed(row["measured_order"]),
        )
        for row in found
    ]
    columns = (
        _PROBLEM,
        _INTEGRATOR,
        _TYPE,
        _ORDER,
        Column("dt", "step", "real"),
        Column("steps", "steps", "count"),
        *columns_of("real", error="error", measured_order="measured order"),
    )
    caption = "Every error of an integrator on a problem with a known solution."
    return Table("order_records", caption, columns, tuple(rows))
