"""The tables of the integrators' orders as plain data."""
from ulpgate_report.integrators import orders
from ulpgate_report.tables.table import Column, Table, columns_of
from ulpgate_report.values import numbers

_PROBLEM = Column("problem", "problem", "code")
_INTEGRATOR = Column("integrator", "integrator", "code")
_TYPE = Column("type", "type", "code")
_ORDER = Column("order", "order", "real")


def order_table(pendulum):
    """The order of each integrator in theory and as measured, and how far down its error comes."""
    bits, rows = pendulum.bits, []
    for one in orders.convergences(pendulum.orders):
        unit = orders.unit_roundoff(one.type, bits)
        rows.append(
            (
                one.problem,
                one.integrator,
                one.type,
                one.order,
                None if one.measured is None else round(one.measured, 4),
                one.points[-1][0] if one.points else None,
                one.smallest,
                None
                if None in (one.smallest, unit)
                else float(f"{one.smallest / unit:.3g}"),
                "yes" if one.floor is not None else "no",
            )
        )
    columns = (
        _PROBLEM,
        _INTEGRATOR,
        _TYPE,
        _ORDER,
        *columns_of(
            "real",
            measured_order="measured",
            smallest_dt="smallest step",
            smallest_error="smallest error",
            smallest_error_u="in units u",
        ),
        Column("floor", "floor reached", "text"),
    )
    caption = (
        "Order of each integrator in theory and as measured on a problem with a known solution: the median over the four "
        "smallest steps whose error is clear of the rounding floor. The smallest error is also given in units of the "
        "roundoff u = 2^-p with p significand bits; the floor is reached where the last step lowers the error by less "
        "than half the order."
    )
    return Table("order_table", caption, columns, tuple(rows))


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
