"""Checks `ulpgate at` against mpmath, which shares no code with MPFR, to 1e-6 ULP at hard arguments."""

import json
import os
import pathlib
import subprocess

import mpmath
import pytest
from mpmath import mp, mpf

ROOT = pathlib.Path(__file__).resolve().parents[3]
ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))

# token: significand bits, least normal exponent
TYPES = {
    "float": (24, -126),
    "double": (53, -1022),
    "long_double": (64, -16382),
    "float128": (113, -16382),
}
HUGE = {
    "float": "0x1.d48e64p+120",
    "double": "0x1.6ac5b262ca1ffp+849",
    "long_double": "0x1.8p+16000",
    "float128": "0x1.123456789abcdp+16300",
}
TINY = {
    "float": "0x1.8p-140",
    "double": "0x1.5p-1060",
    "long_double": "0x1.5p-16400",
    "float128": "0x1.5p-16450",
}
# exp of these is subnormal
DEEP = {
    "float": "-100",
    "double": "-740.5",
    "long_double": "-11370.25",
    "float128": "-11370.25",
}

mp.prec = 20000


FUNCTIONS = {
    "add": (lambda x, y: x + y, [("0x1.8p+0", "-0x1.7fffffp+0"), ("1", "0x1p-30")]),
    "sub": (lambda x, y: x - y, [("0x1.8p+0", "0x1.7fffffp+0"), ("1", "0x1p-30")]),
    "mul": (
        lambda x, y: x * y,
        [("0x1.fffffp+0", "0x1.00001p+0"), ("TINY", "0x1.8p-1")],
    ),
    "div": (lambda x, y: x / y, [("1", "3"), ("TINY", "3")]),
    "fma": (
        lambda x, y, z: x * y + z,
        [("0x1.000002p+0", "0x1.000002p+0", "-1"), ("3", "5", "TINY")],
    ),
    "sqrt": (mpmath.sqrt, [("TINY",), ("2",), ("HUGE",)]),
    "cbrt": (
        lambda x: mpmath.sign(x) * mpmath.root(abs(x), 3),
        [("TINY",), ("-2",), ("HUGE",)],
    ),
    "hypot": (mpmath.hypot, [("3", "0x1.8p-20"), ("TINY", "TINY")]),
    "fmod": (None, [("0x1.8p+20", "0x1.000002p-3"), ("-7", "3")]),
    "remainder": (None, [("0x1.8p+20", "0x1.000002p-3"), ("-7", "3")]),
    "sin": (mpmath.sin, [("HUGE",), ("0x1.921fb6p+1",), ("TINY",)]),
    "cos": (mpmath.cos, [("HUGE",), ("0x1.921fb6p+0",)]),
    "tan": (mpmath.tan, [("HUGE",), ("0x1.921fb6p+0",), ("TINY",)]),
    "sinh": (mpmath.sinh, [("TINY",), ("0x1p-12",), ("-20.5",)]),
    "cosh": (mpmath.cosh, [("0x1p-12",), ("20.5",)]),
    "tanh": (mpmath.tanh, [("0x1p-12",), ("5.25",)]),
    "asin": (mpmath.asin, [("0x1.fffffep-1",), ("0x1p-12",)]),
    "acos": (mpmath.acos, [("0x1.fffffep-1",), ("-0x1.fffffep-1",)]),
    "atan": (mpmath.atan, [("HUGE",), ("0x1p-12",)]),
    "asinh": (mpmath.asinh, [("0x1p-12",), ("HUGE",)]),
    "acosh": (mpmath.acosh, [("0x1.000002p+0",), ("HUGE",)]),
    "atanh": (mpmath.atanh, [("0x1.fffffep-1",), ("0x1p-12",)]),
    "atan2": (mpmath.atan2, [("1", "-0x1p+20"), ("TINY", "0x1.8p+0")]),
    "log": (mpmath.log, [("0x1.000002p+0",), ("TINY",), ("HUGE",)]),
    "log10": (mpmath.log10, [("0x1.000002p+0",), ("TINY",)]),
    "log2": (
        lambda x: mpmath.log(x) / mpmath.log(2),
        [("0x1.000002p+0",), ("0x1.8p-30",)],
    ),
    "log1p": (lambda x: mpmath.log(1 + x), [("0x1p-20",), ("-0x1.fffffep-1",)]),
    "logb": (
        lambda x: mpmath.floor(mpmath.log(abs(x), 2)),
        [("0x1.8p-30",), ("-0x1.7p+100",)],
    ),
    "exp": (mpmath.exp, [("DEEP",), ("0x1.6p+4",), ("-0x1p-20",)]),
    "exp2": (lambda x: mpmath.power(2, x), [("-120.3",), ("0x1.6p+4",)]),
    "expm1": (lambda x: mpmath.exp(x) - 1, [("0x1p-20",), ("-0x1.8p+3",)]),
    "pow": (
        mpmath.power,
        [("0x1.000002p+0", "0x1p+28"), ("0x1.8p-60", "2.25"), ("10", "-39.5")],
    ),
    "erf": (mpmath.erf, [("0x1p-12",), ("3.5",)]),
    "erfc": (mpmath.erfc, [("9.25",), ("0.5",), ("-2",)]),
    "tgamma": (
        mpmath.gamma,
        [("-0x1.00001p+2",), ("-5.25",), ("30.75",), ("0x1p-100",)],
    ),
    "lgamma": (
        lambda x: mpmath.log(mpmath.gamma(x)),
        [("0x1.00001p+1",), ("0x1.fffff8p-1",), ("2.84",), ("30.5",)],
    ),
}


