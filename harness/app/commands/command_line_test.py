"""Tests of the command line through the program itself: output, exit codes, determinism, the gate."""

import json
import os
import pathlib
import shutil
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "reports"))

from ulpgate_report.records.checksums import sealed  # noqa: E402
from ulpgate_report.work_precision import axes  # noqa: E402

ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))
WRONG_EXP = os.environ.get("ULPGATE_WRONG_EXP", "")


def run(*words, program=ULPGATE, cwd=None):
    done = subprocess.run([program, *words], capture_output=True, text=True, cwd=cwd)
    return done.returncode, done.stdout, done.stderr


def math(out, *words, program=ULPGATE):
    base = [
        "math",
        "--out",
        str(out),
        "--timing",
        "off",
        "--worst-cases",
        "ci/worst_cases",
    ]
    code, _, err = run(*base, *words, program=program, cwd=ROOT)
    assert code in (0, 1), err
    return (out / "math.jsonl").read_bytes()


BAD_USAGE = [
    (["at", "sine", "double", "1"], "did you mean 'sin'"),
    (["at", "sin", "dubble", "1"], "did you mean 'double'"),
    (["at", "sin", "double"], "takes 1 argument"),
    (["at", "pow", "double", "1"], "takes 2 arguments"),
    (["at", "ctan", "double", "1"], "real and imaginary"),
    (["at", "sin", "double", "1.5x"], "is not a number"),
    (["at", "sin", "double", ""], "is not a number"),
    (["at", "sin", "double", "0x"], "is not a number"),
    (["at", "factorial", "double", "2.5"], "must be an integer"),
    (["at", "factorial", "double", "-1"], "must be an integer"),
    (["at", "sin", "mpfr62", "1e9999999"], "lies beyond"),
    (["at", "sin", "double", "1", "--jsn"], "unknown option"),
    (["at"], "usage"),
    (["list", "nothing"], "nothing"),
    (["math", "--out", "x", "--samples", "0"], "--samples"),
    (["math", "--out", "x", "--samples", "-5"], "--samples"),
    (["math", "--out", "x", "--shard", "3/3"], "0 <= i < n"),
    (["math", "--out", "x", "--strata", "unifrm"], "did you mean 'uniform'"),
    (["math"], "--out"),
    (["nosuchverb"], ""),
    ([], "subcommand"),
    (["gate", "/nonexistent", "--budgets", "/nonexistent"], "no such directory"),
    (["report", "x"], "give --out"),
    (["report", "x", "--print", "--axes", "error,dt"], "--out"),
]


@pytest.mark.parametrize("words,message", BAD_USAGE)
def test_bad_usage_is_exit_2_with_a_message(words, message, tmp_path):
    code, _, err = run(*words, cwd=tmp_path)
    assert code == 2
    assert message in err
    assert not (tmp_path / "x").exists()


def test_the_report_is_told_the_axes(tmp_path):
    words = ["work-precision", "--subjects", "sin", "--types", "float,double"]
    words += ["--samples", "100", "--repeats", "1", "--out", tmp_path / "records"]
    code, _, err = run(*words)
    assert code == 0, err
    report = ["report", tmp_path / "records", "--out", tmp_path / "report", "--axes"]
    code, _, err = run(*report, "error,price")
    assert code == 2 and "'error,price' is not two of" in err
    assert not (tmp_path / "report").exists()
    code, _, err = run(*report, "seconds,error", "--axes", "largest_error,seconds")
    assert code == 0, err
    drawn = {path.stem for path in (tmp_path / "report/figures").glob("*.svg")}
    assert drawn == {
        "work_precision_function_seconds_error",
        "work_precision_function_largest_error_seconds",
    }
    help_text = " ".join(run("report", "--help")[1].split())
    for name in axes.QUANTITIES:
        assert name in help_text


def test_list_types_is_the_published_table():
    rows = json.loads(run("list", "types", "--json")[1])
    facts = {
        r["token"]: (
            r["total_bits"],
            r["decimal_places"],
            r["exponent_bits"],
            r["significand_bits"],
        )
        for r in rows
    }
    wanted = {
        "float": (32, 6, 8, 24),
        "double": (64, 15, 11, 53),
        "long_double": (80, 18, 15, 64),
        "float128": (128, 33, 15, 113),
        "mpfr62": (None, 62, None, 207),
        "mpfr150": (None, 150, None, 500),
        "cpp_bin_float62": (None, 62, None, 207),
    }
    for token, fact in facts.items():
        assert fact == wanted[token]


