"""Tests of what a terminal shows: lines of its width, colour where it is wanted, and in a pipe the bytes as they are."""

import fcntl
import os
import pathlib
import pty
import re
import struct
import subprocess
import sys
import termios

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

import program  # noqa: E402

ESCAPE = re.compile(r"\x1b\[[0-9;]*m")


def on_terminal(*words, columns=80, **variables):
    """Standard output of a run where that is a terminal of so many columns."""
    terminal, end = pty.openpty()
    fcntl.ioctl(end, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    env = {k: v for k, v in os.environ.items() if k != "NO_COLOR"}
    process = subprocess.Popen(
        program.command(*words),
        stdout=end,
        stderr=subprocess.DEVNULL,
        cwd=program.ROOT,
        env=env | {"TERM": "xterm"} | variables,
    )
    os.close(end)
    shown = program.all_of(terminal)
    process.wait()
    return shown.decode().replace("\r\n", "\n")


LISTS = ["functions", "types", "strata", "kernels", "scenes", "integrators"]


@pytest.mark.parametrize("what", LISTS)
@pytest.mark.parametrize("columns", [60, 80, 200])
def test_lists_fit_and_lose_nothing(what, columns):
    shown = on_terminal("list", what, columns=columns)
    assert max(len(line) for line in shown.splitlines()) <= columns
    code, piped, _ = program.run("list", what)
    assert code == 0 and shown.split() == piped.split()
    if columns == 200:
        assert shown == piped


JSON = [
    ["list", "functions", "--json"],
    ["at", "sin", "double", "1e22", "--json"],
    ["work-precision", "--subjects", "sin", "--types", "float", "--samples", "50"],
]


@pytest.mark.parametrize("words", JSON, ids=lambda words: words[0])
def test_json_is_not_broken(words):
    words = words if "--json" in words else [*words, "--repeats", "0", "--json"]
    code, piped, _ = program.run(*words)
    assert code == 0 and on_terminal(*words, columns=40) == piped


def test_what_goes_on_stands_below_its_column():
    lines = on_terminal("list", "integrators", columns=80).splitlines()
    at = next(i for i, line in enumerate(lines) if line.startswith("velocity_verlet"))
    column = lines[at].index("splitting")
    assert lines[at + 1][:column].strip() == "" and lines[at + 1][column] != " "


def test_help_fits_and_its_commands_stay_whole():
    shown = on_terminal("work-precision", "--help", columns=70)
    assert "--integrators leapfrog,yoshida8,gauss4 --types double,float128\n" in shown
    for line in shown.splitlines():
        # A name of an option and what it takes is one word, as is a command.
        assert len(line) <= 70 or "ulpgate " in line or line.startswith("  --"), line


@pytest.fixture(scope="module")
def failing(tmp_path_factory):
    """Records, and budgets that they break."""
    place = tmp_path_factory.mktemp("gate")
    plan = ["--functions", "exp", "--types", "double", "--samples", "200"]
    assert program.run("math", *plan, "--out", place / "now")[0] == 0
    gate = ["gate", str(place / "now"), "--budgets", str(place / "mine")]
    assert program.run(*gate, "--update")[0] == 0
    budget = place / "mine/double.toml"
    text = budget.read_text()
    low = re.sub(r"(?m)^(max_ulp = .* uniform = )[0-9.]+", r"\g<1>0.1", text)
    assert low != text
    budget.write_text(low)
    code, piped, err = program.run(*gate)
    assert code == 1, piped + err
    return gate, piped, err


def test_a_failure_is_red_on_a_terminal_alone(failing):
    gate, piped, err = failing
    assert "\x1b" not in piped + err
    shown = on_terminal(*gate, columns=5000)
    assert "\x1b[1;31mFAIL" in shown
    assert ESCAPE.sub("", shown) == piped


@pytest.mark.parametrize("variables", [{"NO_COLOR": "1"}, {"TERM": "dumb"}])
def test_no_colour_where_none_is_wanted(failing, variables):
    gate, piped, _ = failing
    assert on_terminal(*gate, columns=5000, **variables) == piped


def test_an_empty_no_color_asks_for_nothing(failing):
    assert "\x1b[" in on_terminal(*failing[0], NO_COLOR="")


def test_escapes_take_no_column(failing):
    gate, _, _ = failing
    lines = on_terminal(*gate, columns=80).splitlines()
    assert any("\x1b[" in line for line in lines)
    for line in lines:
        assert len(ESCAPE.sub("", line)) <= 80 or "ulpgate " in line, line


def test_the_gate_says_first_what_it_came_to(failing):
    done = subprocess.run(
        program.command(*failing[0]),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        cwd=program.ROOT,
    )
    lines = done.stdout.splitlines()
    first = next(i for i, line in enumerate(lines) if line.startswith("FAIL"))
    (summary,) = [i for i, line in enumerate(lines) if " records, 1 failed" in line]
    assert summary < first
