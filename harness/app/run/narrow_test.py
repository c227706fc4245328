"""Tests of narrow bugs through the program itself: planted by a preloaded library, found by the gate, down to one float."""

import json
import pathlib
import sys

import false_failures
import narrow_bugs
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

from program import ROOT, ULPGATE, run  # noqa: E402

sys.path.insert(0, str(ROOT / "scripts/merge"))
import budget_platform  # noqa: E402

SIZE = ["--samples", "1000", "--timing", "off"]


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    return narrow_bugs.build(tmp_path_factory.mktemp("library"))


@pytest.fixture(scope="module")
def budgets(tmp_path_factory):
    """Of the untouched C library."""
    folder = tmp_path_factory.mktemp("clean")
    words = "--functions sin,exp --types float,double --strata narrow".split()
    code, _, err = run("math", *words, *SIZE, "--out", folder / "o")
    assert code == 0, err
    code, _, err = run("gate", folder / "o", "--budgets", folder / "b", "--update")
    assert code == 0, err
    return folder / "b"


BUGS = [
    ("sin", "double", f"sin 3.3 {3.3 * (1 + 1e-3)} 3"),
    ("sin", "double", f"sin -40 {-40 * (1 - 1e-3)} 0"),
    ("exp", "float", f"expf 0.7 {0.7 * (1 + 1e-4)} 3"),
    ("exp", "double", f"exp 1e-5 {1e-5 * (1 + 1e-2)} 3"),
]


@pytest.mark.parametrize("function,token,bug", BUGS)
def test_a16_a_narrow_bug_turns_the_gate_red(
    tmp_path, library, budgets, function, token, bug
):
    words = ["--functions", function, "--types", token, "--strata", "narrow", *SIZE]
    env = narrow_bugs.environment(library, bug)
    code, _, err = run("math", *words, "--out", tmp_path / "o", env=env)
    assert code == 0, err
    gate = ["gate", tmp_path / "o", "--budgets", budgets, "--only-measured"]
    code, out, err = run(*gate)
    assert code == 1, out + err
    assert f"reproduce: ulpgate at {function} {token}" in out
    # The same records without the bug pass.
    code, _, err = run("math", *words, "--out", tmp_path / "o", "--overwrite")
    assert code == 0, err
    assert run(*gate)[0] == 0


def test_a16_one_wrong_float_of_all_turns_the_gate_red(tmp_path, library):
    # One ULP: less than the largest error of many a function at another float.
    env = narrow_bugs.environment(library, "log2f 2.5 2.5 1")
    words = "--functions log2 --types float --strata exhaustive --timing off".split()
    code, _, err = run("math", *words, "--out", tmp_path / "o", env=env)
    assert code == 0, err
    budgets = ROOT / "ci/budgets/exhaustive"
    gate = ["gate", tmp_path / "o", "--budgets", budgets, "--only-measured"]
    code, out, err = run(*gate)
    assert code == 1, out + err
    assert "reproduce: ulpgate at log2 float 0x1.4p+1" in out


def test_a13_other_seeds_and_sizes_fail_with_a_bug_alone(tmp_path, capsys):
    words = "math --functions sqrt --types double --samples 10 --timing off".split()
    code, _, err = run(*words, "--out", tmp_path / "o")
    assert code == 0, err
    if elsewhere := budget_platform.difference(ROOT / "ci/budgets", tmp_path / "o"):
        pytest.skip(elsewhere)
    plan = ["--ulpgate", ULPGATE, "--seeds", "2", "--sizes", "2000,40000"]
    assert false_failures.main([*plan, "--types", "double"]) == 0
    clean = capsys.readouterr().out.splitlines()
    sizes = ["double 2000 samples", "double 40000 samples"]
    assert clean == [f"{size}: 0 of 2 runs red" for size in sizes]
    bug = ["--types", "double", "--functions", "sin", "--bug", "sin 2 4 3"]
    assert false_failures.main([*plan, *bug]) == 0
    red = capsys.readouterr().out
    assert all(f"{size}: 2 of 2 runs red" in red for size in sizes)
    assert "  sin: maximum error in ULP N (2)" in red
    # A bug in an interval that holds nothing passes, and that is told.
    bug = ["--types", "double", "--functions", "sin", "--bug", "sin 4 2 3"]
    assert false_failures.main([*plan, *bug]) == 1


def test_narrow_records_do_not_depend_on_threads_or_reference(tmp_path):
    words = ["math", "--functions", "sin,hypot", "--types", "float,double"]
    words += ["--strata", "narrow", "--samples", "1100", "--timing", "off"]
    records = []
    for i, more in enumerate(
        (["--threads", 1], ["--threads", 3], ["--reference", "full"])
    ):
        code, _, err = run(*words, *more, "--out", tmp_path / str(i))
        assert code == 0, err
        records.append((tmp_path / str(i) / "math.jsonl").read_bytes())
    assert records[0] == records[1] == records[2]
    rows = [json.loads(r) for r in records[0].splitlines()]
    assert len(rows) == 4 and all(r["samples"] == 69 for r in rows)
    # A sample is the worst of thousands of arguments: none is better than a third of an ULP.
    assert all(r["max_ulp"] > 0.49 for r in rows)


def test_narrow_is_asked_for_by_name(tmp_path):
    words = ["math", "--functions", "sqrt", "--types", "float", "--samples", 2]
    code, _, err = run(*words, "--timing", "off", "--out", tmp_path / "o")
    assert code == 0, err
    strata = json.loads((tmp_path / "o/context.json").read_text())["strata"]
    assert "narrow" not in strata and "uniform" in strata
    for more, message in [
        (["--types", "long_double"], "takes float and double"),
        (["--functions", "csin"], "takes real functions"),
        (["--functions", "factorial"], "takes real functions"),
    ]:
        code, _, err = run(
            "math", *more, "--strata", "narrow", *SIZE, "--out", tmp_path / "no"
        )
        assert code == 2 and message in err
