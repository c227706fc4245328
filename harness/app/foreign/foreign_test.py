"""Tests of foreign functions through the program: what a library does is named with its argument, and the run goes on."""

import json
import pathlib
import subprocess
import sys

import pytest

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "testing"))

from program import run  # noqa: E402

ONE = "0x1p+0"
MATH = ["math", "--samples", "3000", "--timing", "off"]


@pytest.fixture(scope="session")
def library(tmp_path_factory):
    made = tmp_path_factory.mktemp("library") / "libtroublesome.so"
    flags = ["-O1", "-fno-builtin", "-shared", "-fPIC"]
    subprocess.run(
        ["cc", *flags, HERE / "troublesome.c", "-o", made, "-lm"], check=True
    )
    return made


def records(out):
    lines = (out / "math.jsonl").read_text().splitlines()
    return [json.loads(line) for line in lines]


def measured(out, library, symbol, *more, function="sin", type_="double"):
    code, text, err = run(
        *[*MATH, "--functions", function, "--types", type_, "--library", library],
        *["--symbol", symbol, *more, "--out", out],
    )
    return code, err, records(out) if (out / "math.jsonl").exists() else []


def figures(rows):
    """All that a row holds but the names of plan and code."""
    own = ("plan", "implementation")
    return [{k: v for k, v in row.items() if k not in own} for row in rows]


@pytest.fixture(scope="session")
def in_process(tmp_path_factory):
    out = tmp_path_factory.mktemp("in_process") / "run"
    code, _, err = run(*MATH, "--functions", "sin", "--types", "double", "--out", out)
    assert code == 0, err
    return figures(records(out))


def mismatches(rows, outcome):
    return {
        row["stratum"]: (row["mismatch"][outcome], row["mismatch_first"][outcome])
        for row in rows
        if row["mismatch"].get(outcome)
    }


SHAPES = {
    "good_sin": [],
    "arrays_sin": ["--signature", "void(n,d*,d*)"],
    "vector_sin": ["--signature", "v2d(v2d)"],
    "vector_sincos": ["--signature", "void(v2d,d*,d*)"],
    "pointers_sincos": ["--signature", "void(v2d,v2d*,v2d*)"],
}


@pytest.mark.parametrize("symbol", SHAPES)
def test_every_shape_gives_what_a_call_in_process_gives(
    tmp_path, library, in_process, symbol
):
    code, err, rows = measured(tmp_path / "run", library, symbol, *SHAPES[symbol])
    assert code == 0, err
    assert figures(rows) == in_process
    assert {row["implementation"] for row in rows} == {f"libtroublesome.so {symbol}"}


CALLED = {
    "good_sinf": ("sin", "float", []),
    "pointers_sincosf": (
        "cos",
        "float",
        ["--signature", "void(v4f,v4f*,v4f*)"],
    ),
    "good_sinl": ("sin", "long_double", []),
    "sign_lgamma": ("lgamma", "double", ["--signature", "d(d,i*)"]),
    "arrays_pow": ("pow", "double", ["--signature", "void(n,d*,d*,d*)"]),
}


@pytest.mark.parametrize("symbol", CALLED)
def test_other_types_and_numbers_of_arguments(tmp_path, library, symbol):
    function, type_, more = CALLED[symbol]
    code, err, rows = measured(
        tmp_path / "a", library, symbol, *more, function=function, type_=type_
    )
    assert code == 0, err
    own = tmp_path / "b"
    assert run(*MATH, "--functions", function, "--types", type_, "--out", own)[0] == 0
    assert figures(rows) == figures(records(own))


@pytest.mark.parametrize(
    "symbol, outcome, signature",
    [
        ("crash_at_one", "crash", "d(d)"),
        ("exit_at_one", "crash", "d(d)"),
        ("hang_at_one", "hang", "d(d)"),
        ("sleep_at_one", "hang", "d(d)"),
        ("rounds_up_from_one", "environment", "d(d)"),
        ("arrays_crash_at_one", "crash", "void(n,d*,d*)"),
        ("vector_crash_at_one", "crash", "v2d(v2d)"),
    ],
)
def test_what_happens_at_one_argument_is_its_outcome_alone(
    tmp_path, library, in_process, symbol, outcome, signature
):
    more = ["--signature", signature, "--call-timeout", "0.1"]
    code, err, rows = measured(tmp_path / "run", library, symbol, *more)
    assert code == 1, err
    found = mismatches(rows, outcome)
    assert found and all(args == [ONE] for _, args in found.values())
    assert f"{outcome} at" in err and f"ulpgate at sin double {ONE} --library" in err
    # The other strata are untouched.
    clean = [row for row in figures(rows) if row["stratum"] not in found]
    assert clean == [row for row in in_process if row["stratum"] not in found]
    # A second run is the same to the last byte.
    again = measured(tmp_path / "again", library, symbol, *more)
    assert again[0] == 1 and again[2] == rows
    assert (tmp_path / "run/math.jsonl").read_bytes() == (
        tmp_path / "again/math.jsonl"
    ).read_bytes()