def from_hex(text):
    sign = -1 if text.startswith("-") else 1
    body = text.lstrip("-")[2:]
    mantissa, exponent = body.split("p")
    whole, _, fraction = mantissa.partition(".")
    return (
        sign
        * mpf(int(whole + fraction, 16))
        * mpf(2) ** (int(exponent) - 4 * len(fraction))
    )


def exact_fmod(x, y, nearest):
    quotient = x / y
    n = (
        mpmath.nint(quotient)
        if nearest
        else mpmath.sign(quotient) * mpmath.floor(abs(quotient))
    )
    return x - n * y


def ulp_error(got, exact, bits, least):
    exponent = max(int(mpmath.floor(mpmath.log(abs(exact), 2))), least)
    # floor(log2) can be off next to a power of two
    if abs(exact) >= mpf(2) ** (exponent + 1):
        exponent += 1
    return abs(got - exact) / mpf(2) ** (exponent - bits + 1)


def cases():
    for name, (_, points) in FUNCTIONS.items():
        for point in points:
            for token in TYPES:
                yield name, token, tuple(
                    {"HUGE": HUGE, "TINY": TINY, "DEEP": DEEP}.get(a, {}).get(token, a)
                    for a in point
                )


def test_every_real_function_has_a_case():
    listed = json.loads(
        subprocess.run(
            [ULPGATE, "list", "functions", "--json"], capture_output=True, text=True
        ).stdout
    )
    assert {f["function"] for f in listed if f["class"] == "real"} == set(FUNCTIONS)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_agrees_with_mpmath(name):
    checked = 0
    for function, token, args in cases():
        if function != name:
            continue
        done = subprocess.run(
            [ULPGATE, "at", name, token, *args, "--json"],
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stderr
        point = json.loads(done.stdout)
        if (
            point["outcome"] != "finite"
            or "inf" in point["value"]
            or "nan" in point["value"]
        ):
            continue
        x = [from_hex(a) for a in point["args"]]
        # Enough bits for the argument reduction of the largest and the cancellation of the smallest arguments.
        wide = max([abs(int(mpmath.log(abs(v), 2))) for v in x if v != 0] + [100])
        mp.prec = (
            wide
            if name in ("sin", "cos", "tan", "add", "sub", "fma", "fmod", "remainder")
            else min(wide, 400)
        ) + 700
        exact = (
            exact_fmod(*x, name == "remainder")
            if name in ("fmod", "remainder")
            else FUNCTIONS[name][0](*x)
        )
        got = from_hex(point["value"])
        error = ulp_error(got, exact, *TYPES[token]) if exact != 0 else abs(got)
        assert abs(error - mpf(point["ulp_error"])) < 1e-6, (
            name,
            token,
            args,
            point,
            mpmath.nstr(error, 12),
        )
        checked += 1
    assert checked >= 4
