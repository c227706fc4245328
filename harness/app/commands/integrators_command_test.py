"""Tests of `ulpgate integrators` through the program: orders, exit codes, interrupts, kills and what resumes from them."""

import functools
import json
import pathlib
import signal
import subprocess
import sys
import time

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

import program  # noqa: E402
from program import log_lines, wait_for_pieces  # noqa: E402

run = functools.partial(program.run, "integrators")
started = functools.partial(program.started, "integrators")

# Hours, in slices of half a second.
ENDLESS_DRIFT = ["--types", "mpfr62", "--problems", "kepler", "--drift", "100000"]
# Minutes, the last rungs each.
ENDLESS_LADDER = ["--types", "mpfr62", "--integrators", "cash_karp54"]
ENDLESS_LADDER += ["--problems", "kepler", "--most-steps", "16777216"]
# How many pieces there are when a long one has begun.
ENDLESS = [(ENDLESS_DRIFT, 4), (ENDLESS_LADDER, 15)]

# A second or two.
ORDERS = ["--types", "double,mpfr62", "--problems", "kepler,rigid_body"]
ORDERS += ["--integrators", "leapfrog,gauss2,gauss5,gauss10"]
ORDERS += ["--most-steps", "1024"]
DRIFT = ["--types", "double,float128", "--problems", "kepler", "--drift", "48"]
DRIFT += ["--integrators", "pefrl,gauss4,extrapolation8,bulirsch_stoer"]
SIZES = {"orders": ORDERS, "drift": DRIFT}


# An explicit method at a step so large that the oscillator's energy grows, out of float's range.
OVERFLOW = ["--types", "float", "--integrators", "cash_karp54"]
OVERFLOW += ["--problems", "oscillator", "--steps-per-unit", "1", "--drift", "400000"]


def ended(process, how, timeout=None):
    """What a run says on stderr that is told to end."""
    process.send_signal(how)
    return process.communicate(timeout=timeout)[1]


def records(out, name):
    return (out / f"{name}.jsonl").read_bytes()


@pytest.fixture(scope="module", params=["orders", "drift"])
def whole(request, tmp_path_factory):
    """The name, the options and the records of an uninterrupted run of one thread."""
    out = tmp_path_factory.mktemp(request.param)
    size = SIZES[request.param]
    code, table, err = run(*size, "--threads", "1", "--out", out)
    assert code == 0, table + err
    assert not (out / "units").exists(), "a complete run keeps no units"
    return request.param, size, records(out, request.param), table


def partial(out, size, how=signal.SIGKILL):
    """A run that was ended when it had kept some pieces, and not all."""
    with started(*size, "--threads", "1", "--out", out) as process:
        wait_for_pieces(out, 3)
        err = ended(process, how)
    assert process.returncode == (3 if how != signal.SIGKILL else -how), err
    assert len(log_lines(out)) > 3
    return err


def test_integrators_show_their_orders(tmp_path):
    code, out, err = run(
        *["--types", "double", "--problems", "kepler,rigid_body"], "--out", tmp_path
    )
    assert code == 0, out + err
    rows = [json.loads(x) for x in records(tmp_path, "orders").splitlines()]
    known = json.loads(program.run("list", "integrators", "--json")[1])
    names = {i["integrator"] for i in known if i["order"] is not None}
    assert {r["integrator"] for r in rows} == names
    assert {r["problem"] for r in rows if r["integrator"] == "yoshida8"} == {"kepler"}
    code, out, _ = run(
        "--integrators", "leapfrog", "--problems", "kepler", "--drift", 256
    )
    assert code == 0 and "slope" in out


REFUSED = [
    (2, ["--integrators", "yoshida7"], "yoshida6"),
    (2, ["--integrators", ","], "names no integrator"),
    (2, ["--problems", "square"], "kepler"),
    (2, ["--types", "decimal"], "type"),
    (2, ["--tolerance", "nan"], "--tolerance"),
    (2, ["--tolerance", "inf"], "--tolerance"),
    (2, ["--tolerance", "-1"], "--tolerance"),
    (2, ["--resume"], "--out"),
    (2, ["--drift", 1 << 40, "--steps-per-unit", 1 << 30], "2^60"),
    (3, ["--integrators", "pefrl", "--problems", "rigid_body"], "q''"),
    (3, ["--types", "float", "--most-steps", 8], "nothing measured"),
    (3, ["--types", "double", "--most-steps", 16], "nothing measured"),
    (3, ["--integrators", "bulirsch_stoer"], "nothing measured"),
    (3, ["--integrators", "gauss10", "--problems", "pendulum"], "nothing measured"),
]


