"""Tests of changed_since: what a changed file can affect, from dependencies as ninja tells them."""

import os
import pathlib
import shutil
import subprocess
import sys

import pytest

sys.path.insert(0, os.path.dirname(__file__))
import changed_since
from changed_since import Failure, affected, part_of

TYPES = ["float", "double", "mpfr62"]
DEPENDS = {
    "reference/types/real.hpp": {
        "kernels/a.dir/function_table_double_x1.cpp.o",
        "harness/app/a.dir/main.cpp.o",
    },
    "kernels/math/table_double.hpp": {
        "kernels/a.dir/function_table_double_x1.cpp.o",
        "kernels/a.dir/function_table_double_x4.cpp.o",
    },
    "kernels/dem/float_only.hpp": {"kernels/a.dir/dem_engine_float_x1.cpp.o"},
    "kernels/dem/engine/engine_test_scene.hpp": {
        "cmake/tests/engine_test.dir/engine.cpp.o"
    },
}


def test_a_header_of_one_type_affects_that_type_alone():
    what, why = affected(["kernels/math/table_double.hpp"], DEPENDS, TYPES)
    assert what == ({"double"}, {"math"})
    assert "kernels/math/table_double.hpp goes into 2 objects" in why[0]


def test_several_files_add_up():
    what, _ = affected(
        ["kernels/math/table_double.hpp", "kernels/dem/float_only.hpp"], DEPENDS, TYPES
    )
    assert what == ({"double", "float"}, {"math", "kernels", "scenes", "stress"})


def test_what_every_part_uses_affects_all():
    what, why = affected(
        ["kernels/dem/float_only.hpp", "reference/types/real.hpp"], DEPENDS, TYPES
    )
    assert what == "all" and "main.cpp" in why[0]


@pytest.mark.parametrize(
    "file",
    [
        "ci/budgets/float.toml",
        "ci/gate",
        "CMakeLists.txt",
        "kernels/scenes/beam.toml",
        "new.cpp",
        "scripts/pendulum",
    ],
)
def test_a_file_of_no_object_affects_all(file):
    what, why = affected([file], DEPENDS, TYPES)
    assert what == "all" and file in why[0]


@pytest.mark.parametrize(
    "file",
    [
        "README.md",
        "reports/report.py",
        "harness/core/gate/budgets_test.cpp",
        "Dockerfile",
        "kernels/dem/engine/engine_test_scene.hpp",
    ],
)
def test_what_is_not_measured_affects_nothing(file):
    assert affected([file], DEPENDS, TYPES)[0] == "nothing"


def test_no_change_affects_nothing():
    what, why = affected([], DEPENDS, TYPES)
    assert what == "nothing" and why


def test_an_object_has_its_type_and_parts():
    assert part_of("x/dem_engine_mpfr62_x4.cpp.o", TYPES) == (
        "mpfr62",
        {"kernels", "scenes", "stress"},
    )
    assert part_of("x/trajectory_engine_double.cpp.o", TYPES)[0] == "double"
    assert part_of("x/unity_stress_of_double_cxx.cxx.o", TYPES) == (
        "double",
        {"stress"},
    )
    # A reference of no built type is used by types that the name does not tell.
    assert part_of("x/trajectory_engine_mpfr190.cpp.o", TYPES) is None
    assert part_of("x/registry.cpp.o", TYPES) is None


@pytest.fixture
def small_build(tmp_path, monkeypatch):
    """A repository with a library of two objects, built by ninja."""
    for program in ("ninja", "git", "c++"):
        if shutil.which(program) is None:
            pytest.skip(f"no {program}")
    root = tmp_path / "tree"
    (root / "build").mkdir(parents=True)
    (root / "a.hpp").write_text("#pragma once\n")
    for name in ("function_subjects_double", "function_subjects_float"):
        (root / f"{name}.cpp").write_text(
            '#include "a.hpp"\n' if "double" in name else "int x;\n"
        )
    (root / "build/build.ninja").write_text(
        "rule cc\n command = c++ -MD -MF $out.d -c $in -o $out\n depfile = $out.d\n deps = gcc\n"
        + "".join(
            f"build lib/function_subjects_{t}.cpp.o: cc ../function_subjects_{t}.cpp\n"
            for t in ("double", "float")
        )
    )
    (root / ".gitignore").write_text("/build/\n")
    for words in (
        ["init", "-q"],
        ["add", "-A"],
        ["-c", "user.name=a", "-c", "user.email=a@b", "commit", "-qm", "x"],
    ):
        subprocess.run(["git", *words], cwd=root, check=True)
    subprocess.run(["ninja", "-C", "build"], cwd=root, check=True, capture_output=True)
    monkeypatch.setattr(changed_since, "ROOT", pathlib.Path(root).resolve())
    return root


