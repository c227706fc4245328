"""Tests of `ulpgate claims`: what a library documents is held, and a violation is shown by a program that compiles."""

import json
import pathlib
import re
import subprocess
import sys

import pytest

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "testing"))

from program import run  # noqa: E402

SOURCE = """
#include <math.h>
typedef double v4d __attribute__((vector_size(32)));
/* Off by three units on [1, 2], by more than any claim has digits for beyond 1e6, and NaN beyond 1e9. */
double off_sin(double x) {
  double y = sin(x);
  if (x >= 1 && x <= 2) y += 3 * 0x1p-53;
  if (fabs(x) > 1e6) y *= 0.5;
  return fabs(x) > 1e9 ? NAN : y;
}
/* A tiny error of its own next to 0, where it is a large one in units of the last place. */
double floor_sin(double x) { return fabs(x) < 1e-300 ? 0 * x : sin(x); }
__attribute__((target("avx2"))) v4d off_sin4(v4d x) {
  return (v4d){off_sin(x[0]), off_sin(x[1]), off_sin(x[2]), off_sin(x[3])};
}
/* Two results: by pointers, by pointers of a vector, and by vectors of pointers as the vector ABI has it. */
typedef double v2d __attribute__((vector_size(16)));
typedef float v4f __attribute__((vector_size(16)));
typedef unsigned long v2l __attribute__((vector_size(16)));
void off_sincos(double x, double* s, double* c) { *s = off_sin(x); *c = cos(x) + (x < 1 ? 3 * 0x1p-53 : 0); }
void off_sincos2(v2d x, double* s, double* c) {
  for (int i = 0; i < 2; ++i) off_sincos(x[i], s + i, c + i);
}
void off_pointers(v2d x, v2l s, v2l c) {
  for (int i = 0; i < 2; ++i) off_sincos(x[i], (double*)s[i], (double*)c[i]);
}
void off_pointersf(v4f x, v2l s, v2l t, v2l c, v2l d) {
  for (int i = 0; i < 4; ++i) {
    *(float*)(i < 2 ? s[i] : t[i - 2]) = sinf(x[i]) + (x[i] < 1 ? 3 * 0x1p-24f : 0);
    *(float*)(i < 2 ? c[i] : d[i - 2]) = cosf(x[i]) + (x[i] < 1 ? 3 * 0x1p-24f : 0);
  }
}
/* Neither odd nor within [-1, 1], and every second number of (3, 3.5) is lower than its neighbours. */
double rough_tanh(double x) {
  const double y = tanh(x);
  return x > 20 ? y + 0x1p-52 : x > 3 && x < 3.5 && fmod(x * 0x1p51, 2) == 1 ? y - 0x1p-40 : y;
}
double endless(double x) {
  for (volatile int spin = 1; spin;) continue;
  return x;
}
/* Zero for the smallest numbers, which is off by a unit; and a zero of the wrong sign, by which no unit is meant. */
double flat_sinh(double x) { return fabs(x) <= 0x1p-1074 ? 0 * x : sinh(x); }
double flat_asinh(double x) { return fabs(x) <= 0x1p-1074 && x != 0 ? 0 : asinh(x); }
double plus_sinh(double x) { return x == 0 ? 0 : sinh(x); }
double wide_exp(double x) { return x > 709 ? 1 / 0.0 : exp(x); }
/* Each crash is a new worker: far out it is a right sine again. */
double near_sin(double x) { return fabs(x) > 1e6 && fabs(x) < 1e8 ? *(volatile double*)0 : sin(x); }
double rough_cos(double x) { return x == 0 ? 1 - 0x1p-53 : cos(x); }
"""

ROW = """
[[implementation]]
function = "{function}"
type = "double"
symbol = "{symbol}"
claim_ulp = {claim}
"""


# Far out glibc's sine and cosine err by 1e5 ULP next to multiples of pi/2.
NEAR = "domain = [-1e6, 1e6]\n"


@pytest.fixture(scope="session")
def library(tmp_path_factory):
    folder = tmp_path_factory.mktemp("library")
    source = folder / "off.c"
    source.write_text(SOURCE)
    made = folder / "liboff.so"
    flags = ["-O1", "-fno-builtin", "-shared", "-fPIC", "-w"]
    subprocess.run(["cc", *flags, source, "-o", made, "-lm"], check=True)
    return made


def claims(tmp_path, library, rows, *more):
    file = tmp_path / "list.toml"
    file.write_text(f'library = "{library}"\n' + rows)
    out = tmp_path / "out"
    small = ["--samples", "2000", "--evaluations", "4000"]
    code, text, err = run("claims", file, "--out", out, *small, *more)
    found = (
        json.loads((out / "claims.json").read_text())
        if (out / "claims.json").exists()
        else []
    )
    return code, text, err, found


def shown(program):
    """Exit code and words of the program that a violation comes with, built as its first lines say."""
    text = pathlib.Path(program).read_text()
    words = re.search(r"cc (.*?)FILE.c(.*?)&&", text)
    flags, libraries = words[1].split(), words[2].split()
    built = program + ".out"
    subprocess.run(
        ["cc", "-Wall", "-Werror", *flags, program, *libraries, "-o", built], check=True
    )
    done = subprocess.run([built], capture_output=True, text=True)
    return done.returncode, done.stdout


