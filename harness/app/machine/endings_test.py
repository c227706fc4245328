"""Tests of functions, steps and references that do not come back, and of signals."""

import pathlib
import re
import signal
import sys
import time

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

from preloaded import (
    interrupted,
    library,
    needs_x86,
    run,
    sin_run,
    spinning,
)  # noqa: E402, F401


@needs_x86
@pytest.mark.parametrize("threads", ["1", "2"])
@pytest.mark.parametrize("verb", ["run", "compare", "speed", "explain"])
def test_b5_a_scene_whose_step_never_ends_is_named(tmp_path, library, verb, threads):
    words = ["scene", verb, spinning(tmp_path), "--types", "double", "--threads"]
    code, _, err = run(*words, threads, "--timeout", "1", preload=library("endless"))
    assert code == 4, err
    assert re.search(
        "spinning double steps? .* has not come back in 1 s", err
    ), "the scene, its type, the steps"


@needs_x86
@pytest.mark.parametrize("threads", ["1", "2"])
def test_b5_a_function_that_never_returns_is_named_with_its_argument(
    tmp_path, library, threads
):
    out = tmp_path / "out"
    start = time.monotonic()
    code, _, err = sin_run(
        out, "--timeout", "1.5", "--threads", threads, preload=library("hang")
    )
    assert code == 4, err
    assert time.monotonic() - start < 30
    (line,) = [text for text in err.splitlines() if "has not come back" in text]
    assert "sin double uniform at 0x1." in line
    x = float.fromhex(line.split(" at ")[1].split()[0])
    assert 1 < x < 2
    assert (out / "units/log.txt").read_bytes().count(
        b"\n"
    ) > 2, "finished units are kept"


@needs_x86
def test_b5_at_and_search_are_watched(tmp_path, library):
    hang = library("hang")
    code, _, err = run("--timeout", "0.5", "at", "sin", "double", "1.5", preload=hang)
    assert code == 4 and "sin double at 0x1.8p+0 has not come back" in err
    code, _, err = run(
        "search", "sin", "double", "--timeout", "0.7", "--seconds", "100", preload=hang
    )
    assert (
        code == 4 and "sin double search at 0x1." in err and "has not come back" in err
    )


@needs_x86
def test_b5_kernels_and_integrators_are_watched(tmp_path, library):
    words = ["--types", "double", "--timeout", "1", "--out"]
    endless = library("endless")
    rotation = ["kernels", "--kernels", "rotation", "--strata", "uniform", "--samples"]
    code, _, err = run(*rotation, "4000", *words, tmp_path / "k", preload=endless)
    assert code == 4 and "rotation double uniform at " in err, err
    assert "has not come back in 1 s" in err
    pendulum = ["integrators", "--problems", "pendulum", *words, tmp_path / "i"]
    code, _, err = run(*pendulum, preload=library("hang"))
    assert code == 4 and "pendulum double has not come back in 1 s" in err, err


@needs_x86
def test_b5_a_hang_in_the_scan_of_narrow_is_named_with_its_argument(tmp_path, library):
    words = ["math", "--functions", "sin", "--types", "double", "--strata", "narrow"]
    words += ["--samples", "64", "--timing", "off", "--timeout", "1.5"]
    code, _, err = run(*words, "--out", str(tmp_path / "out"), preload=library("hang"))
    assert code == 4, err
    (line,) = [text for text in err.splitlines() if "has not come back" in text]
    assert 1 < float.fromhex(line.split(" at ")[1].split()[0]) < 2


def test_b5_a_function_that_takes_a_minute_is_named():
    words = ["at", "cpow", "mpfr150", "1e300000", "1", "1", "1e300000"]
    code, _, err = run("--timeout", "0.5", *words)
    assert code == 4 and "cpow mpfr150 at 0x1.58" in err and "has not come back" in err


@needs_x86
def test_b5_a_reference_that_never_returns_is_named_as_such(tmp_path, library):
    # Double's erfc is one that the long double of libm judges.
    words = "math --functions erfc --types double --strata uniform --timing off".split()
    words += ["--samples", "4000", "--out", tmp_path, "--timeout", "1.5"]
    code, _, err = run(*words, preload=library("reference"))
    assert code == 4 and "the reference of erfc double uniform at" in err


@pytest.mark.parametrize(
    "words",
    [
        ["search", "sin", "double", "--seconds", "nan"],
        ["search", "sin", "double", "--seconds", "inf"],
        ["scene", "run", "pendulum3", "--checkpoint-seconds", "nan"],
        ["math", "--timeout", "nan", "--out", "x"],
        ["math", "--timeout", "-1", "--out", "x"],
        ["--timeout", "0", "at", "sin", "double", "1"],
    ],
)
def test_b5_times_that_are_none_are_refused(words):
    code, _, err = run(*words)
    option = next(w for w in words if w.startswith("--"))
    assert code == 2 and option in err


@needs_x86
@pytest.mark.parametrize(
    "first,second",
    [
        (signal.SIGINT, signal.SIGINT),
        (signal.SIGTERM, signal.SIGTERM),
        (signal.SIGHUP, signal.SIGTERM),
    ],
)
def test_b5_a_second_signal_ends_at_once_and_keeps_what_is_finished(
    tmp_path, library, first, second
):
    code, err = interrupted(tmp_path / "out", library, first, second)
    assert code == 3 and "ended at once" in err
    assert (tmp_path / "out/units/log.txt").read_bytes().count(b"\n") > 2
