"""Tests of the measured orders: the floor found, roundings left out, nothing to measure; and of the tables of them."""
import math

import pytest

from ulpgate_report.integrators import orders, tables
from ulpgate_report.records import pendulum_records
from ulpgate_report.testing import sample_pendulum

BITS, order_rows = sample_pendulum.BITS, sample_pendulum.order_rows
U = 2.0 ** -BITS["double"]


def tabled(lines):
    """The table of orders of these lines, and its rows as {name of the column: cell}."""
    run = pendulum_records.PendulumRun("", orders=tuple(lines))
    table = tables.order_table(pendulum_records.Pendulum((run,)))
    names = [column.name for column in table.columns]
    return table, [dict(zip(names, row)) for row in table.rows]


FALLING = [16.0**-n for n in range(8)]


@pytest.mark.parametrize(
    "errors, measured, floor, why",
    [
        (FALLING, 4, None, "no floor in sight"),
        ([8.0**-n for n in range(8)], 3, None, "not the order in theory"),
        (FALLING + [FALLING[-1]], 4, FALLING[-1], "it stopped falling"),
        (FALLING + [1e-8, 3e-8, 9e-8], 4, FALLING[-1], "roundings grow"),
        (
            FALLING + [1e-6 * 1.5**n for n in range(40)],
            4,
            FALLING[-1],
            "and grow far",
        ),
        ([1.0, 1.0, 1.0, 1.0], None, 1.0, "nothing falls"),
        ([1.0], None, None, "one step"),
        (["inf", "nan", None, *FALLING], 4, None, "the largest steps broke down"),
        ([1e-9, 1e-9 / 16, 90 * U], 4, None, "90 u are roundings without a floor"),
        ([540 * U, U], None, U, "one pair, and it ends in a rounding"),
        ([1e-9, 1e-9 / 16, 4 * U], 4, 4 * U, "4 u are the floor, falling or not"),
        ([2400 * U, 150 * U, 2 * U], 4, 2 * U, "150 u are clear of 2 u"),
        ([1e-9, 1e-9 / 16, 0.0], 4, 0.0, "exact at last"),
        ([60 * U, 1e-9, 1e-9 / 16, 50 * U], 4, None, "of a pair both are clear"),
        ([1e-9, 0.0], None, 0.0, "one error that is not exact"),
        ([0.0, 0.0], None, 0.0, "exact"),
        (["inf"], None, None, "nothing finite"),
    ],
)
def test_convergence(errors, measured, floor, why):
    (found,) = orders.convergences(order_rows(errors), BITS)
    assert found.measured == (measured and pytest.approx(measured)), why
    assert found.floor == floor, why


def test_what_is_clear_does_not_hang_on_the_last_roundings():
    one, other = (
        orders.convergences(order_rows([1e-9, 4e-12, 170 * U, n * U], order=8), BITS)[0]
        for n in (1, 2)
    )
    assert one.clear == other.clear and len(one.clear) == 3


def test_smallest_error_has_its_step():
    (found,) = orders.convergences(order_rows([1e-9, 1e-12, 1e-12, 3e-12]), BITS)
    assert (found.smallest, found.smallest_dt) == (1e-12, 0.5)
    (exact,) = orders.convergences(order_rows([1e-9, 0.0, 0.0]), BITS)
    assert (exact.smallest, exact.smallest_dt) == (0, 0.5)
    assert exact.drawn == ((1.0, 1e-9),) and len(exact.points) == 3


def test_type_without_known_bits_has_the_floor_of_its_errors():
    lines = order_rows(FALLING + [FALLING[-1]], type="mpfr62")
    (found,) = orders.convergences(lines, {})
    assert (found.measured, found.floor) == (4, FALLING[-1])


def test_order_of_the_lines_does_not_matter():
    given = order_rows(FALLING)
    assert orders.convergences(given, BITS) == orders.convergences(given[::-1], BITS)


def test_sample_shows_its_orders():
    found = orders.convergences(sample_pendulum.order_records(), BITS)
    assert len(found) == 3 * len(sample_pendulum.INTEGRATORS)
    for one in found:
        assert one.measured == pytest.approx(one.order, abs=0.05), one


@pytest.mark.parametrize(
    "token, bits, expected, why",
    [
        ("double", {"double": 53}, 2.0**-53, "known"),
        ("mpfr62", {}, None, "not known"),
        ("mpfr1000", {"mpfr1000": 3322}, None, "below what a record can hold"),
    ],
)
def test_unit_roundoff(token, bits, expected, why):
    assert orders.unit_roundoff(token, bits) == expected, why


def test_tables_of_orders():
    lines = order_rows(FALLING + [2e-9])
    table, (row,) = tabled(lines)
    assert " in double " in table.caption and "type" not in row
    assert (row["problem"], row["integrator"], row["order"]) == ("kepler", "rule", 4)
    assert (str(row["measured_order"]), row["measured_pairs"]) == ("4.00", 4)
    assert (row["smallest_error"], row["floor"]) == (2e-9, "yes")
    assert row["smallest_error_dt"] == "2^-8"
    assert row["smallest_error_u"] == pytest.approx(2e-9 / U, rel=1e-2)
    run = pendulum_records.PendulumRun("", orders=tuple(lines))
    found = tables.order_records(pendulum_records.Pendulum((run,)))
    assert len(found.rows) == 9


def test_table_of_several_types_names_them():
    table, found = tabled([*order_rows(FALLING), *order_rows(FALLING, type="float128")])
    assert [row["type"] for row in found] == ["double", "float128"]
    assert " in double " not in table.caption


def test_table_has_errors_of_0():
    _, (row,) = tabled(order_rows([1e-9, 0.0]))
    assert (row["smallest_error"], row["smallest_error_u"]) == (0, 0)
    assert (row["smallest_error_dt"], row["floor"]) == ("2^-1", "yes")
    assert row["measured_order"] is None and row["measured_pairs"] is None


def test_table_says_where_the_runs_end():
    lines = order_rows(FALLING, t_end=1.0) + order_rows(
        FALLING, 1, integrator="e", t_end=2.0**-19
    )
    table, _ = tabled(lines)
    assert "end time differs by order: 2^-19 for order 1 and 1 for" in table.caption


def test_table_of_energies():
    lines = sample_pendulum.drift_records()
    lines[0]["max_energy_error"] = "inf"
    run = pendulum_records.PendulumRun("", drifts=tuple(reversed(lines)))
    found = tables.drift_table(pendulum_records.Pendulum((run,))).rows
    assert len(found) == len(lines)
    assert [row[2] for row in found] == sorted(row[2] for row in found), "by type"
    assert [row[5] for row in found if row[1] == lines[0]["integrator"]][0] == math.inf
    slopes = {row[2]: row[6] for row in found}
    assert slopes == {"double": None, "mpfr62": 0}
