"""Tests of `ulpgate compare-output` as it is typed: a scene in three types, and the exit codes that come through."""

import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))
BUILT = subprocess.run(
    [ULPGATE, "list", "types"], capture_output=True, text=True
).stdout


def run(*words, **more):
    return subprocess.run(
        [ULPGATE, *map(str, words)], capture_output=True, text=True, **more
    )


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    """{type: its snapshot} of a few spheres that collide."""
    if "float128" not in BUILT:
        pytest.skip("float128 is not built")
    out = tmp_path_factory.mktemp("scene")
    for token in ("float", "double", "float128"):
        done = run(
            *(
                "scene",
                "run",
                "packing",
                "--types",
                token,
                "--steps",
                "200",
                "--record",
            ),
            *("--snapshots", "0.0001", "--out", out / token),
        )
        assert done.returncode == 0, done.stderr
    return {
        t: next((out / t / "snapshots").glob("*.csv"))
        for t in ("float", "double", "float128")
    }


def test_a_scene_in_three_types_tells_which_digits_are_floats(scene):
    done = run(
        "compare-output", scene["float"], scene["double"], "--wide", scene["float128"]
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert (
        "x_m: beyond its 7." in done.stdout
        and "what REF holds is its own error" in done.stdout
    )
    # The directories hold files of the same names but for the type.
    float_, double, float128 = (
        scene[t].parents[1] for t in ("float", "double", "float128")
    )
    whole = run("compare-output", float_, double, "--wide", float128)
    assert whole.returncode == 0 and scene["float128"].name in whole.stdout
    assert "x_m: beyond its 7." in whole.stdout
    other = run(
        "compare-output", scene["double"], scene["float"], "--wide", scene["float128"]
    )
    assert other.returncode == 1 and "first record that parts: body 0" in other.stdout


def test_exit_codes_come_through(scene, tmp_path):
    assert run("compare-output", scene["double"], scene["double"]).returncode == 0
    assert run("compare-output", scene["double"], scene["float"]).returncode == 1
    missing = run("compare-output", tmp_path / "none.csv", scene["float"])
    assert missing.returncode == 2 and "none.csv: no such file" in missing.stderr
    assert run("compare-output").returncode == 2
    empty = tmp_path / "empty.csv"
    empty.write_text("a,b\n")
    assert run("compare-output", empty, empty).returncode == 3
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [ULPGATE, "compare-output", scene["double"], scene["double"]],
            stdout=full,
            stderr=subprocess.PIPE,
        )
    assert done.returncode == 4 and b"No space left" in done.stderr


def test_help_is_of_the_verb():
    done = run("compare-output", "--help")
    assert done.returncode == 0 and "derived[:F]" in done.stdout
