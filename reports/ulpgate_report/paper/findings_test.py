"""Tests of the findings: what they say, and the commands that show it."""
import csv
import json

import pytest

from ulpgate_report.math import combine
from ulpgate_report.paper import findings, fragments, reproduce, tables
from ulpgate_report.records import records
from ulpgate_report.records.errors import InvalidInput
from ulpgate_report.testing import sample_records


def _claim(**changed):
    found = {"function": "remainder", "type": "double", "symbol": "remainder"}
    found |= {"implementation": "libm.so.6 remainder", "claim_ulp": 0.5}
    found |= {
        "arguments": 1000,
        "largest_ulp": 0.0,
        "args": ["0x1p+0"],
        "holds": False,
        "mismatches": [],
    }
    return found | changed


def test_a_command_shows_what_is_wrong_and_not_the_largest_error():
    wrong = [
        {"outcome": "lane_dependent", "count": 2, "args": ["0x1p+9"]},
        {"outcome": "zero_sign", "count": 1, "args": ["-0x1p-3"]},
    ]
    (found,) = findings.of_claims([_claim(mismatches=wrong)])
    assert found.says == (
        "gives another result beside other lanes at 2 arguments; gives a zero with the wrong sign at 1 argument"
    )
    assert found.command.startswith("ulpgate at remainder double -0x1p-3 --library")
    (found,) = findings.of_claims([_claim(mismatches=wrong, largest_ulp=3.0)])
    assert found.says.startswith("errs by 3.00 ULP where 0.5 is documented; gives")
    assert " 0x1p+0 --library" in found.command


def test_claims_say_where_they_are_made():
    domains = [[-709.0, 709.0]], [], [[None, 26.2]], [[1.0, None]]
    found = tables.claims([_claim(domain=domain) for domain in domains])
    told = ["-709, 709", None, "-inf, 26.2", "1, inf"]
    assert [row[3] for row in found.rows] == told


def test_a_finding_of_another_library_is_called_there():
    context = sample_records.context(["lgamma"])
    context["plan_text"] = "".join(
        f"code {entry[0]} lgamma --library libsleef.so.3 --symbol Sleef_x path=/usr/lib/libsleef.so.3.5.1 soname=libsleef.so.3\n"
        for entry in sample_records.TYPES
    )
    rows = sample_records.math_records(context)
    for row in rows:
        row["implementation"] = "libsleef.so.3.5.1 Sleef_x"
    run = combine.combine_run(records.Run(context, rows, {}))
    found = findings.of_functions(run)
    assert found
    for one in found:
        assert (one.library, one.subject) == ("libsleef.so.3.5.1", "Sleef_x")
        assert one.command.endswith(" --library libsleef.so.3 --symbol Sleef_x")
    same = _claim(
        implementation="libsleef.so.3.5.1 Sleef_x", symbol="Sleef_x", largest_ulp=9.0
    )
    documented = findings.of_claims([same | {"type": found[0].type}])
    left = findings.beyond(found, documented)
    assert [f.type for f in left] == [f.type for f in found[1:]]


def _program(place, point):
    """A program that shows this point, whatever is asked."""
    program = place / "ulpgate"
    program.write_text(f"#!/bin/sh\necho '{json.dumps(point)}'\n")
    program.chmod(0o755)
    return program


@pytest.mark.parametrize(
    "point, is_told",
    [
        ({"outcome": "finite", "ulp_error": 8556.5}, True),
        ({"outcome": "finite", "ulp_error": 0.5}, False),
        ({"outcome": "nan", "ulp_error": None}, False),
        ({"outcome": ["finite", "finite"], "ulp_error": [0.0, 8556.5]}, True),
    ],
)
def test_a_finding_is_shown_again_or_named(tmp_path, point, is_told):
    out = tmp_path / "paper"
    (found,) = findings.of_claims([_claim(largest_ulp=8556.5)])
    (out / "data").mkdir(parents=True)
    with open(out / findings.FILE, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["says", "command"])
        writer.writerow([found.says, found.command])
        writer.writerow(["a run", "ulpgate scene ladder pendulum3"])
    count, wrong = reproduce.run(_program(tmp_path, point), out, tmp_path)
    assert (count, len(wrong)) == (1, 0 if is_told else 1)
    assert is_told or found.command in wrong[0]


def test_a_command_that_shows_nothing_is_named(tmp_path):
    (tmp_path / "data").mkdir()
    (tmp_path / findings.FILE).write_text(
        "says,command\nerrs by 2 ULP,ulpgate at sin double 1\n"
    )
    program = tmp_path / "ulpgate"
    program.write_text("#!/bin/sh\necho 'no such function' >&2\nexit 2\n")
    program.chmod(0o755)
    _, (wrong,) = reproduce.run(program, tmp_path, tmp_path)
    assert wrong == "ulpgate at sin double 1: no such function"
    with pytest.raises(InvalidInput):
        reproduce.run(tmp_path / "none", tmp_path, tmp_path)


def test_symbols_of_a_function_are_told_together():
    made = findings.of_claims(
        _claim(symbol=symbol, largest_ulp=error, implementation=f"libx.so {symbol}")
        for symbol, error in (("remainder_a", 2.0), ("remainder_b", 8.0))
    )
    text = fragments.findings(findings.by_library(made))
    (line,) = [one for one in text.splitlines() if one.startswith(r"\item")]
    assert line.startswith(
        r"\item \texttt{remainder\char95{}b} (double): errs by 8.00 ULP"
    )
    assert line.endswith(r"Something of the kind: \texttt{remainder\char95{}a}.")