def row(symbol, claim, more="", function="sin"):
    return ROW.format(function=function, symbol=symbol, claim=claim) + more + "\n"


def test_a_violation_is_shown_by_a_program(tmp_path, library):
    code, text, _, (found,) = claims(
        tmp_path, library, row("off_sin", 2, "domain = [-1e6, 1e6]")
    )
    assert code == 1 and "VIOLATED" in text
    assert (
        2.5 < found["largest_ulp"] < 5
        and not found["holds"]
        and not found["mismatches"]
    )
    assert 1 <= float.fromhex(found["args"][0]) <= 2
    code, words = shown(found["program"])
    assert code == 1 and "off_sin(" in words and "above 2" in words


def test_a_claim_covers_its_domain_alone(tmp_path, library):
    code, text, _, (found,) = claims(
        tmp_path, library, row("off_sin", 5, "domain = [-1e6, 1e6]")
    )
    assert code == 0 and found["holds"] and "holds" in text
    code, _, _, (found,) = claims(tmp_path, library, row("off_sin", 5), "--overwrite")
    assert code == 1 and {m["outcome"] for m in found["mismatches"]} == {"nan"}
    assert shown(found["program"])[0] == 1


@pytest.mark.parametrize(
    "low, high", [(1.23456789, 1.23456790), (1.3579, 1.3579), (-1e5, -99999.9)]
)
def test_a_narrow_domain_is_judged_all_the_same(tmp_path, library, low, high):
    """Neither the strata nor the search draw an argument of it."""
    bad = 1 <= low <= 2
    rows = row("off_sin", 2, f"domain = [{low}, {high}]")
    code, text, _, (found,) = claims(tmp_path, library, rows)
    assert code == (1 if bad else 0) and found["holds"] == (not bad)
    if bad:
        assert found["where"] == "domain" and 2.5 < found["largest_ulp"] < 5
        assert low <= float.fromhex(found["args"][0]) <= high
        assert shown(found["program"])[0] == 1


def test_beyond_its_domain_nothing_is_called(tmp_path, library):
    code, _, _, (found,) = claims(
        tmp_path, library, row("near_sin", 1, "domain = [-1e6, 1e6]")
    )
    assert code == 0 and found["holds"] and not found["mismatches"]
    code, _, _, (found,) = claims(tmp_path, library, row("near_sin", 1), "--overwrite")
    assert code == 1 and "crash" in {m["outcome"] for m in found["mismatches"]}


def test_a_floor_allows_an_absolute_error(tmp_path, library):
    code, _, _, (found,) = claims(
        tmp_path, library, row("floor_sin", 1, NEAR + "claim_floor = 1e-299")
    )
    assert code == 0, found
    code, _, _, (found,) = claims(
        tmp_path,
        library,
        row("floor_sin", 1, NEAR + "claim_floor = 1e-305"),
        "--overwrite",
    )
    assert code == 1 and "underflow_spurious" in {
        m["outcome"] for m in found["mismatches"]
    }


def test_vectors_and_variants(tmp_path, library):
    both = row("off_sin", 2, "domain = [-1e6, 1e6]")
    both += row("off_sin4", 2, 'domain = [-1e6, 1e6]\nsignature = "v4d(v4d)"')
    code, _, err, found = claims(tmp_path, library, both)
    if ": left out" in err:
        pytest.skip("this processor has no AVX2")
    assert code == 1 and [f["symbol"] for f in found] == ["off_sin", "off_sin4"]
    assert (
        found[1]["largest_ulp"] == found[0]["largest_ulp"] and found[1]["variant"] == ""
    )
    assert shown(found[1]["program"])[0] == 1


@pytest.mark.parametrize("function", ["sin", "cos"])
def test_two_results(tmp_path, library, function):
    domain = "domain = [0.25, 2]\n"
    rows = ""
    for symbol, signature in (
        ("off_sincos", "void(d,d*,d*)"),
        ("off_sincos2", "void(v2d,d*,d*)"),
        ("off_pointers", "void(v2d,v2d*,v2d*)"),
        ("off_pointersf", "void(v4f,v4f*,v4f*)"),
    ):
        more = domain + f'signature = "{signature}"'
        one = row(symbol, 2, more, function=function)
        rows += one.replace("double", "float") if symbol == "off_pointersf" else one
    code, _, _, found = claims(tmp_path, library, rows)
    assert code == 1 and len(found) == 4
    for f in found:
        assert f["largest_ulp"] > 2 and not f["mismatches"]
        code, words = shown(f["program"])
        assert code == 1 and f["symbol"] in words