def test_at_json_has_the_documented_keys():
    code, out, _ = run("at", "tgamma", "double", "-0x1.5p+2", "--json")
    point = json.loads(out)
    assert code == 0
    for (
        key
    ) in "function type args value reference ulp_error float_distance condition outcome".split():
        assert key in point
    assert point["args"] == ["-0x1.5p+2"]
    assert point["outcome"] == "finite"
    assert abs(point["condition"] - 25.6832424) < 1e-6


def test_complex_tan_in_double_is_judged_right():
    for z in (["1", "30"], ["-2.5", "-90"], ["0.3", "700"], ["1e-300", "1e-300"]):
        point = json.loads(run("at", "ctan", "double", *z, "--json")[1])
        assert max(point["ulp_error"]) < 3, point


# A build may leave it out: the sanitised one does.
HAS_CPP_BIN_FLOAT = "cpp_bin_float62" in run("list", "types")[1]


@pytest.mark.skipif(not HAS_CPP_BIN_FLOAT, reason="cpp_bin_float62 is not built")
def test_lgamma_of_cpp_bin_float_is_wrong_between_1_and_3():
    code, out, _ = run("at", "lgamma", "cpp_bin_float62", "2.84", "--json")
    assert code == 0
    assert json.loads(out)["ulp_error"] > 1e4


@pytest.mark.skipif(
    "ULPGATE_SANITIZED" in os.environ, reason="slow starts; the gate runs all edges"
)
def test_no_special_argument_crashes(tmp_path):
    functions = json.loads(run("list", "functions", "--json")[1])
    for f in functions:
        if f["class"] == "special":
            continue
        for x in ("nan", "-inf", "1e300"):
            code, out, err = run(
                "at", f["function"], "double", *[x] * f["arity"], "--json"
            )
            assert code == 0, (f, x, err)
            json.loads(out)


SMALL = [
    "--types",
    "float,double," + ("cpp_bin_float62" if HAS_CPP_BIN_FLOAT else "mpfr62"),
    "--functions",
    "sin,pow,tgamma,ctan,laguerre",
]


def test_records_do_not_depend_on_threads_or_shards(tmp_path):
    # More than a unit of work has.
    size = ["--samples", "2500", "--seed", "4", *SMALL]
    one = math(tmp_path / "one", "--threads", "1", *size)
    two = math(tmp_path / "two", "--threads", "2", *size)
    assert one == two
    parts = []
    for i in (2, 0, 1):
        parts.append(str(tmp_path / f"part{i}"))
        math(tmp_path / f"part{i}", "--shard", f"{i}/3", *size)
    code, _, err = run("merge", *parts, "--out", str(tmp_path / "merged"))
    assert code == 0, err
    assert (tmp_path / "merged/math.jsonl").read_bytes() == one
    code, _, err = run("merge", *parts[:2], "--out", str(tmp_path / "partial"))
    assert code == 3 and "2 of 3 shards" in err
    code, _, err = run("merge", parts[0], parts[0], "--out", str(tmp_path / "twice"))
    assert code == 2 and "twice" in err
    context = pathlib.Path(parts[1]) / "context.json"
    other = json.loads(context.read_text()) | {"cpu": "another"}
    del other["checksum"]
    context.write_text(sealed(json.dumps(other, indent=2)))
    code, _, err = run("merge", *parts, "--out", str(tmp_path / "mixed"))
    assert code == 2 and 'cpu "another"' in err and parts[1] in err
    assert not (tmp_path / "mixed").exists()
    allowed = ["--allow-other-machine", "--out", str(tmp_path / "mixed")]
    code, _, err = run("merge", *parts, *allowed)
    assert code == 0 and err.count('cpu "another"') == 1 and parts[1] in err


def test_the_screened_reference_gives_the_records_of_the_full_one(tmp_path):
    words = ["--samples", "300", "--types", "double,mpfr62"]
    words += ["--functions", "sin,pow,lgamma,cpow,add"]
    full = math(tmp_path / "full", *words, "--reference", "full")
    assert math(tmp_path / "screened", *words, "--reference", "screened") == full


def test_another_seed_gives_another_plan_and_is_not_written_over(tmp_path):
    size = ["--types", "double", "--functions", "sin", "--samples", "100"]
    math(tmp_path / "a", "--seed", "1", *size)
    code, _, err = run("math", "--out", str(tmp_path / "a"), "--seed", "2", *size)
    assert code == 2 and "another plan" in err
    code, _, err = run(
        "math", "--out", str(tmp_path / "a"), "--seed", "2", "--overwrite", *size
    )
    assert code == 0, err