@pytest.mark.parametrize("code,more,message", REFUSED)
def test_a1_what_is_not_measured_is_not_passed(code, more, message):
    got, out, err = run(*more)
    assert got == code and message in err, out + err


def test_a1_a_drift_that_leaves_the_numbers_is_wrong(tmp_path):
    words = [*OVERFLOW, "--out", tmp_path]
    code, out, err = run(*words)
    assert code == 1 and "FAIL" in out, out + err
    row = json.loads(records(tmp_path, "drift").splitlines()[0])
    assert row["max_energy_error"] in ("inf", "nan")
    code, again, err = run(*words, "--resume")
    assert code == 1 and "complete already" in err and "FAIL" in again


def test_a_step_that_is_too_large_is_no_crash(tmp_path):
    words = ["--integrators", "pefrl,gauss1", "--problems", "kepler", "--drift", "64"]
    code, _, err = run(*words, "--steps-per-unit", "1", "--out", tmp_path)
    assert code == 3 and "not measured: gauss1 double kepler" in err
    assert len(records(tmp_path, "drift").splitlines()) == 1


def test_a_full_disk_behind_a_pipe_is_exit_4():
    with open("/dev/full", "w") as full:
        for more in (["--drift", "8"], ["--integrators", "pefrl"]):
            words = program.command("integrators", "--problems", "kepler", *more)
            done = subprocess.run(words, stdout=full, cwd=program.ROOT)
            assert done.returncode == 4


@pytest.mark.parametrize("size,pieces", ENDLESS)
@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupt_ends_a_long_run_at_once(tmp_path, size, pieces, how):
    with started(*size, "--threads", "2", "--out", tmp_path) as process:
        wait_for_pieces(tmp_path, pieces)
        time.sleep(0.2)
        err = ended(process, how, timeout=60)
    assert process.returncode == 3 and "--resume" in err
    assert len(log_lines(tmp_path)) > pieces
    context = json.loads((tmp_path / "context.json").read_text())
    assert context["complete"] is False


def test_an_interrupted_run_of_hours_goes_on_with_what_it_kept(tmp_path):
    words = [*ENDLESS_DRIFT, "--out", tmp_path]
    with started(*words) as process:
        wait_for_pieces(tmp_path, 8)
        ended(process, signal.SIGINT)
    kept = log_lines(tmp_path)
    with started(*words, "--resume") as process:
        wait_for_pieces(tmp_path, len(kept) + 1)
        ended(process, signal.SIGINT)
    assert process.returncode == 3
    assert log_lines(tmp_path)[: len(kept)] == kept


def test_an_interrupt_without_a_directory_says_that_nothing_is_kept():
    with started(*ENDLESS_DRIFT) as process:
        time.sleep(1)
        err = ended(process, signal.SIGINT, timeout=60)
    assert process.returncode == 3 and "nothing is kept" in err


def test_any_number_of_threads_gives_the_same_bytes(tmp_path, whole):
    name, size, text, table = whole
    for threads in (2, 5):
        out = tmp_path / str(threads)
        code, shown, err = run(*size, "--threads", threads, "--out", out)
        assert code == 0, err
        assert records(out, name) == text and shown == table
    code, shown, err = run(*size, "--json")
    assert code == 0 and shown.encode() == text


def test_a_killed_run_goes_on_to_the_same_bytes(tmp_path, whole):
    name, size, text, table = whole
    partial(tmp_path, size)
    code, shown, err = run(*size, "--resume", "--out", tmp_path)
    assert code == 0, err
    assert records(tmp_path, name) == text and shown == table
    assert not (tmp_path / "units").exists()
    code, _, err = run(*size, "--resume", "--out", tmp_path)
    assert code == 0 and "complete already" in err


def test_an_interrupted_run_goes_on_to_the_same_bytes(tmp_path, whole):
    name, size, text, _ = whole
    err = partial(tmp_path, size, how=signal.SIGINT)
    assert "--resume" in err
    code, _, err = run(*size, "--resume", "--threads", "2", "--out", tmp_path)
    assert code == 0, err
    assert records(tmp_path, name) == text