@pytest.mark.parametrize("symbol", ["every_second_call", "last_argument"])
def test_hidden_state_is_no_function(tmp_path, library, symbol):
    code, err, rows = measured(tmp_path / "run", library, symbol)
    assert code == 1 and "not_a_function at" in err
    assert mismatches(rows, "not_a_function").keys() >= {
        "uniform",
        "stratified",
        "binades",
    }
    code, _, _ = measured(tmp_path / "again", library, symbol, "--threads", "1")
    assert code == 1
    assert (tmp_path / "run/math.jsonl").read_bytes() == (
        tmp_path / "again/math.jsonl"
    ).read_bytes()


def test_lanes_that_spoil_each_other(tmp_path, library):
    code, err, rows = measured(
        tmp_path / "run", library, "vector_spoiled", "--signature", "v2d(v2d)"
    )
    assert code == 1 and "lane_dependent at" in err
    # No argument of a drawn stratum is a NaN: their neighbours were made ones.
    assert mismatches(rows, "lane_dependent").keys() >= {"uniform", "stratified"}
    assert not mismatches(rows, "not_a_function")


def test_a_library_that_flushes_subnormals_on_loading(tmp_path, library, in_process):
    fast = tmp_path / "libfast.so"
    flags = ["-O1", "-ffast-math", "-fno-builtin", "-shared", "-fPIC"]
    subprocess.run(
        ["cc", *flags, HERE / "troublesome.c", "-o", fast, "-lm"], check=True
    )
    code, err, rows = measured(tmp_path / "run", fast, "good_sin")
    assert code == 1
    assert (
        "on loading it flushes subnormal results to zero (FTZ)" in err
        and "1f80 -> 9f" in err
    )
    # Its functions are called as they would be without that.
    assert figures(rows) == in_process


def test_one_that_hangs_everywhere_ends_the_run(tmp_path, library):
    more = ["--call-timeout", "0.02", "--threads", "1"]
    code, err, _ = measured(tmp_path / "run", library, "hang_always", *more)
    assert code == 1 and "hangs at more than" in err


@pytest.mark.parametrize(
    "words, said",
    [
        (["--library", "libnone.so.9", "--symbol", "sin"], "libnone.so.9"),
        (["--library", "libm.so.6", "--symbol", "sine"], "sine"),
        (["--library", "libm.so.6"], "--symbol"),
        (["--symbol", "sin"], "--library"),
        (["--library", "libm.so.6", "--symbol", "sin", "--signature", "d(d"], "d(d"),
        (
            [
                "--library",
                "libm.so.6",
                "--symbol",
                "sin",
                "--signature",
                "void(v2d,v2d*,d*)",
            ],
            "is none",
        ),
        (
            [
                "--library",
                "libm.so.6",
                "--symbol",
                "sin",
                "--signature",
                "void(v2d,v4d*,v4d*)",
            ],
            "is none",
        ),
        (
            [
                "--library",
                "libm.so.6",
                "--symbol",
                "sin",
                "--signature",
                "void(n,v2d*,v2d*)",
            ],
            "is none",
        ),
        (
            ["--library", "libm.so.6", "--symbol", "sin", "--signature", "f(f)"],
            "another type",
        ),
        (
            ["--library", "libm.so.6", "--symbol", "pow", "--signature", "d(d,d)"],
            "2 argument",
        ),
        (
            ["--library", "libm.so.6", "--symbol", "sin", "--worker", "/bin/none"],
            "/bin/none",
        ),
        (
            ["--library", "libm.so.6", "--symbol", "sin", "--worker", "/bin/true"],
            "worker",
        ),
    ],
)
def test_what_cannot_be_loaded_is_bad_input(words, said):
    code, out, err = run("at", "sin", "double", "1", *words)
    assert code == 2 and said in err, err