def test_results_that_are_no_number_of_units(tmp_path, library):
    rows = row("flat_sinh", 2, function="sinh")
    rows += row("plus_sinh", 2, function="sinh")
    rows += row("wide_exp", 2, function="exp")
    rows += row("flat_asinh", 2, function="asinh")
    code, _, err, (flat, plus, wide, flat_of_plus) = claims(tmp_path, library, rows)
    assert code == 1, err
    # It is said, and is within the claim.
    assert [m["outcome"] for m in flat["mismatches"]] == ["underflow_spurious"]
    assert flat["holds"] and flat["program"] == ""
    assert [m["outcome"] for m in flat_of_plus["mismatches"]] == ["zero_sign"]
    assert flat_of_plus["holds"] and flat_of_plus["program"] == ""
    assert [m["outcome"] for m in plus["mismatches"]] == ["zero_sign"]
    assert [m["outcome"] for m in wide["mismatches"]] == ["overflow_spurious"]
    for found in (plus, wide):
        code, text = shown(found["program"])
        assert not found["holds"] and code == 1 and "inf ULP" in text


def test_other_domains_are_no_variants(tmp_path, library):
    rows = row("off_sin", 5, "domain = [-1e6, 0]") + row(
        "off_sin", 5, "domain = [0, 1e6]"
    )
    code, _, err, found = claims(tmp_path, library, rows)
    assert code == 0 and [f["variant"] for f in found] == ["", ""], err


def test_a_function_without_an_end_leaves_the_others_measured(tmp_path, library):
    rows = row("endless", 1) + row("off_sin", 5, NEAR)
    code, text, err, found = claims(
        tmp_path, library, rows, "--call-timeout", "0.01", "--threads", "1"
    )
    assert code == 1 and "hangs at more than" in text
    assert [f["holds"] for f in found] == [False, True]


def test_properties_that_need_no_reference(tmp_path, library):
    rows = row("rough_tanh", 1e6, function="tanh") + row(
        "rough_cos", 1, NEAR, function="cos"
    )
    code, text, _, found = claims(tmp_path, library, rows)
    assert code == 0, [(f["largest_ulp"], f["args"], f["mismatches"]) for f in found]
    broken = {p["property"]: p for p in found[0]["properties"]}
    assert broken.keys() == {"odd", "range", "monotone"}
    assert float.fromhex(broken["range"]["args"][0]) > 20
    assert 3 < float.fromhex(broken["monotone"]["args"][0]) < 3.5
    assert [p["property"] for p in found[1]["properties"]] == ["exact"]
    assert "not exact: 0x0p+0 gives 0x1.fffffffffffffp-1, not 0x1p+0" in text
    assert claims(tmp_path, library, rows, "--strict")[0] == 1


def test_the_same_again_and_what_is_there_is_kept(tmp_path, library):
    rows = row("off_sin", 2, "domain = [-1e6, 1e6]")
    _, first, _, _ = claims(tmp_path, library, rows)
    written = (tmp_path / "out/claims.json").read_bytes()
    _, second, err, _ = claims(tmp_path, library, rows)
    assert second == first and "is complete already" in err
    assert (tmp_path / "out/claims.json").read_bytes() == written
    claims(tmp_path, library, rows, "--overwrite", "--threads", "1")
    assert (tmp_path / "out/claims.json").read_bytes() == written


@pytest.mark.parametrize(
    "rows, said",
    [
        (row("off_sin", 2, "domain = [2, 1]"), "domain"),
        (row("off_sin", 2, "domain = [[0, 1], [0, 1]]"), "2 intervals"),
        (row("off_sin", 2, "claim_floor = -1"), "claim_floor"),
        (row("off_sin", 2, "colour = 1"), "colour"),
        (row("off_sine", 2), "off_sine"),
        (row("off_sin", 2).replace("sin", "sine"), "sine"),
        (
            '[[implementation]]\nfunction = "sin"\ntype = "double"\nsymbol = "off_sin"\n',
            "claims nothing",
        ),
        ("x = [", "list.toml:"),
        ("", "no [[implementation]]"),
    ],
)
def test_a_broken_list_names_its_line(tmp_path, library, rows, said):
    code, _, err, _ = claims(tmp_path, library, rows)
    assert code == 2 and said in err and "list.toml" in err, err


def test_the_lists_that_are_built_in(tmp_path):
    """Each is read whole; what is not installed is named, what this processor lacks is left out."""
    small = ["--samples", "100", "--evaluations", "0"]
    words = ["--functions", "exp,atan2", "--types", "float"]
    code, text, err = run("claims", "libmvec", *words, "--out", tmp_path / "a", *small)
    if "cannot be loaded" in err:
        pytest.skip("no libmvec")
    assert code == 0 and text.count("holds") == 6 - err.count(": left out"), text + err
    code, text, err = run(
        "claims", "sleef", *words, "--symbols", "_u10", "--out", tmp_path / "b", *small
    )
    if code == 2:
        assert "libsleef.so.3" in err and "cannot be loaded" in err
    else:
        assert text.count("atan2") >= 1


def test_this_c_library_is_held_to_what_it_claims(tmp_path):
    out = tmp_path / "out"
    small = ["--samples", "500", "--evaluations", "2000"]
    code, text, err = run("claims", "libm", "--types", "double", "--out", out, *small)
    assert code == 0, text + err
    assert "4 of 4 hold" in err
    code, _, err = run("claims", "libnone", "--out", out)
    assert code == 2 and "libm, libmvec, sleef" in err
