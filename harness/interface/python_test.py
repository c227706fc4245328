"""Tests of the Python module: arrays, functions, exact values, and what is refused."""
import math
import os
import pathlib
import sys

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "python"))

if "ULPGATE_LIBRARY" not in os.environ:
    pytest.skip("ULPGATE_LIBRARY names no libulpgate", allow_module_level=True)

import ulpgate  # noqa: E402


def test_arrays_that_are_right_pass():
    x = np.linspace(-10, 10, 1001)
    ulpgate.assert_max_ulp(np.sin(x), "sin", x, 4.0)
    ulpgate.assert_max_ulp(np.sqrt(np.abs(x)), "sqrt", np.abs(x), 0.5)
    y = x.astype(np.float32)
    ulpgate.assert_max_ulp(np.arctan2(y, np.float32(2)), "atan2", y, np.float32(2), 4.0)


def test_the_worst_of_an_array_is_named():
    x = np.array([0.5, 1.0, 1.5])
    y = np.array([math.sin(one) for one in x])
    y[1] = np.nextafter(np.nextafter(y[1], 2), 2)
    with pytest.raises(AssertionError) as caught:
        ulpgate.assert_max_ulp(y, "sin", x, 1.0)
    text = str(caught.value)
    assert "1 of 3 results" in text and "index 1" in text and "off by 1.98" in text
    assert (
        "sin(0x1p+0)" in text
        and "condition number" in text
        and "8.414709848078965066" in text
    )
    errors = ulpgate.ulp_errors(y, "sin", x)
    assert errors.shape == x.shape and errors[0] <= 0.5 < 1.9 < errors[1]


def test_results_of_another_kind_are_infinitely_wrong():
    with pytest.raises(AssertionError, match="nan"):
        ulpgate.assert_max_ulp(np.array([np.nan]), "exp", np.array([1.0]), 1e300)
    assert ulpgate.ulp_errors(np.array([np.nan]), "log", np.array([-1.0])) == 0


@pytest.mark.parametrize(
    "call, error, said",
    [
        (lambda: ulpgate.ulp_errors(np.array([1.0]), "sine", 1.0), ValueError, "sine"),
        (
            lambda: ulpgate.ulp_errors(np.array([1.0]), "pow", 1.0),
            TypeError,
            "2 arguments",
        ),
        (lambda: ulpgate.ulp_errors(np.array([1]), "sin", 1.0), TypeError, "int64"),
        (
            lambda: ulpgate.ulp_errors(np.float32([1.0]), "sin", 0.1),
            ValueError,
            "float32",
        ),
        (
            lambda: ulpgate.assert_max_ulp(np.array([]), "sin", np.array([]), 1),
            AssertionError,
            "no results",
        ),
        (lambda: ulpgate.exact("sin", "0.1x", 20), ValueError, "0.1x"),
        (lambda: ulpgate.exact("sin", "1", 0), ValueError, "digits"),
        (lambda: ulpgate.test(np.sin, as_="sin", dtype=np.int32), TypeError, "int32"),
        (lambda: ulpgate.test(lambda x: x[:-1], as_="sin"), TypeError, "shape"),
        (
            lambda: ulpgate.test(lambda x: 1 / 0, as_="sin"),
            ZeroDivisionError,
            "division",
        ),
        (lambda: ulpgate.test(np.sin, as_="sin", samples=1), ValueError, "samples"),
    ],
)
def test_what_is_refused(call, error, said):
    with pytest.raises(error, match=said):
        call()


def test_exact_values():
    assert ulpgate.exact("tgamma", "0.1", 40).startswith("9.51350769866873183629")
    assert ulpgate.exact("exp", 1, 30).startswith("2.71828182845904523536")
    # A double's tenth is not a tenth.
    assert ulpgate.exact("sin", 0.1, 40) != ulpgate.exact("sin", "0.1", 40)
    assert ulpgate.exact("atan2", 1, 1, 25).startswith("7.85398163397448309615")


def test_exact_values_of_mpmath():
    mpmath = pytest.importorskip("mpmath")
    with mpmath.workdps(60):
        x = mpmath.mpf(1) / 3
        value = ulpgate.exact("erf", x, 50)
        assert (
            isinstance(value, mpmath.mpf)
            and abs(value - mpmath.erf(x)) < mpmath.mpf(10) ** -49
        )


def test_functions_over_strata():
    found = ulpgate.test(np.sqrt, as_="sqrt", dtype=np.float32, samples=2000)
    assert 0.499 < found.max_ulp <= 0.5 and not found.mismatches
    assert [row["stratum"] for row in found.rows][:3] == [
        "uniform",
        "stratified",
        "binades",
    ]
    assert found == ulpgate.test(np.sqrt, as_="sqrt", dtype=np.float32, samples=2000)
    assert found != ulpgate.test(
        np.sqrt, as_="sqrt", dtype=np.float32, samples=2000, seed=2
    )
    off = ulpgate.test(lambda x: np.sin(x) * 1.5, as_="sin", samples=200)
    assert off.max_ulp > 1e14 and "samples" in str(off)


@pytest.mark.parametrize("dtype, limit", [(np.float32, 4.0), (np.float64, 4.0)])
@pytest.mark.parametrize(
    "name, as_",
    [("exp", "exp"), ("log", "log"), ("cbrt", "cbrt"), ("arctan2", "atan2")],
)
def test_numpys_functions(name, as_, dtype, limit):
    found = ulpgate.test(getattr(np, name), as_=as_, dtype=dtype, samples=1000)
    assert found.worst["max_ulp"] < limit, str(found)


def test_the_example_of_the_documentation_runs():
    lines = [
        line[4:] for line in ulpgate.__doc__.splitlines() if line.startswith("    ")
    ]
    names = {}
    exec("\n".join(lines), names)  # noqa: S102  (our own words)
    assert names["found"].max_ulp < 4


def test_the_readme_s_lines_run():
    """Every line of Python in the room's README."""
    text = (pathlib.Path(__file__).parent / "README.md").read_text()
    lines = [
        line.split("#")[0].strip()
        for line in text.splitlines()
        if line.startswith("    ulpgate.")
    ]
    assert len(lines) >= 3
    for line in lines:
        eval(
            line, {"np": np, "ulpgate": ulpgate, "x": np.linspace(-3, 3, 101)}
        )  # noqa: S307
