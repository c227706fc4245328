"""Tests of what gate, merge and --resume accept of a run's directory: nothing that the run did not write."""

import json
import json
import pathlib
import shutil
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from edited_records import edit, lines_of, put, run, seal, sealed, without  # noqa: E402

FUNCTIONS = ["math", "--functions", "sin,csqrt", "--types", "double", "--threads", "1"]
FUNCTIONS += ["--samples", "40", "--strata", "uniform,edges", "--timing", "off"]
KERNELS = ["kernels", "--kernels", "rotation", "--types", "double", "--samples", "6"]
KERNELS += ["--strata", "uniform,typical", "--threads", "1"]
ORDERS = ["integrators", "--integrators", "velocity_verlet,pefrl", "--types", "double"]
ORDERS += ["--problems", "oscillator", "--threads", "1"]


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A run of each kind, and shards of functions; tests work on copies."""
    there = tmp_path_factory.mktemp("whole")
    for name, words in (("math", FUNCTIONS), ("kernels", KERNELS), ("orders", ORDERS)):
        code, _, err = run(*words, "--out", there / name)
        assert code == 0, err
    for i in range(2):
        code, _, err = run(*FUNCTIONS, "--shard", f"{i}/2", "--out", there / f"{i}")
        assert code == 0, err
    budgets = ["--budgets", there / "budgets", "--update"]
    assert run("gate", there / "math", *budgets)[0] == 0
    return there


@pytest.fixture
def copy(whole, tmp_path):
    def of(name):
        return shutil.copytree(whole / name, tmp_path / name)

    return of


def edit_context(directory, **values):
    file = directory / "context.json"
    file.write_text(json.dumps({**json.loads(file.read_text()), **values}, indent=2))
    seal(directory)


def judged(name, out):
    """Whoever reads records: merge needs no budgets."""
    return run("merge", name, "--out", out)


def test_what_the_run_wrote_is_read(whole, tmp_path):
    for name in ("math", "kernels"):
        code, _, err = judged(whole / name, tmp_path / name)
        assert code == 0, err
        file = f"{name}.jsonl"
        assert (tmp_path / name / file).read_bytes() == (
            whole / name / file
        ).read_bytes()
    code, _, err = run("merge", whole / "0", whole / "1", "--out", tmp_path / "m")
    assert code == 0, err
    assert (tmp_path / "m/math.jsonl").read_bytes() == (
        whole / "math/math.jsonl"
    ).read_bytes()
    assert run(*ORDERS, "--out", whole / "orders", "--resume")[0] == 0


def in_histogram(row):
    row["histogram"]["exact"] += 1
    return row


def in_bucket(value):
    def change(row):
        row["histogram"]["buckets"][0][0] = value
        return row

    return change


LIES = [
    ("math", put(max_ulp=-1), "largest error"),
    ("math", put(max_ulp=None), "largest error"),
    ("math", put(max_ulp="inf"), "max_ulp"),
    ("math", put(max_ulp="big"), "inf"),
    ("math", put(mood=1), "unknown key 'mood'"),
    ("math", put(samples=0, planned=0), "no samples"),
    ("math", put(samples=1), "do not add up"),
    ("math", put(samples=-1), "integer"),
    ("math", put(ulp_sum="garbage"), "ulp_sum"),
    ("math", put(ulp_sum="ffffffffffffff"), "ulp_sum"),
    ("math", put(correctly_rounded=10**6), "correctly rounded"),
    ("math", put(mean_ulp=0.125), "mean_ulp"),
    ("math", put(p50_ulp=0.125), "p50_ulp"),
    ("math", put(p99_ulp=1e9), "p99_ulp"),
    ("math", put(argmax=[]), "argmax"),
    ("math", put(type=5), "string"),
    ("math", put(plan="0123456789abcdef"), "plan"),
    ("math", put(seed=3), "seed 3"),
    ("math", put(function="cos"), "not among the rows"),
    ("math", in_histogram, "histogram"),
    ("math", in_bucket(-1e29), "whole number"),
    ("math", in_bucket(2**40), "whole number"),
    ("math", in_bucket(1.5), "whole number"),
    ("math", without("max_ulp_over_condition"), "max_ulp_over_condition"),
    ("math", put(max_ulp_over_condition=None), "condition"),
    ("kernels", without("max_normwise_over_condition"), "max_normwise_over_condition"),
    ("kernels", put(max_normwise_over_condition=None), "condition"),
    ("kernels", put(verdict="splendid"), "verdict"),
]


@pytest.mark.parametrize("kind,change,named", LIES)
def test_a11_figures_that_no_measurement_gives(copy, tmp_path, kind, change, named):
    directory = copy(kind)
    number = next(
        i
        for i, line in enumerate(lines_of(directory / f"{kind}.jsonl"))
        if json.loads(line)["histogram"]["buckets"] or kind == "kernels"
    )
    edit(directory, f"{kind}.jsonl", number, change)
    code, _, err = judged(directory, tmp_path / "out")
    assert code == 2 and f"{kind}.jsonl:{number + 1}:" in err and named in err, err


def test_a11_a_row_is_there_once(copy, tmp_path):
    directory = copy("math")
    file = directory / "math.jsonl"
    lines = lines_of(file)
    file.write_text("\n".join([*lines, lines[0]]) + "\n")
    seal(directory)
    code, _, err = judged(directory, tmp_path / "out")
    assert code == 2 and f"math.jsonl:{len(lines) + 1}:" in err, err
    assert "second record" in err and "math.jsonl:1" in err


@pytest.mark.parametrize("more", [[], ["--only-measured"]])
def test_a11_the_gate_misses_a_planned_row(copy, whole, more):
    directory = copy("math")
    gate = ["gate", directory, "--budgets", whole / "budgets", *more]
    code, _, err = run(*gate)
    assert code == 0, err
    edit(directory, "math.jsonl", 0, lambda row: None)
    code, _, err = run(*gate)
    assert code == 3 and "csqrt im double edges" in err, err


def test_a11_the_gate_notices_any_other_edit(copy, whole):
    directory = copy("math")
    edit(directory, "math.jsonl", 0, put(got="0x1p+0"), sealing=False)
    code, _, err = run("gate", directory, "--budgets", whole / "budgets")
    assert code == 2 and "math.jsonl: not as the run wrote it" in err, err


def test_a10_resume_reads_what_is_complete_already(copy):
    directory = copy("math")
    file = directory / "math.jsonl"
    resume = [*FUNCTIONS, "--out", directory, "--resume"]
    code, _, err = run(*resume)
    assert code == 0 and "complete already" in err
    whole = file.read_text()
    file.write_text("")
    code, _, err = run(*resume)
    assert code == 3 and "math.jsonl" in err and "complete already" not in err, err
    file.write_text("".join(whole.splitlines(keepends=True)[:-1]))
    code, _, err = run(*resume)
    assert code == 3 and "sin value double uniform" in err, err
    file.write_text(whole.replace("0x1", "0x2", 1))
    code, _, err = run(*resume)
    assert code == 2 and "math.jsonl" in err, err
    file.unlink()
    code, _, err = run(*resume)
    assert code == 3 and "math.jsonl" in err, err


def test_a10_resume_reads_the_records_of_integrators(copy):
    directory = copy("orders")
    file = directory / "orders.jsonl"
    resume = [*ORDERS, "--out", directory, "--resume"]
    code, _, err = run(*resume)
    assert code == 0, err
    whole = file.read_text()
    for edited, named in (
        ("", "orders.jsonl"),
        (whole[: len(whole) // 2], "orders.jsonl:"),
        (whole + whole.splitlines()[0] + "\n", "second record"),
        (whole.replace('"order":', '"ordre":', 1), "orders.jsonl:1"),
        (whole.replace('"steps":1,', '"steps":3,', 1), "orders.jsonl"),
    ):
        file.write_text(edited)
        code, _, err = run(*resume)
        assert code == 2 and named in err, (named, err)
    file.write_text(whole)
    context = directory / "context.json"
    context.write_text(context.read_text().replace('"judged": ', '"judged": 1'))
    code, _, err = run(*resume)
    assert code == 2 and "context.json" in err, err


def interrupted(directory):
    """What an interrupt leaves: fewer rows, and a context that says so."""
    file = directory / "math.jsonl"
    file.write_text("".join(file.read_text().splitlines(keepends=True)[1:]))
    edit_context(directory, finished=False, complete=False)


def test_a2_an_interrupted_shard_is_no_whole_run(copy, tmp_path):
    first, second = copy("0"), copy("1")
    interrupted(first)
    code, _, err = run("merge", first, second, "--out", tmp_path / "m")
    assert code == 3 and "interrupted" in err and "absent" in err, err
    context = json.loads((tmp_path / "m/context.json").read_text())
    assert context["complete"] is False and context["finished"] is False
    assert (tmp_path / "m/math.jsonl").stat().st_size > 0


def test_a2_a_shard_lacks_rows_that_it_was_dealt(copy, tmp_path):
    first, second = copy("0"), copy("1")
    merge = ["merge", first, second, "--out", tmp_path / "m"]
    edit(first, "math.jsonl", 0, lambda row: None)
    code, _, err = run(*merge)
    name = "0/math.jsonl: absent"
    assert code == 3 and name in err, err
    (first / "math.jsonl").write_text("")
    seal(first)
    code, _, err = run(*merge)
    assert code == 3 and name in err, err


@pytest.mark.parametrize("shards", [[], ["0"], ["2/2"], ["0/2", "0/2"], [7], "0/2"])
def test_a2_shards_are_names_of_shards(copy, tmp_path, shards):
    directory = copy("0")
    edit_context(directory, shards=shards)
    code, _, err = judged(directory, tmp_path / "m")
    assert code == 2 and "context.json" in err, err


def test_a2_oracles_that_disagree_in_a_shard(copy, whole, tmp_path):
    directory = copy("math")
    number = next(
        i
        for i, line in enumerate(lines_of(directory / "math.jsonl"))
        if '"sin"' in line and json.loads(line)["oracle"]["compared"] > 0
    )

    def disagree(row):
        row["oracle"]["disagreed"] = 1
        row["oracle"]["max_difference_ulp"] = 0.25
        return row

    edit(directory, "math.jsonl", number, disagree)
    code, _, err = judged(directory, tmp_path / "m")
    assert code == 1 and "the oracles disagree: sin value double" in err, err
    assert (tmp_path / "m/math.jsonl").exists()
    code, _, err = run("gate", directory, "--budgets", whole / "budgets")
    assert code == 1 and "the oracles disagree: sin value double" in err, err


@pytest.mark.parametrize(
    "shard,code",
    [
        ("0/18446744073709551615", 2),
        ("18446744073709551614/18446744073709551615", 2),
        ("4999/5000", 3),
    ],
)
def test_c_a_shard_of_nothing(tmp_path, shard, code):
    words = [*FUNCTIONS, "--shard", shard, "--out", tmp_path / "o"]
    found, _, err = run(*words)
    assert found == code and "--shard" in err, err
    assert not (tmp_path / "o/math.jsonl").exists()


@pytest.mark.parametrize(
    "text",
    ["[]", "7", "", "{}", '{"plan": 5}', "[" * 10000, '{"plan": "\\ud800"}'],
)
def test_c_a_context_that_is_none(copy, tmp_path, text):
    directory = copy("math")
    (directory / "context.json").write_text(text)
    code, _, err = judged(directory, tmp_path / "m")
    assert code == 2 and "context.json" in err, err
    code, _, err = run(*FUNCTIONS, "--out", directory, "--resume")
    assert code == 2 and str(directory) in err, err


@pytest.mark.parametrize(
    "values",
    [
        {"complete": "yes"},
        {"finished": False},
        {"types": 3},
        {"planned": []},
        {"planned": {}},
        {"planned": {"double": {"sin": {"uniform": -4}}}},
        {"planned": {"double": {"sin": {"mild": 4}}}},
        {"functions": [{"name": "sin"}]},
        {"seed": "one"},
        {"plan_text": "another"},
        {"records_checksum": {"math.jsonl": 4}},
    ],
)
def test_c_wrong_types_in_a_context(copy, tmp_path, values):
    directory = copy("math")
    file = directory / "context.json"
    context = {**json.loads(file.read_text()), **values}
    context.pop("checksum", None)
    file.write_text(sealed(json.dumps(context, indent=2)))
    code, _, err = judged(directory, tmp_path / "m")
    assert code == 2 and "context.json" in err and "internal" not in err, err


def test_c_a_context_with_another_byte(copy, tmp_path):
    directory = copy("math")
    file = directory / "context.json"
    file.write_text(file.read_text().replace('"threads": 1', '"threads": 2'))
    code, _, err = judged(directory, tmp_path / "m")
    assert code == 2 and "context.json: not as the run wrote it" in err, err


def test_c_a_directory_is_no_file(copy, tmp_path):
    directory = copy("math")
    (directory / "math.jsonl").unlink()
    (directory / "math.jsonl").mkdir()
    code, _, err = judged(directory, tmp_path / "m")
    assert code == 2 and "math.jsonl: a directory" in err, err
    (tmp_path / "worst/double.txt").mkdir(parents=True)
    words = [*FUNCTIONS[:-6], "--samples", "4", "--strata", "worst"]
    words += ["--worst-cases", tmp_path / "worst", "--out", tmp_path / "o"]
    code, _, err = run(*words)
    assert code == 2 and "double.txt: a directory" in err, err
