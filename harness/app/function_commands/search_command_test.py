"""Tests of `ulpgate search` through the program itself: determinism, reproducers, worst-case files, messages."""

import json
import os
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

from program import ROOT, ULPGATE, run  # noqa: E402

sys.path.insert(0, str(ROOT / "harness/app/run"))
import narrow_bugs  # noqa: E402

WRONG_EXP = os.environ.get("ULPGATE_WRONG_EXP", "")


def search(function, token, evaluations, *more, program=ULPGATE):
    code, out, err = run(
        "search",
        function,
        token,
        "--evaluations",
        evaluations,
        "--json",
        *more,
        program=program,
    )
    assert code == 0, err
    return json.loads(out)


def test_the_result_depends_on_seed_and_evaluations_alone(tmp_path):
    for function, token in [("erfc", "double"), ("pow", "double"), ("cbrt", "mpfr62")]:
        size = 200000 if token == "double" else 3000
        words = ["search", function, token, "--evaluations", size, "--json"]
        one = run(*words, "--threads", 1)
        three = run(*words, "--threads", 3, "--out", tmp_path / "found.json")
        assert one[0] == 0 and one[1] == three[1]
        found = json.loads(one[1])
        assert found["evaluations"] == size
        assert json.loads((tmp_path / "found.json").read_text()) == found
        other = json.loads(run(*words, "--seed", 2)[1])
        assert (other["args"], other["found_after"]) != (
            found["args"],
            found["found_after"],
        )


@pytest.mark.parametrize(
    "function,token", [("cbrt", "double"), ("pow", "float"), ("cexp", "double")]
)
def test_the_reproducer_reproduces(function, token):
    found = search(function, token, 100000)
    words = found["reproduce"].split()
    assert words[:4] == ["ulpgate", "at", function, token]
    point = json.loads(run(*words[1:], "--json")[1])
    errors = point["ulp_error"]
    worst = max(errors) if isinstance(errors, list) else errors
    assert worst == found["ulp_error"]


def test_the_whole_domain_of_lgamma_is_searched():
    """Its largest errors lie at negative arguments, which the table's map leaves out."""
    found = search("lgamma", "double", 3000000)
    assert float.fromhex(found["args"][0]) < 0
    assert found["ulp_error"] > 3


def test_a_planted_defect_is_found():
    found = search("exp", "double", 50000, program=WRONG_EXP)
    assert found["ulp_error"] > 1e4
    assert search("exp", "double", 50000)["ulp_error"] < 0.52


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    return narrow_bugs.build(tmp_path_factory.mktemp("library"))


def test_a15_a_confirmed_mismatch_is_exit_1(library):
    words = ["search", "sin", "double", "--evaluations", 100000, "--json"]
    assert run(*words)[0] == 0
    env = narrow_bugs.environment(library, "sin 3 3.5 0")
    code, out, err = run(*words, env=env)
    assert code == 1 and "a confirmed mismatch" in err
    found = json.loads(out)["mismatches"]
    assert found and found[0]["confirmed"] > 0
    assert 3 <= float.fromhex(found[0]["args"][0]) <= 3.5


def test_a15_known_hard_arguments_hide_no_smaller_error(library):
    words = ["search", "sin", "double", "--evaluations", 200000, "--json"]
    words += ["--limit", 5]
    code, out, err = run(*words)
    assert code == 0, err
    right = json.loads(out)
    assert right["ulp_error"] > 1e3, "at a hard argument"
    assert 0.5 < right["elsewhere"]["ulp_error"] < 5
    env = narrow_bugs.environment(library, "sin 3.2 3.5 40")
    code, out, err = run(*words, env=env)
    assert code == 1 and "limit 5" in err
    wrong = json.loads(out)
    assert wrong["ulp_error"] > 1e3
    assert wrong["elsewhere"]["ulp_error"] > 39
    assert 3.2 <= float.fromhex(wrong["elsewhere"]["args"][0]) <= 3.5


def test_a_search_made_again_finds_the_same_where_known_stays(tmp_path):
    """A search that is killed after it added its worst case is made again by the night."""
    known, found = tmp_path / "known", tmp_path / "found"
    known.mkdir()
    found.mkdir()
    words = ["--seed", "20260101", "--worst-cases", found]
    first = search("atanh", "float", 2000, *words, "--known", known)
    assert (found / "float.txt").exists()
    assert search("atanh", "float", 2000, *words, "--known", known) == first
    # Without it the second hunt passes over what the first search added.
    assert search("atanh", "float", 2000, *words)["elsewhere"] != first["elsewhere"]


def test_worst_cases_are_added_once_and_only_if_worse(tmp_path):
    words = ["search", "cbrt", "double", "--evaluations", "100000"]
    keep = ["--worst-cases", tmp_path]
    code, out, err = run(*words, *keep)
    assert code == 0 and "added" in err
    file = tmp_path / "double.txt"
    first = file.read_text()
    assert first.count("cbrt") == 1
    code, _, err = run(*words, *keep)
    assert code == 0 and "nothing added" in err and file.read_text() == first
    # A smaller one beside a larger one, and no break at the end of the file.
    file.write_text(first + "sin 1")
    code, _, err = run("search", "cbrt", "double", "--evaluations", 1000, *keep)
    assert "nothing added" in err
    code, _, err = run("search", "sin", "double", "--evaluations", 3000, *keep)
    assert code == 0 and "added" in err
    lines = file.read_text().splitlines()
    assert lines[-2] == "sin 1" and lines[-1].startswith("sin 0x")
    # What was written is what a run replays.
    record = tmp_path / "run"
    code, _, err = run(
        *"math --types double --functions cbrt,sin --strata worst --timing off".split(),
        *keep,
        "--out",
        record,
    )
    assert code == 0, err
    rows = [json.loads(r) for r in (record / "math.jsonl").read_text().splitlines()]
    assert {r["function"]: r["samples"] for r in rows} == {"cbrt": 1, "sin": 2}


BAD = [
    (["search", "sine", "double"], "did you mean 'sin'"),
    (["search", "sin", "dubble"], "did you mean 'double'"),
    (["search", "sin"], "TYPE"),
    (["search", "factorial", "double"], "special function"),
    (["search", "sin", "double", "--seconds", "-1"], "--seconds"),
    (["search", "sin", "double", "--evaluations", "0"], "--evaluations"),
    (
        ["search", "sin", "double", "--evaluations", "9", "--seconds", "1"],
        "excludes",
    ),
    (
        ["search", "sin", "double", "--worst-cases", "/nonexistent"],
        "no such directory",
    ),
]


@pytest.mark.parametrize("words,message", BAD)
def test_bad_usage_is_exit_2_with_a_message(words, message):
    code, _, err = run(*words)
    assert code == 2
    assert message in err


def test_seconds_end_the_hunt_and_mismatches_are_reported():
    code, out, err = run("search", "tgamma", "double", "--seconds", "0.5")
    assert code == 0
    assert "largest ULP error" in out and "reproduce" in out and "evaluations" in out
    assert "ULP at" in err, "it says so as the best improves"