def test_a_real_build_is_asked(small_build, capsys):
    words = ["HEAD", "--build", str(small_build / "build")]
    assert changed_since.main(words) == 0
    assert capsys.readouterr().out == "nothing\n"
    (small_build / "a.hpp").write_text("#pragma once\nint y;\n")
    changed_since.main(words)
    assert capsys.readouterr().out == "types=double parts=math\n"
    (small_build / "unknown.txt").write_text("new\n")
    changed_since.main(words)
    assert capsys.readouterr().out == "all\n"


def test_what_cannot_be_asked_is_said(small_build):
    with pytest.raises(Failure, match="nowhere is no build"):
        changed_since.main(["HEAD", "--build", "/nowhere"])
    with pytest.raises(Failure, match="rev-parse"):
        changed_since.main(["no-such-revision", "--build", str(small_build / "build")])


@pytest.fixture
def gate_of(small_build):
    """ci/gate over a program that only notes what it is asked to measure."""
    for place in ("ci/gate", "scripts/merge/changed_since.py", "scripts/pendulum"):
        there = small_build / place
        there.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(pathlib.Path(__file__).parents[2] / place, there)
    asked = small_build / "build/asked"
    program = small_build / "build/harness/app/ulpgate"
    program.parent.mkdir(parents=True)
    program.write_text(f'#!/bin/sh\necho "$@" >>{asked}\n')
    program.chmod(0o755)
    with open(small_build / ".gitignore", "a") as ignored:
        ignored.write("/out/\n/ci/\n/scripts/\n")
    subprocess.run(
        ["git", "-c", "user.name=a", "-c", "user.email=a@b", "commit", "-qam", "x"],
        cwd=small_build,
        check=True,
    )

    def gate(*words):
        asked.unlink(missing_ok=True)
        done = subprocess.run(
            [small_build / "ci/gate", "--ulpgate", program, *words],
            capture_output=True,
            text=True,
        )
        lines = asked.read_text().splitlines() if asked.exists() else []
        lines = [line for line in lines if "out/gate/platform" not in line]
        # Runs of the pendulum go on side by side; the last judges.
        return done.returncode, sorted(lines[:-1]) + lines[-1:], done.stderr

    return small_build, gate


def verbs(lines):
    return {line.split()[0] for line in lines}


def test_the_gate_measures_what_changed_files_can_affect(gate_of):
    root, gate = gate_of
    code, whole, _ = gate()
    assert code == 0
    assert verbs(whole) == {
        *("math", "kernels", "scene", "integrators", "stress", "work-precision"),
        "gate",
    }
    assert any("pendulum" in line for line in whole)
    assert "--only-measured" not in whole[-1]

    code, lines, said = gate("--changed-since", "HEAD")
    assert code == 0 and "the worst cases alone are measured" in said
    assert verbs(lines) == {"math", "gate"} and "--strata worst" in lines[0]

    (root / "a.hpp").write_text("#pragma once\nint y;\n")
    code, lines, said = gate("--changed-since", "HEAD")
    assert code == 0 and "functions and kernels in double" in said
    assert verbs(lines) == {"math", "gate"}
    assert all("--types double" in line for line in lines[:-1])
    # As many samples as the budgets': the same plan.
    assert "--only-measured" in lines[-1] and "--other-plan" not in lines[-1]

    (root / "unknown.txt").write_text("new\n")
    code, lines, said = gate("--changed-since", "HEAD")
    assert code == 0 and "everything is measured" in said
    assert lines == whole


def test_the_gate_refuses_to_choose_twice(gate_of):
    _, gate = gate_of
    for more in (
        ["--types", "float"],
        ["--samples", "100"],
        ["--parts", "math"],
        ["--records", "x"],
    ):
        code, lines, said = gate("--changed-since", "HEAD", *more)
        assert code == 2 and not lines and "--changed-since chooses" in said
    code, _, said = gate("--changed-since", "no-such-revision")
    assert code == 2 and "'no-such-revision' is no commit" in said


def test_a_program_without_its_build_is_gated_whole(gate_of):
    root, gate = gate_of
    _, whole, _ = gate()
    (root / "build/build.ninja").rename(root / "build/elsewhere")
    code, lines, said = gate("--changed-since", "HEAD")
    assert code == 0 and lines == whole
    assert "is no build" in said and "everything is measured" in said


def test_parts_are_measured_in_the_plan_of_the_budgets(gate_of):
    _, gate = gate_of
    code, lines, _ = gate("--parts", "kernels,stress", "--types", "double")
    assert code == 0 and verbs(lines) == {"kernels", "stress", "gate"}
    assert "--types double" in lines[0]
    assert "--only-measured" in lines[-1] and "--other-plan" not in lines[-1]
    _, lines, _ = gate("--parts", "math", "--samples", "100")
    assert verbs(lines) == {"math", "gate"} and "--other-plan" in lines[-1]
    code, lines, said = gate("--parts", "math,pendulums")
    assert code == 2 and not lines and "no part 'pendulums'" in said
