"""Tests of ulpgate compare: what got worse, better, lost or slower between two runs, and that nothing else is said."""

import json
import pathlib
import shutil
import sys

import pytest

HERE = pathlib.Path(__file__)
sys.path.insert(0, str(HERE.parents[1] / "testing"))
sys.path.insert(0, str(HERE.parents[1] / "reading"))

from edited_records import seal  # noqa: E402
from program import run  # noqa: E402

SIZE = ["--samples", "200", "--strata", "uniform,edges", "--timing"]


def math(out, *more, timing=("off",)):
    words = ["math", "--types", "double", *SIZE, *timing, "--out", out]
    assert run(*words, *more)[0] == 0
    return out


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("runs")
    math(folder / "a", "--functions", "exp,sin")
    math(folder / "fewer", "--functions", "exp")
    math(folder / "seed", "--functions", "exp,sin", "--seed", "2")
    return folder


def compared(*words):
    code, out, err = run("compare", *words, "--json")
    return code, json.loads(out) if out else None, err


def test_a_run_is_like_itself(runs, tmp_path):
    code, found, _ = compared(runs / "a", runs / "a")
    assert code == 0 and found["compared"] == found["same"] == 4
    assert found["rows"] == found["only_before"] == found["only_after"] == []
    code, out, _ = run(
        "compare", runs / "a", runs / "a", "--markdown", tmp_path / "m.md"
    )
    assert code == 0 and "4 the same, 0 worse, 0 better" in out
    assert "4 the same" in (tmp_path / "m.md").read_text()


def test_rows_that_are_lost_are_no_pass(runs):
    code, found, _ = compared(runs / "a", runs / "fewer")
    assert code == 3 and {k["name"] for k in found["only_before"]} == {"sin"}
    code, found, _ = compared(runs / "fewer", runs / "a")
    assert code == 0 and {k["name"] for k in found["only_after"]} == {"sin"}
    assert run("compare", runs / "a", runs / "fewer", "--only-common")[0] == 0
    # Of another seed the drawn points are others: only what is no draw can be compared.
    code, found, _ = compared(runs / "a", runs / "seed")
    assert code == 3


def test_another_platform_is_compared_and_named(runs, tmp_path):
    there = tmp_path / "newer"
    shutil.copytree(runs / "a", there)
    context = json.loads((there / "context.json").read_text())
    context["libraries"]["glibc"] = "2.99"
    (there / "context.json").write_text(json.dumps(context))
    seal(there)
    code, found, _ = compared(runs / "a", there)
    assert code == 0 and "glibc" in found["platform"] and "2.99" in found["platform"]
    code, out, _ = run("compare", runs / "a", there)
    assert code == 0 and "-> 2.99" in out


def test_times_need_repeats(runs, tmp_path):
    code, found, _ = compared(runs / "a", runs / "a")
    assert found["times"] == [] and "no times" in found["times_not_judged"]
    once = math(tmp_path / "once", "--functions", "exp", timing=("on",))
    code, found, _ = compared(once, once)
    assert code == 0 and "--timing repeats" in found["times_not_judged"]


def slowed(directory, name, factor):
    """The same run with one row's repeats longer: times are under no checksum."""
    file = directory / "timing_repeats.jsonl"
    rows = [json.loads(line) for line in file.read_text().splitlines()]
    for row in rows:
        if row["what"] == name:
            row["ns"] = [[factor * t for t in times] for times in row["ns"]]
    file.write_text("".join(json.dumps(row) + "\n" for row in rows))


def calmed(directory):
    """The same run as on a machine that nothing disturbs: repeats within 2 % of each other."""
    file = directory / "timing_repeats.jsonl"
    rows = [json.loads(line) for line in file.read_text().splitlines()]
    for row in rows:
        for key in ("ns", "baseline_ns"):
            least = min(min(times) for times in row[key])
            row[key] = [
                [least * (1 + 0.004 * ((3 * i + j) % 5)) for i in range(len(times))]
                for j, times in enumerate(row[key])
            ]
    file.write_text("".join(json.dumps(row) + "\n" for row in rows))


def test_a_slower_function_is_named_and_no_other(tmp_path):
    repeats = ("repeats", "--timing-processes", "5", "--timing-rounds", "7")
    first = math(tmp_path / "first", "--functions", "exp,sin,log,atan", timing=repeats)
    calmed(first)
    for factor, word, code in (
        (3, "slower", 1),
        (1 / 3, "faster", 0),
        (1.01, "the same", 0),
    ):
        second = tmp_path / word
        shutil.copytree(first, second)
        slowed(second, "exp", factor)
        found_code, found, _ = compared(first, second)
        assert found_code == code, found["times"]
        changes = {t["name"]: t["change"] for t in found["times"]}
        assert changes == {
            "exp": word,
            "sin": "the same",
            "log": "the same",
            "atan": "the same",
        }
    code, _, err = run("compare", first, tmp_path / "slower")
    assert code == 1


def test_torn_times_are_refused(tmp_path):
    first = math(tmp_path / "a", "--functions", "exp", timing=("repeats",))
    file = first / "timing_repeats.jsonl"
    whole = file.read_text()
    for text in (
        whole[:-1],
        whole.replace("baseline_ns", "b"),
        whole.replace("[", "[-1,", 1),
    ):
        file.write_text(text)
        code, _, err = run("compare", first, first)
        assert code == 2 and f"{file}:1" in err


def test_what_is_no_run_is_refused(runs, tmp_path):
    assert run("compare", runs / "a", tmp_path)[0] == 2
    assert run("compare", runs / "a")[0] == 2
    broken = tmp_path / "broken"
    shutil.copytree(runs / "a", broken)
    text = (broken / "math.jsonl").read_text()
    (broken / "math.jsonl").write_text(text.replace('"samples":', '"samples": ', 1))
    code, _, err = run("compare", runs / "a", broken)
    assert code == 2 and "math.jsonl" in err