def test_a_crash_while_loading(tmp_path):
    source = tmp_path / "a.c"
    source.write_text(
        "void start(void) __attribute__((constructor));\nvoid start(void) { __builtin_trap(); }\n"
    )
    made = tmp_path / "liba.so"
    subprocess.run(["cc", "-shared", "-fPIC", source, "-o", made], check=True)
    code, _, err = run(
        "at", "sin", "double", "1", "--library", made, "--symbol", "start"
    )
    assert code == 2 and "SIGILL" in err


def test_at_and_search(library):
    words = ["--library", library, "--symbol", "crash_at_one"]
    code, out, _ = run("at", "sin", "double", "0.5", "--json", *words)
    point = json.loads(out)
    assert code == 0 and point["implementation"] == "libtroublesome.so crash_at_one"
    code, out, _ = run("at", "sin", "double", "1", *words)
    assert "crash" in out
    hunt = ["search", "sin", "double", "--evaluations", "20000"]
    _, own, _ = run(*hunt, "--json")
    code, out, err = run(*hunt, "--json", "--library", library, "--symbol", "good_sin")
    mine, theirs = json.loads(own), json.loads(out)
    assert theirs["args"] == mine["args"] and theirs["ulp_error"] == mine["ulp_error"]
    assert f"--library {library} --symbol good_sin" in theirs["reproduce"]


LIST = """
library = "{library}"
[[implementation]]
function = "sin"
type = "double"
symbol = "good_sin"
claim_ulp = 0.4
[[implementation]]
function = "lgamma"
type = "double"
symbol = "sign_lgamma"
signature = "d(d,i*)"
"""


def test_a_list_of_implementations(tmp_path, library):
    file = tmp_path / "list.toml"
    file.write_text(LIST.format(library=library))
    out = tmp_path / "run"
    code, _, err = run(*MATH, "--implementations", file, "--out", out)
    # glibc's sine is not within 0.4 ULP.
    assert code == 1 and "claimed to be off by at most 0.4 ULP" in err
    names = {(row["function"], row["implementation"]) for row in records(out)}
    assert names == {
        ("sin", "libtroublesome.so good_sin"),
        ("lgamma", "libtroublesome.so sign_lgamma"),
    }
    context = json.loads((out / "context.json").read_text())
    assert [c["function"] for c in context["foreign"]] == ["sin", "lgamma"]
    assert (
        context["foreign"][0]["path"] == str(library)
        and context["foreign"][0]["build_id"]
    )
    code, _, err = run(
        *MATH, "--implementations", file, "--types", "float", "--out", tmp_path / "none"
    )
    assert code == 3
    for wrong, said in [("symbl = 1\n", "symbl"), ("claim_ulp = -1\n", "claim_ulp")]:
        file.write_text(LIST.format(library=library) + wrong)
        code, _, err = run(*MATH, "--implementations", file, "--out", tmp_path / "bad")
        assert code == 2 and said in err and "list.toml:" in err


def test_the_gate_holds_records_of_a_library_and_names_it(tmp_path, library):
    code, err, _ = measured(tmp_path / "good", library, "good_sin")
    assert code == 0, err
    budgets = ["--budgets", tmp_path / "budgets"]
    assert run("gate", tmp_path / "good", *budgets, "--update")[0] == 0
    assert run("gate", tmp_path / "good", *budgets)[0] == 0
    measured(tmp_path / "bad", library, "crash_at_one")
    code, out, err = run("gate", tmp_path / "bad", *budgets, "--other-plan")
    assert code == 1 and "crash" in out + err
    assert (
        f"ulpgate at sin double {ONE} --library {library} --symbol crash_at_one"
        in out + err
    )


def test_another_build_is_another_plan(tmp_path, library):
    plans = set()
    for symbol in ("good_sin", "arrays_sin"):
        words = [
            "--library",
            library,
            "--symbol",
            symbol,
            *SHAPES[symbol],
            "--dry-run",
            "--out",
            tmp_path,
        ]
        code, out, err = run(*MATH, "--functions", "sin", "--types", "double", *words)
        assert code == 0, err
        plans.add(json.loads(out)["plan"])
    assert len(plans) == 2
