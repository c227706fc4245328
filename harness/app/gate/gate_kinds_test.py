"""The gate over every kind of record: what was measured passes, what is planted is red, with its command."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "reading"))

from edited_records import edit, lines_of, program, put, run, seal  # noqa: E402

HERTZ = pathlib.Path(__file__).parents[3] / "ci/scenes/hertz.toml"
KEPLER = ["--types", "double", "--problems", "kepler", "--integrators", "rk4"]
# Of each kind: the words that measure it.
KINDS = {
    "function": (
        *("math", "--types", "float", "--functions", "exp,ctan", "--samples", "200"),
        *("--strata", "uniform,stratified,edges", "--timing", "off"),
    ),
    "kernel": (
        *("kernels", "--types", "float", "--kernels", "sphere_sphere"),
        *("--strata", "uniform,far", "--samples", "64"),
    ),
    "scene": (
        *("scene", "run", "pendulum3", "--types", "double", "--steps", "50"),
        "--series",
    ),
    # Not built in: the command needs its file.
    "scene_file": (
        *("scene", "run", HERTZ, "--types", "double", "--steps", "2000"),
        "--series",
    ),
    "collisions": (
        *("scene", "run", "collision", "--types", "double", "--collisions"),
        *("--steps", "20000"),
    ),
    "t_s": (
        *("scene", "correlate", "pendulum3", "--types", "float"),
        *("--reference", "mpfr62", "--steps", "120000", "--series"),
    ),
    "order": ("integrators", *KEPLER),
    "drift": ("integrators", *KEPLER, "--drift", "64"),
    "stress": (
        *("stress", "--types", "float", "--cases"),
        "formula/rump_1988/original_order",
    ),
    "work_precision": (
        *("work-precision", "--cases", "kepler", "--types", "double"),
        *("--integrators", "rk4", "--steps", "256", "--repeats", "0"),
    ),
}
# A limit that is asked for so that what was measured is beyond it.
PLANTED = [
    ("function", "max_ulp"),
    ("kernel", "over_condition"),
    ("scene", "max_energy_error"),
    ("scene_file", "max_energy_error"),
    ("t_s", "t_s"),
    ("order", "measured_order"),
    ("drift", "max_energy_error"),
    ("stress", "outcome"),
    ("work_precision", "final_error"),
]


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """Records of each kind and budgets that just hold for them."""
    place = tmp_path_factory.mktemp("kinds")
    for kind, words in KINDS.items():
        code, out, err = run(*words, "--out", place / kind)
        assert code == 0, (kind, out, err)
        code, out, err = gate(place, kind, "--update")
        assert code == 0, (kind, out, err)
    return place


def gate(place, kind, *words, budgets=None):
    budgets = budgets or place / "budgets" / kind
    return run("gate", place / kind, "--budgets", budgets, *words)


def planted(place, kind, key, to):
    """A copy of the budgets of a kind in which every limit of a name is another one."""
    shutil.copytree(place / "budgets" / kind, to)
    changed = 0
    for file in to.glob("*.toml"):
        text = file.read_text()
        if key == "outcome":
            text, n = re.subn(r'outcome = ".*"', 'outcome = "refused"', text)
        elif key in ("t_s", "measured_order"):
            text, n = re.subn(rf"(?m)^{key} = .*$", f"{key} = 99.0", text)
        elif kind in ("function", "kernel"):
            text, n = re.subn(
                rf"(?m)^{key} = {{.*}}$",
                lambda m: re.sub(r"= [0-9][^ ,]*", "= 1e-9", m[0]),
                text,
            )
        else:
            text, n = re.subn(rf"(?m)^{key} = .*$", f"{key} = 1e-99", text)
        file.write_text(text)
        changed += n
    assert changed
    return to


@pytest.mark.parametrize("kind", KINDS)
def test_what_was_measured_passes(place, kind):
    code, out, err = gate(place, kind)
    assert code == 0 and "FAIL" not in out, out + err


@pytest.mark.parametrize("kind, key", PLANTED)
def test_a_planted_limit_turns_red_with_a_command_that_works(
    place, kind, key, tmp_path
):
    budgets = planted(place, kind, key, tmp_path / "budgets")
    code, out, _ = gate(place, kind, budgets=budgets)
    assert code == 1
    first, reproduce = out.splitlines()[:2]
    assert first.startswith("FAIL ") and "budget" in first
    command = reproduce.split("reproduce: ")[1]
    # As somebody pastes it, with ulpgate on the path.
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/ulpgate").symlink_to(pathlib.Path(program.ULPGATE).resolve())
    done = subprocess.run(
        ["bash", "-c", command],
        cwd=tmp_path,
        env={**os.environ, "PATH": f"{tmp_path / 'bin'}:{os.environ['PATH']}"},
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, (command, done.stderr)
    assert done.stdout


def test_a_point_is_shown_in_hexfloat_and_decimal_with_got_and_wanted(place, tmp_path):
    budgets = planted(place, "function", "max_ulp", tmp_path / "budgets")
    code, out, _ = gate(place, "function", budgets=budgets)
    assert code == 1
    lines = out.splitlines()
    at = next(i for i, line in enumerate(lines) if " exp float: maximum" in line)
    shown = dict(line.strip().split(": ", 1) for line in lines[at + 1 : at + 6])
    assert list(shown) == ["reproduce", "argument", "got", "wanted", "whole row"]
    # The exact value stands in decimal alone: it is in no type.
    assert float(shown["wanted"]) == pytest.approx(
        float(shown["got"].split("(")[1][:-1])
    )
    for name in ("argument", "got"):
        hexadecimal, decimal = re.fullmatch(r"(\S+) \((\S+)\)", shown[name]).groups()
        assert float.fromhex(hexadecimal) == float(decimal)
    point = run(*shown["reproduce"].split()[1:], "--json")[1]
    assert json.loads(point)["value"] == shown["got"].split()[0]


def other_digest(file, quoted):
    """As if the first digest of the file had been another one; the text as it was."""
    text = file.read_text()
    found = re.search(rf'digest = .*?("{quoted}")', text)
    at = found.start(1) + 1
    file.write_text(text[:at] + ("1" if text[at] == "0" else "0") + text[at + 1 :])
    return text


@pytest.mark.parametrize(
    "kind, quoted", [("kernel", "[0-9a-f]{8}"), ("scene", "[0-9a-f]{16}")]
)
def test_other_results_within_every_limit_are_red(place, kind, quoted, tmp_path):
    shutil.copytree(place / "budgets" / kind, tmp_path / "budgets")
    file = next((tmp_path / "budgets").glob("*.toml"))
    text = other_digest(file, quoted)
    code, out, err = gate(
        place, kind, "--markdown", tmp_path / "md", budgets=tmp_path / "budgets"
    )
    assert code == 1 and out.startswith("OTHER RESULTS "), out
    assert "1 rows with other results" in (tmp_path / "md").read_text()
    assert "reproduce: ulpgate " in out.splitlines()[1]
    # Nothing is loosened: no reason is asked for.
    code, out, err = gate(place, kind, "--update", budgets=tmp_path / "budgets")
    assert code == 0 and file.read_text() == text, err
    file.write_text(re.sub(rf'"{quoted}"', '"nonsense!"', text, count=1))
    code, out, err = gate(place, kind, budgets=tmp_path / "budgets")
    digits = "eight" if kind == "kernel" else "sixteen"
    assert code == 2 and f"{digits} hexadecimal digits" in err and ".toml:" in err


# What is wrong whatever a budget says: the file, the line and what is changed in it.
BREACHES = {
    "collisions": ("collisions.jsonl", "ledger", {"beyond": 1}),
    "stress": ("stress.jsonl", "stress", {"as_known": False}),
}


@pytest.mark.parametrize("kind", BREACHES)
def test_a_breach_is_red_and_no_budget_is_made_of_it(place, kind, tmp_path):
    name, what, change = BREACHES[kind]
    shutil.copytree(place / kind, tmp_path / kind)
    shutil.copytree(place / "budgets" / kind, tmp_path / "budgets" / kind)
    rows = [json.loads(line) for line in lines_of(tmp_path / kind / name)]
    number = next(i for i, row in enumerate(rows) if row["what"] == what)
    edit(tmp_path / kind, name, number, put(**change))
    code, out, _ = gate(tmp_path, kind)
    assert code == 1 and out.startswith("FAIL ")
    for budgets in (tmp_path / "budgets" / kind, tmp_path / "new"):
        before = {f: f.read_bytes() for f in budgets.rglob("*")}
        code, out, err = run(
            *("gate", tmp_path / kind, "--budgets", budgets),
            *("--update", "--reason", "no reason is good enough"),
        )
        assert code == 1 and "nothing written" in err and "FAIL" in out
        assert {f: f.read_bytes() for f in budgets.rglob("*")} == before


def test_an_order_that_the_run_found_too_low_is_red(place, tmp_path):
    shutil.copytree(place / "order", tmp_path / "order")
    file = tmp_path / "order/context.json"
    context = json.loads(file.read_text())
    wrong = "rk4 double kepler: order 3.000 measured, 4 expected"
    context["verdicts"]["wrong"] = [wrong]
    file.write_text(json.dumps(context))
    seal(tmp_path / "order")
    code, out, _ = run("gate", tmp_path / "order", "--budgets", place / "budgets/order")
    assert code == 1 and "order 3.000 measured, 4 expected" in out


def test_collisions_that_the_end_cuts_off_are_held(place, tmp_path):
    """Until they have ended nobody knows what they made of energy."""
    words = [*KINDS["collisions"][:-1], "1"]
    for steps in range(200, 20000, 200):
        words[-1] = steps
        shutil.rmtree(tmp_path / "cut", ignore_errors=True)
        code, _, err = run(*words, "--out", tmp_path / "cut")
        assert code == 0, err
        ledger = json.loads(lines_of(tmp_path / "cut/collisions.jsonl")[-1])
        if ledger["still_open"]:
            break
    else:
        pytest.fail("no run ends inside a collision")
    assert (
        run("gate", tmp_path / "cut", "--budgets", tmp_path / "budgets", "--update")[0]
        == 0
    )
    file = tmp_path / "budgets/collision.toml"
    text = file.read_text()
    assert "still_open = 1.0\n" in text
    assert run("gate", tmp_path / "cut", "--budgets", tmp_path / "budgets")[0] == 0
    file.write_text(text.replace("still_open = 1.0\n", "still_open = 0.0\n"))
    code, out, _ = run("gate", tmp_path / "cut", "--budgets", tmp_path / "budgets")
    assert code == 1 and "cut off" in out
    file.write_text(text.replace("still_open = 1.0\n", ""))
    code, out, _ = run("gate", tmp_path / "cut", "--budgets", tmp_path / "budgets")
    assert code == 3 and "NO BUDGET" in out


def test_all_kinds_at_once_and_the_worst_first(place, tmp_path):
    budgets = planted(place, "drift", "max_energy_error", tmp_path / "budgets")
    words = ["gate", *(place / kind for kind in KINDS)]
    for kind in KINDS:
        words += ["--budgets", budgets if kind == "drift" else place / "budgets" / kind]
    code, out, err = run(*words)
    assert code == 1 and out.startswith("FAIL ") and str(place / "drift") in out
    assert err.count("ulpgate: gate: ") == len(KINDS)
    # One that is not there has no verdict, and the others are judged all the same.
    code, out, err = run(*words, place / "nothing", "--budgets", budgets)
    assert code == 2 and "FAIL" in out and "nothing" in err
    code, _, err = run(*words, place / "drift", "--budgets", budgets)
    assert code == 2 and "given twice" in err
    code, _, err = run(*words[:-2])
    assert code == 2 and "one each" in err


def test_the_ratchet_lowers_and_never_loosens(place, tmp_path):
    shutil.copytree(place / "budgets/function", tmp_path / "budgets")
    file = tmp_path / "budgets/float.toml"
    tight = file.read_text()
    loose = re.sub(
        r"(?m)^max_ulp = {.*}$",
        lambda m: re.sub(
            r"(stratified|uniform) = ([0-9.e+]+)",
            lambda n: f"{n[1]} = {float(n[2]) * 4!r}",
            m[0],
        ),
        tight,
    )
    file.write_text(loose)
    code, out, _ = gate(place, "function", budgets=tmp_path / "budgets")
    assert code == 0 and "note" in out and "can be lowered" in out
    assert file.read_text() == loose, "a verdict writes nothing"
    code, out, err = gate(place, "function", "--tighten", budgets=tmp_path / "budgets")
    assert code == 0 and "tightened exp float" in out, err
    assert file.read_text() == tight, "as --update writes it"
    code, out, _ = gate(place, "function", "--tighten", budgets=tmp_path / "budgets")
    assert code == 0 and "tightened" not in out and file.read_text() == tight
    # Red: nothing is lowered.
    red = planted(place, "function", "mean_ulp", tmp_path / "red")
    before = (red / "float.toml").read_text()
    code, _, err = gate(place, "function", "--tighten", budgets=red)
    assert code == 1 and "nothing tightened" in err
    assert (red / "float.toml").read_text() == before
    for words in (["--update"], ["--other-plan"]):
        assert gate(place, "function", "--tighten", *words)[0] == 2
