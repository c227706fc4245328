"""Scenes that are none, that leave the numbers, that are too large, or whose records were changed: each is refused with
its place.  Names of tests begin with the row of the list of faults that they close."""

import functools
import json
import pathlib
import re
import signal
import subprocess
import sys
import time

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

import program  # noqa: E402
from program import ROOT, ULPGATE  # noqa: E402

# A run that hangs, or that takes memory without end, fails its test instead of the machine.
SECONDS = 60
run = functools.partial(program.run, timeout=SECONDS)

SCENE = """name = "NAME"
[constants]
R = 0.01
[[material]]
name = "m"
[[sphere]]
position = [0, 1, 0]
radius = RADIUS
MORE
[run]
dt = DT
until = 1
"""


def write(tmp_path, name="mine", radius='"R"', more="", dt="1e-3"):
    text = SCENE.replace("NAME", name).replace("RADIUS", radius)
    file = tmp_path / "mine.toml"
    file.write_text(text.replace("MORE", more).replace("DT", dt))
    return file


def refused(tmp_path, *words, says):
    """Exit 2, with all of `says` in the message and nothing written."""
    out = tmp_path / "out"
    code, printed, err = run(*words, "--out", out)
    assert code == 2, (code, printed, err)
    for text in says:
        assert text in err, err
    assert printed == "" and not out.exists()


AT_START = [
    ({"radius": "1e-60"}, [], ["mine in float", "sphere[0].radius", "positive"]),
    ({"radius": "1e308"}, ["--types", "double"], ["mine in double", "mass"]),
    ({"radius": "1e-308"}, ["--types", "double"], ["mine in double", "mass"]),
    ({}, ["--set", "R=-0.1"], ["sphere[0].radius", "'R'", "-0.1"]),
    ({"dt": '"R*1e-3"'}, ["--set", "R=-1"], ["run.dt", "positive"]),
    ({"dt": '"R*1e-3"'}, ["--set", "R=0"], ["run.dt", "positive"]),
    (
        {"more": "[[sphere]]\nposition = [0, 1, 0]\nradius = 1"},
        [],
        ["bodies 0 and 1", "same point"],
    ),
    (
        {"more": "[[facet]]\nvertices = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]"},
        [],
        ["facet[0] (body 1)", "no area"],
    ),
    (
        {
            "more": "[[box]]\ncentre = [0,0,0]\nhalf_size = [1,1,1]\naxis = [0,0,0]",
        },
        [],
        ["box[0].axis"],
    ),
]


@pytest.mark.parametrize("changes,words,says", AT_START)
def test_a6_what_is_no_scene_in_the_type_of_the_run_is_refused(
    changes, words, says, tmp_path
):
    file = write(tmp_path, **changes)
    types = [] if "--types" in words else ["--types", "double,float"]
    refused(tmp_path, "scene", "run", file, "--steps", 10, *types, *words, says=says)


def test_a6_dependents_of_an_override_are_judged(tmp_path):
    refused(
        tmp_path,
        *"scene run pendulum3 --steps 10 --set L=-0.1".split(),
        says=["pendulum3 in double", "sphere[0].radius", "node_radius"],
    )


DIVERGES = "--types double,float,mpfr62 --steps 1000 --set gravity.y=-1e24".split()


def test_a6_a_state_that_stops_being_finite_has_diverged(tmp_path):
    """In float the energy is beyond the range after some steps, in the other types it stays far within."""
    words = ["scene", "run", "bouncing", *DIVERGES, "--series", "--out", tmp_path / "a"]
    code, out, err = run(*words)
    assert code == 1, err
    found = re.search(r"bouncing in float: diverged at step (\d+): (.*)\n", err)
    assert found and found[2] == "the energy account is not finite", err
    # Alone, step by step: the step before is the last that ends well.
    last = int(found[1]) - 1
    one = "scene run bouncing --types float --set gravity.y=-1e24 --steps".split()
    assert last == 0 or run(*one, last)[0] == 0
    assert run(*one, last + 1)[0] == 1
    rows = [
        json.loads(line)
        for line in (tmp_path / "a/scenes.jsonl").read_text().splitlines()
    ]
    assert [row["type"] for row in rows] == ["double", "mpfr62"], "the others go on"
    assert json.loads((tmp_path / "a/context.json").read_text())["complete"] is False
    assert not (tmp_path / "a/checkpoints").exists()
    for series in (tmp_path / "a/series").iterdir():
        text = series.read_text().lower()
        assert "nan" not in text and "inf" not in text


def test_a6_gravity_beyond_measure_has_diverged():
    code, out, err = run(
        *"scene run bouncing --steps 100 --set gravity.y=1e308".split()
    )
    assert code == 1 and out == "" and "diverged at step 1" in err


def test_a6_two_runs_that_left_the_numbers_are_not_equal():
    code, out, err = run(*"scene compare bouncing --types float".split(), *DIVERGES[2:])
    assert code == 1 and "= 0 ULP" not in out
    assert "bouncing in float: diverged at step" in err


@pytest.mark.parametrize("verb", ["run", "compare", "speed"])
def test_a6_every_verb_that_takes_steps_tells_a_divergence(verb):
    words = "bouncing --types float --steps 50 --set gravity.y=-1e38".split()
    code, _, err = run("scene", verb, *words)
    assert code == 1 and "diverged at step" in err


@pytest.mark.parametrize("name", ["../../evil", "/evil", "..", ".x", "a b", "-x"])
def test_a14_names_of_scenes_stay_inside_the_directory(name, tmp_path):
    file = write(tmp_path, name=name)
    refused(tmp_path, "scene", "run", file, says=["mine.toml:1: name: must be"])


