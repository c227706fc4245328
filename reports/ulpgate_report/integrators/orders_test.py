"""Tests of the measured orders: the floor found, the growing roundings beyond it left out, nothing to measure."""
import math

import pytest

from ulpgate_report.integrators import orders, tables
from ulpgate_report.records import pendulum_records
from ulpgate_report.testing import sample_pendulum


def rows(errors, order=4, **changes):
    """Lines of orders.jsonl of halved steps."""
    found, before = [], None
    for halving, error in enumerate(errors):
        usable = all(isinstance(e, float) and e > 0 for e in (before, error))
        row = {
            "what": "order",
            "integrator": "rule",
            "order": order,
            "type": "double",
            "problem": "kepler",
            "dt": 0.5**halving,
            "steps": 2**halving,
            "error": error,
            "measured_order": math.log2(before / error) if usable else None,
        }
        found.append({**row, **changes})
        before = error
    return found


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
        ([0.0, 0.0], None, None, "exact"),
        (["inf"], None, None, "nothing finite"),
    ],
)
def test_convergence(errors, measured, floor, why):
    (found,) = orders.convergences(rows(errors))
    assert found.measured == (measured and pytest.approx(measured)), why
    assert found.floor == floor, why


def test_order_of_the_lines_does_not_matter():
    given = rows(FALLING)
    assert orders.convergences(given) == orders.convergences(given[::-1])


def test_sample_shows_its_orders():
    found = orders.convergences(sample_pendulum.order_records())
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
    run = pendulum_records.PendulumRun("", orders=tuple(rows(FALLING + [2e-9])))
    pendulum = pendulum_records.Pendulum((run,))
    (
        (problem, name, token, order, measured, dt, error, units, floor),
    ) = tables.order_table(pendulum).rows
    assert (problem, name, token, order) == ("kepler", "rule", "double", 4)
    assert (measured, dt, error, floor) == (4, 2.0**-8, 2e-9, "yes")
    assert units == pytest.approx(2e-9 / 2.0**-53, rel=1e-2)
    assert len(tables.order_records(pendulum).rows) == 9


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
