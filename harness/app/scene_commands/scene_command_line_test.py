"""Tests of the verbs below `scene`: their options, what they refuse, what they print and write."""

import csv
import json
import pathlib
import signal
import subprocess
import sys
import time

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

from program import ROOT, ULPGATE, run  # noqa: E402

VERBS = "run explain compare ladder correlate speed".split()
MODEL = {"--types", "--set", "--dt", "--allow-large", "--help"}
STEPS = {"--threads", "--timeout"}
LENGTH = STEPS | {"--integrator", "--until", "--steps", "--all-parts", "--json"}
RECORD = {"--out", "--record", "--series", "--snapshots", "--vtk", "--overwrite"}
CHECKPOINTS = {"--resume", "--checkpoint-seconds"}
OPTIONS = {
    "run": MODEL | LENGTH | RECORD | CHECKPOINTS | {"--collisions"},
    "explain": MODEL | STEPS,
    "compare": MODEL | LENGTH | RECORD | {"--own-constants"},
    "ladder": MODEL,
    "correlate": MODEL
    | LENGTH
    | RECORD
    | CHECKPOINTS
    | {"--reference", "--trust-reference"},
    "speed": MODEL | LENGTH | {"--out", "--repeats"},
}
EVERY = sorted(set().union(*OPTIONS.values()) - {"--help"})
FLAGS = "--allow-large --all-parts --json --record --series --vtk --overwrite --resume --own-constants --collisions --trust-reference"


@pytest.mark.parametrize("verb", VERBS)
def test_help_has_a_purpose_two_examples_and_exactly_the_options(verb):
    code, out, _ = run("scene", verb, "--help")
    assert code == 0
    assert out.splitlines()[0].strip(), "its purpose in one line"
    assert out.count(f"\n  ulpgate scene {verb} ") == 2
    shown = {
        word.rstrip(",")
        for line in out.splitlines()
        if line.startswith("  -")
        for word in line.split()[0].split(",")
        if word.startswith("--")
    }
    assert shown == OPTIONS[verb]


@pytest.mark.parametrize("verb", VERBS)
def test_a_verb_refuses_the_options_of_others(verb):
    for option in sorted(set(EVERY) - OPTIONS[verb]):
        value = [] if option in FLAGS.split() else ["1"]
        code, _, err = run("scene", verb, "collision", option, *value)
        assert code == 2 and option in err, (option, err)


OLD = [
    ("pendulum3", "ulpgate scene run pendulum3"),
    ("pendulum3 --explain", "ulpgate scene explain pendulum3"),
    ("--types double pendulum3 --explain", "ulpgate scene explain pendulum3"),
    ("deposition --steps 9 --compare", "ulpgate scene compare deposition"),
    ("pendulum3 --ladder --types mpfr62", "ulpgate scene ladder pendulum3"),
    ("pendulum3 --correlate --series", "ulpgate scene correlate pendulum3"),
    ("deposition --repeats 10 --out T", "ulpgate scene speed deposition"),
    ("mine.toml --steps 3", "ulpgate scene run mine.toml"),
    ("run pendulum3 --explain", "ulpgate scene explain pendulum3"),
    ("run pendulum3 --compare", "ulpgate scene compare pendulum3"),
    ("run pendulum3 --type double", "--types"),
    ("run pendulum3 --type=double", "--types"),
    ("run pendulum3 --variant mass=yade", "--set"),
    ("run pendulum3 --set dt=1e-6", "--dt"),
    ("run pendulum3 --set until=1", "--until"),
    ("--json run pendulum3", "ulpgate scene run SCENE --json"),
    ("run pendulum3 collision", "'collision'"),
    ("", "name a verb"),
]


@pytest.mark.parametrize("words,message", OLD)
def test_other_spellings_are_refused_with_the_one(words, message):
    code, out, err = run("scene", *words.split())
    assert code == 2 and message in err and out == "", err