LENGTHS = [
    ["--dt", "1e-300"],
    ["--until", "1e300"],
    ["--steps", "-1"],
    ["--steps", "010"],
    ["--steps", "18446744073709551616"],
    ["--steps", "9007199254740992"],
    ["--dt", "1e-18"],
    ["--set", "record_every=1e-9"],
    ["--dt", "1e-14", "--set", "record_every=1e-14"],
]


@pytest.mark.parametrize("words", LENGTHS)
def test_b5_no_run_without_end(words, tmp_path):
    refused(tmp_path, "scene", "run", "collision", *words, says=[])


@pytest.mark.parametrize("radius", ["1e-300", "1e-9", "1e308"])
def test_b5_a_lattice_without_end_is_refused(radius, tmp_path):
    more = (
        '[[generator]]\nkind = "hexagonal_ball"\nball_radius = 0.5\n'
        f"corner = [-0.5, -0.5, -0.5]\nradius = {radius}"
    )
    file = write(tmp_path, more=more)
    refused(tmp_path, "scene", "run", file, says=["generator[0]"])


def grid(side, tail=""):
    return (
        '[[generator]]\nkind = "grid"\nradius = 1\nspacing = [2, 2, 2]\n'
        f"counts = [{side}, {side}, {side}]\n{tail}"
    )


def test_b6_memory_is_estimated_and_refused(tmp_path):
    says = ["generator[0]", "1000000001 need about", " GB", "--allow-large"]
    file = write(tmp_path, more=grid(1000))
    refused(tmp_path, "scene", "run", file, says=says)


def test_b6_bonds_are_counted_before_they_are_made(tmp_path):
    tail = '[contacts]\nlaw = "cohesive"\nbond_reach = 1e100'
    file = write(tmp_path, more=grid(19, tail))
    says = ["contacts.bond_reach", "GB", "--allow-large"]
    refused(tmp_path, "scene", "run", file, says=says)


def test_b6_pairs_that_may_touch_are_counted(tmp_path):
    """Every sphere overlaps all others."""
    file = write(tmp_path, more=grid(14, "[contacts]\nsweep = 1e9"))
    words = ["scene", "run", file, "--steps", 1]
    code, _, err = run(*words, "--types", "mpfr150")
    assert code == 2 and "pairs" in err and "--allow-large" in err, err


@pytest.mark.parametrize("file", ["/dev/zero", ".", "/tmp"])
def test_b6_a_scene_is_a_regular_file(file, tmp_path):
    refused(tmp_path, "scene", "run", file, says=[file, "TOML file of a scene"])


def test_b6_a_scene_has_a_size(tmp_path):
    file = write(tmp_path)
    with file.open("ab") as stream:
        stream.truncate(1 << 32)
    refused(tmp_path, "scene", "run", file, says=["mine.toml", "bytes"])


def test_allow_large_takes_what_it_says():
    words = "scene run collision --until 1e-5 --allow-large --json".split()
    code, out, err = run(*words)
    assert code == 0, err
    assert json.loads(out)["steps"] == 10


def test_c_a_correlation_of_too_few_records_measures_nothing():
    code, out, err = run(*"scene correlate pendulum3 --types float --steps 1".split())
    assert code == 3 and out == "" and "fewer than the 500" in err


def test_c_a_ladder_of_types_without_one_measures_nothing():
    words = "scene ladder collision --types".split()
    assert run(*words, "double")[0] == 3
    assert run(*words, "double,mpfr62")[0] == 0


@pytest.mark.parametrize("name", ["pi", "nan", "sqrt", "inf"])
def test_c_constants_do_not_shadow_the_language(name, tmp_path):
    file = write(tmp_path)
    file.write_text(file.read_text().replace("R = 0.01", f"{name} = 3\nR = 0.01"))
    code, _, err = run("scene", "run", file)
    assert code == 2 and f"mine.toml:3: constants.{name}" in err


def test_c_an_integrator_is_named_in_words_that_can_be_typed():
    code, _, err = run(*"scene run pendulum3 --integrator leapfrogg".split())
    assert code == 2 and "`ulpgate list integrators`" in err and "sceness" not in err
    code, _, err = run(*"scene run pendulum3 --integrator rk4".split())
    assert code == 2 and "'rk4'" in err


@pytest.fixture
def interrupted(tmp_path):
    """A run with checkpoints, and the words that go on with it."""
    words = "scene run pendulum3 --types mpfr62 --until 16 --record --resume".split()
    words += ["--checkpoint-seconds", "0.01", "--out", str(tmp_path)]
    process = subprocess.Popen([ULPGATE, *words], stderr=subprocess.PIPE, cwd=ROOT)
    checkpoint = tmp_path / "checkpoints/pendulum3_mpfr62.json"
    for _ in range(1500):
        if checkpoint.exists() and json.loads(checkpoint.read_text())["step"] > 10:
            break
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=SECONDS)
    assert process.returncode == 3
    return words


@pytest.mark.parametrize("directory", ["series", "trajectory"])
def test_b8_records_that_a_checkpoint_vouches_for_are_not_changed(
    directory, interrupted, tmp_path
):
    file = tmp_path / directory / "pendulum3_mpfr62.csv"
    whole = file.read_bytes()
    line = whole.index(b"\n", whole.index(b"\n") + 1)
    digit = next(i for i in range(line, 0, -1) if chr(whole[i]).isdigit())
    changed = bytes([ord("0") + (whole[digit] - ord("0") + 1) % 10])
    for content in (whole[:digit] + changed + whole[digit + 1 :], bytes(len(whole))):
        file.write_bytes(content)
        code, _, err = run(*interrupted)
        assert code == 2 and str(file) in err and "vouches" in err, err
        assert file.read_bytes() == content, "what is refused is left as it is"