def test_truncated_and_mixed_records_are_named(tmp_path):
    run_dir = tmp_path / "a"
    math(run_dir, "--types", "double", "--functions", "sin,cos", "--samples", "100")
    text = (run_dir / "math.jsonl").read_text()
    (run_dir / "math.jsonl").write_text(text[: len(text) - 30])
    code, _, err = run("gate", str(run_dir), "--budgets", str(tmp_path))
    assert code == 2
    assert f"math.jsonl:{len(text.splitlines())}" in err


def test_worst_case_files_are_checked(tmp_path):
    (tmp_path / "double.txt").write_text("# comment\nsin 1\nsin 1 2\n")
    code, _, err = run(
        "math",
        "--types",
        "double",
        "--out",
        str(tmp_path / "o"),
        "--worst-cases",
        str(tmp_path),
    )
    assert code == 2 and "double.txt:3" in err


def test_broken_budget_files_are_named_with_line_and_key(tmp_path):
    run_dir = tmp_path / "a"
    math(run_dir, "--types", "double", "--functions", "sin", "--samples", "100")
    budgets = tmp_path / "budgets"
    budgets.mkdir()
    file = budgets / "double.toml"
    for text, where in [
        ('[budget."sin"]\nmax_ulp = 0.5\n', "double.toml:2"),
        ('[budget."sin"]\nmax_ulp = { edges = "high" }\n', "double.toml:2"),
        ('[budget."sin"]\nmax_ulp = { egdes = 0.5 }\n', "no stratum 'egdes'"),
        ('[budget."sin"]\nmax_upl = 1\n', "double.toml:2"),
        ('[budget."sin"\n', "double.toml:1"),
        ("[other]\nx = 1\n", "double.toml:1"),
    ]:
        file.write_text(text)
        code, _, err = run("gate", str(run_dir), "--budgets", str(budgets))
        assert code == 2 and where in err, (text, err)


def test_full_disk_is_exit_4_and_keeps_the_old_file():
    if not os.access("/dev/full", os.W_OK):
        pytest.skip("no /dev/full")
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [ULPGATE, "list", "functions"], stdout=full, stderr=subprocess.PIPE
        )
    assert done.returncode == 4


def test_gate_passes_then_names_the_wrong_exp_first(tmp_path):
    size = [
        "--types",
        "double",
        "--functions",
        "real",
        "--strata",
        "uniform,edges",
        "--samples",
        "400",
    ]
    math(tmp_path / "good", *size)
    budgets = str(tmp_path / "budgets")
    assert run("gate", str(tmp_path / "good"), "--budgets", budgets, "--update")[0] == 0
    assert run("gate", str(tmp_path / "good"), "--budgets", budgets)[0] == 0
    math(tmp_path / "bad", *size, program=WRONG_EXP)
    code, out, _ = run("gate", str(tmp_path / "bad"), "--budgets", budgets)
    assert code == 1
    first, reproduce = out.splitlines()[:2]
    assert first.startswith("FAIL") and " exp double" in first
    words = reproduce.split("ulpgate ")[1].split()
    point = json.loads(run(*words, "--json", program=WRONG_EXP)[1])
    assert point["ulp_error"] > 1e3
    assert json.loads(run(*words, "--json")[1])["ulp_error"] < 1
    code, out, _ = run("gate", str(tmp_path / "bad"), "--budgets", budgets, "--update")
    assert code == 1 and "WOULD LOOSEN exp double" in out


def test_gate_of_nothing_is_exit_3(tmp_path):
    (tmp_path / "empty").mkdir()
    code, _, err = run(
        "gate", str(tmp_path / "empty"), "--budgets", str(ROOT / "ci/budgets")
    )
    assert code == 3 and "nothing measured" in err
    code = subprocess.run(
        [ROOT / "ci/gate", "--ulpgate", ULPGATE, "--records", tmp_path / "empty"],
        capture_output=True,
    ).returncode
    assert code == 3


def test_interrupt_keeps_what_was_done(tmp_path):
    process = subprocess.Popen(
        [
            ULPGATE,
            "math",
            "--types",
            "double",
            "--samples",
            "20000000",
            "--functions",
            "real",
            "--strata",
            "uniform",
            "--out",
            str(tmp_path / "o"),
            "--timing",
            "off",
        ],
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
    )
    try:
        process.wait(timeout=3)
    except subprocess.TimeoutExpired:
        process.terminate()
    _, err = process.communicate(timeout=120)
    assert process.returncode == 3 and "interrupted" in err
    context = json.loads((tmp_path / "o/context.json").read_text())
    assert context["complete"] is False
    shutil.rmtree(tmp_path / "o")