BAD_VALUES = [
    (["--steps", "0"], "--steps", "'0'"),
    (["--steps", "-1"], "--steps", "'-1'"),
    (["--steps", "1.5"], "--steps", "'1.5'"),
    (["--steps", ""], "--steps", "''"),
    (["--steps", "18446744073709551616"], "--steps", "'18446744073709551616'"),
    (["--steps", "9007199254740993"], "--steps", "'9007199254740993'"),
    (["--dt", ""], "--dt", "''"),
    (["--dt", "-1e-6"], "--dt", "'-1e-6'"),
    (["--dt", "fast"], "--dt", "'fast'"),
    (["--until", ""], "--until", "''"),
    (["--until", "0"], "--until", "'0'"),
    (["--until", "1e-9"], "--until", "'1e-9'"),
    (["--until", "1e300"], "--until", "'1e300'"),
    (["--until", "1e-3", "--steps", "5"], "--until", "--steps"),
    (["--snapshots", "-1", "--out", "OUT"], "--snapshots", "'-1'"),
    (["--snapshots", "", "--out", "OUT"], "--snapshots", "''"),
    (["--snapshots", "0,1/0", "--out", "OUT"], "--snapshots", "'0,1/0'"),
    (["--snapshots", "0,7", "--out", "OUT"], "--snapshots", "'0,7'"),
    (["--snapshots", "0"], "--snapshots", "--out"),
    (["--vtk", "--out", "OUT"], "--vtk", "--snapshots"),
    (["--record", "--series", "--out", "OUT"], "--record", "--series"),
    (["--overwrite"], "--overwrite", "--out"),
    (["--resume", "--overwrite", "--out", "OUT"], "--resume", "--overwrite"),
    (["--checkpoint-seconds", "5"], "--checkpoint-seconds", "--out"),
    (["--own-constants"], "--own-constants", "scene compare"),
    (["--out", ""], "--out", "''"),
    (["--types", ""], "--types", "''"),
    (["--threads", "0"], "--threads", "0"),
]


@pytest.mark.parametrize("words,option,value", BAD_VALUES)
def test_a_bad_value_is_named_and_nothing_is_written(words, option, value, tmp_path):
    out = tmp_path / "out"
    given = [out if word == "OUT" else word for word in words]
    code, printed, err = run("scene", "run", "collision", *given)
    assert code == 2 and option in err and value in err, err
    assert printed == "" and not out.exists()


def test_an_override_may_stand_before_the_scene():
    code, out, err = run(
        *"scene run --set material.ball.density=2600 collision --steps 1 --json".split()
    )
    assert code == 0, err
    assert json.loads(out)["variant"] == "material.ball.density=2600"


def test_json_is_all_that_speed_prints(tmp_path):
    words = "scene speed collision --types float,double --steps 50 --repeats 2 --json"
    code, out, err = run(*words.split(), "--out", tmp_path)
    assert code == 0, err
    rows = [json.loads(line) for line in out.splitlines()]
    assert [(r["type"], r["repeats"], r["threads"]) for r in rows] == [
        ("float", 2, 1),
        ("double", 2, 1),
    ]
    assert all(r["memory_bytes"] > 0 for r in rows), "a cost, which threads change"
    assert (tmp_path / "timing.jsonl").read_text() == out


def test_explain_names_what_is_left_out():
    code, out, err = run("scene", "explain", "collision")
    assert code == 0, err
    assert "left out" in out and "step with all parts" in out


def test_own_constants_part_from_widened_ones():
    words = "scene compare pendulum3 --types float --steps 100".split()
    widened, own = run(*words), run(*words, "--own-constants")
    assert widened[0] == own[0] == 0
    assert widened[1] != own[1]


@pytest.mark.parametrize("scene", ["collision", "pendulum3", "packing", "rolling"])
def test_scene_records_do_not_depend_on_threads(scene, tmp_path):
    words = f"scene run {scene} --types float,double --steps 200 --series".split()
    for threads in (1, 2):
        out = tmp_path / str(threads)
        code, _, err = run(*words, "--threads", threads, "--out", out)
        assert code == 0, err
        assert json.loads((out / "context.json").read_text())["threads"] == threads
    one, two = (tmp_path / t / "scenes.jsonl" for t in "12")
    assert one.read_bytes() == two.read_bytes()


def last_record(tmp_path, *words):
    """The record in double, and the last row of its series."""
    code, _, err = run("scene", "run", *words, "--series", "--out", tmp_path)
    assert code == 0, err
    (record,) = map(json.loads, (tmp_path / "scenes.jsonl").read_text().splitlines())
    with open(tmp_path / f"series/{record['scene']}_double.csv") as file:
        return record, list(csv.DictReader(file))[-1]


def test_kinetic_energies_of_half_steps_and_on_the_step_have_names_of_their_own(
    tmp_path,
):
    """A ball falls from rest: n g dt after n steps, half a step later than the mean of n - 1 and n."""
    steps = 10
    record, row = last_record(tmp_path, "bouncing", "--steps", steps)
    half_step = record["kinetic_energy_half_step_J"]
    on_step = record["energy"]["translational_on_step"]
    assert record["energy"]["rotational_on_step"] == 0
    assert on_step / half_step == pytest.approx(((steps - 0.5) / steps) ** 2, rel=1e-12)
    assert float(row["kinetic_half_step_J"]) == half_step
    assert float(row["translational_on_step"]) == on_step
    for old in ("kinetic", "rotational", "kinetic_J"):
        assert old not in row and old not in record["energy"]
    assert "kinetic_energy" not in record
    code, out, _ = run("scene", "run", "bouncing", "--steps", steps)
    assert code == 0 and f"kinetic_half_step {half_step:.10g} J" in out