def test_many_kills_and_a_resume_give_the_same_bytes(tmp_path):
    size = ["--types", "mpfr62", "--problems", "kepler", "--drift", "48"]
    size += ["--integrators", "gauss10,fehlberg78"]
    code, _, err = run(*size, "--out", tmp_path / "whole")
    assert code == 0, err
    out = tmp_path / "killed"
    kills = 0
    for _ in range(8):
        known = len(log_lines(out))
        with started(*size, "--resume", "--threads", "2", "--out", out) as process:
            while process.poll() is None and len(log_lines(out)) <= known + 2:
                time.sleep(0.01)
        kills += process.returncode != 0
    assert kills >= 3, "the run was too short to be killed"
    code, _, err = run(*size, "--resume", "--out", out)
    assert code == 0, err
    assert records(out, "drift") == records(tmp_path / "whole", "drift")


def test_torn_pieces_are_noted_and_done_again(tmp_path, whole):
    name, size, text, _ = whole
    partial(tmp_path, size)
    log = tmp_path / "units/log.txt"
    lines = log_lines(tmp_path)
    lines[2] = lines[2][:25] + b"?" + lines[2][26:]
    lines[-1] = lines[-1][: len(lines[-1]) // 2]
    log.write_bytes(b"".join(lines))
    code, _, err = run(*size, "--resume", "--out", tmp_path)
    assert code == 0 and "log.txt:3: " in err and "done again" in err
    assert records(tmp_path, name) == text


def test_a_log_without_its_header_is_not_trusted(tmp_path, whole):
    name, size, text, _ = whole
    partial(tmp_path, size)
    log = tmp_path / "units/log.txt"
    log.write_bytes(b"X" + log.read_bytes())
    code, _, err = run(*size, "--resume", "--out", tmp_path)
    assert code == 0 and "log.txt:1" in err
    assert records(tmp_path, name) == text


def test_a_partial_run_is_neither_lost_nor_mixed(tmp_path, whole):
    name, size, text, _ = whole
    partial(tmp_path, size)
    kept = log_lines(tmp_path)
    out = ["--out", tmp_path]
    code, _, err = run(*size, *out)
    assert code == 2 and "--resume" in err and "--overwrite" in err
    other = [word.replace("double,", "") for word in size]
    code, _, err = run(*other, "--resume", *out)
    assert code == 2 and "--overwrite" in err and "plan" in err
    code, _, err = run(*size, "--resume", "--overwrite", *out)
    assert code == 2 and "excludes" in err
    assert log_lines(tmp_path) == kept
    code, _, err = run(*size, "--overwrite", *out)
    assert code == 0, err
    assert records(tmp_path, name) == text


def test_pieces_of_another_machine_are_refused(tmp_path, whole):
    _, size, _, _ = whole
    partial(tmp_path, size)
    program.move_to_another_machine(tmp_path)
    code, _, err = run(*size, "--resume", "--out", tmp_path)
    assert code == 2 and "libraries glibc" in err


def test_a_finished_directory_of_another_plan_is_not_replaced_silently(tmp_path):
    out = ["--problems", "kepler", "--integrators", "pefrl", "--out", tmp_path]
    assert run(*out)[0] == 0
    kept = records(tmp_path, "orders")
    for other in (["--drift", "8"], ["--most-steps", "512"], ["--types", "float"]):
        code, _, err = run(*out, *other)
        assert code == 2 and "another plan" in err
        assert records(tmp_path, "orders") == kept
    assert run(*out, "--drift", "8", "--overwrite")[0] == 0
    assert not (tmp_path / "orders.jsonl").exists()
    assert records(tmp_path, "drift")


def test_two_processes_do_not_share_a_directory(tmp_path):
    with started(*ENDLESS_DRIFT, "--out", tmp_path):
        wait_for_pieces(tmp_path, 1)
        code, _, err = run(*ENDLESS_DRIFT, "--resume", "--out", tmp_path)
        assert code == 2 and "another process" in err


def test_a_terminal_shows_the_time_left_and_a_pipe_nothing():
    code, _, err = run(*DRIFT)
    assert code == 0 and "left" not in err and "\r" not in err
    assert err == "ulpgate: integrators: 8 rows judged, 0 wrong, 0 not measured\n"
    shown = program.shown_on_terminal("integrators", *DRIFT)
    assert b"integrators [" in shown and b" left" in shown