def test_velocities_of_a_composition_method_are_on_the_step(tmp_path):
    words = ["--integrator", "yoshida8", "--steps", 50]
    record, row = last_record(tmp_path, "pendulum3", *words)
    on_step = record["kinetic_energy_on_step_J"]
    assert on_step > 0 and "kinetic_energy_half_step_J" not in record
    assert record["energy"]["translational_on_step"] == pytest.approx(
        on_step, rel=1e-14
    )
    assert float(row["kinetic_on_step_J"]) == on_step


COLLISIONS = "--steps 12000 --types float,double --set speed=5 --collisions".split()


def test_a_ledger_lists_collisions_and_changes_no_record(tmp_path):
    words = ["scene", "run", "packing", *COLLISIONS, "--series"]
    ledger, plain = tmp_path / "ledger", tmp_path / "plain"
    assert run(*words, "--out", ledger)[0] == 0
    words.remove("--collisions")
    code, out, _ = run(*words, "--out", plain)
    assert code == 0 and "collisions" not in out
    assert not (plain / "collisions.jsonl").exists()
    for file in ("scenes.jsonl", "series/packing_double.csv"):
        assert (ledger / file).read_bytes() == (plain / file).read_bytes()
    rows = [
        json.loads(line)
        for line in (ledger / "collisions.jsonl").read_text().splitlines()
    ]
    for token in ("float", "double"):
        mine = [r for r in rows if r["type"] == token]
        totals = mine.pop()
        assert totals["what"] == "ledger" and totals["beyond"] == 0
        assert totals["rows"] == totals["ended"] + totals["still_open"] == len(mine)
        assert totals["ended"] > 20 and totals["still_open"] > 0
        ended = [r for r in mine if not r["open"]]
        assert min(r["steps_inside"] for r in ended) == totals["shortest_steps"]
        assert max(r["energy_created"] for r in ended) == totals["largest_created"]
        assert all(r["restitution"] is None for r in mine if r["open"])
        assert [r["end_step"] for r in mine] == sorted(r["end_step"] for r in mine)
    assert not (ledger / "checkpoints").exists()


def test_an_interrupted_ledger_goes_on_to_the_same_bytes(tmp_path):
    words = ["scene", "run", "packing", *COLLISIONS]
    straight, broken = tmp_path / "straight", tmp_path / "broken"
    assert run(*words, "--threads", 2, "--out", straight)[0] == 0
    often = ["--checkpoint-seconds", "0", "--out", str(broken)]
    process = subprocess.Popen(
        [ULPGATE, *map(str, [*words, *often])], cwd=ROOT, stdout=subprocess.DEVNULL
    )
    checkpoint = broken / "checkpoints" / "packing_float.json"
    while process.poll() is None and not (
        checkpoint.exists() and '"rows":0' not in checkpoint.read_text()
    ):
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    assert process.wait() == 3, "interrupted in the midst of it"
    plain = [w for w in words if w != "--collisions"]
    code, _, err = run(*plain, *often, "--resume")
    assert code != 0 and "collisions" in err, err
    code, _, err = run(*words, *often, "--resume")
    assert code == 0, err
    for file in ("scenes.jsonl", "collisions.jsonl"):
        assert (broken / file).read_bytes() == (straight / file).read_bytes()


def test_the_gate_holds_collisions_to_their_condition(tmp_path):
    out, budgets = tmp_path / "out", tmp_path / "budgets"
    words = "scene run cradle --types double --collisions --series --out".split()
    assert run(*words, out)[0] == 0
    assert run("gate", out, "--budgets", budgets, "--update")[0] == 0
    assert "max_energy_created = 4.4" in (budgets / "cradle.toml").read_text()
    assert run("gate", out, "--budgets", budgets)[0] == 0
    # A step that no contact is stable with makes energy that no bound excuses.
    unstable = tmp_path / "unstable"
    words = "scene run bouncing --types double --dt 1e-3 --collisions --series".split()
    words += "--set material.ball.collision_time=1.0097e-3 --out".split()
    assert run(*words, unstable)[0] == 0
    # No budget is made of it, and it fails whatever the budgets are.
    fresh = tmp_path / "fresh"
    assert run("gate", unstable, "--budgets", fresh, "--update")[0] == 1
    code, printed, _ = run("gate", unstable, "--budgets", budgets)
    assert code == 1 and "beyond their condition, furthest bodies 0-1" in printed


def test_a_composition_method_has_no_ledger():
    words = "scene run pendulum3 --integrator yoshida6 --steps 5 --collisions".split()
    code, _, err = run(*words)
    assert code == 2 and "--integrator 'yoshida6'" in err and "--collisions" in err
