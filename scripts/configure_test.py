"""Tests of the configuration: a machine that has a part of MPI alone, a program of functions alone."""

import json
import os
import pathlib
import re
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[1]

# The compiler wrapper of Debian's openmpi-bin where libopenmpi-dev, whose directories it names, is missing.
WRAPPER = """#!/bin/sh
case "$1" in
  -showme:compile) echo "-I{nowhere}/include -I{nowhere}/include/openmpi" ;;
  -showme:link) echo "-L{nowhere}/lib -lmpi_cxx -lmpi" ;;
  -showme:incdirs) echo "{nowhere}/include {nowhere}/include/openmpi" ;;
  -showme:libdirs) echo "{nowhere}/lib" ;;
  -showme:libs) echo "mpi_cxx mpi" ;;
  *) echo "mpi.h: No such file or directory" >&2; exit 1 ;;
esac
"""


def program(directory: pathlib.Path, name: str, text: str) -> None:
    file = directory / name
    file.write_text(text)
    file.chmod(0o755)


@pytest.fixture
def half_an_mpi(tmp_path):
    """A directory of MPI's programs, mpiexec among them, since CMake looks for the wrapper beside it."""
    programs = tmp_path / "bin"
    programs.mkdir()
    for name in ("mpicxx", "mpic++", "mpiCC"):
        program(programs, name, WRAPPER.format(nowhere=tmp_path / "nowhere"))
    for name in ("mpiexec", "mpirun"):
        program(programs, name, "#!/bin/sh\nexit 1\n")
    return programs


def configure(tmp_path, programs, *options):
    done = subprocess.run(
        ["cmake", "-S", ROOT, "-B", tmp_path / "build", "-G", "Ninja"]
        + ["-DULPGATE_BUILD_TESTS=OFF", "-DULPGATE_BUILD_BENCHMARKS=OFF", *options],
        capture_output=True,
        text=True,
        env={**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"},
    )
    return done.returncode, done.stdout, done.stderr


def test_programs_of_mpi_without_its_headers_leave_ulpgate_mpi_out(
    tmp_path, half_an_mpi
):
    code, out, err = configure(tmp_path, half_an_mpi)
    assert code == 0, out + err
    assert f"{half_an_mpi}/mpicxx does not find <mpi.h>" in out
    assert "-- ulpgate-mpi is not built" in out
    # Nor does anything else warn, about policies for instance.
    assert err == ""


def test_mpi_that_is_asked_for_and_has_no_headers_is_an_error(tmp_path, half_an_mpi):
    code, out, err = configure(tmp_path, half_an_mpi, "-DULPGATE_MPI=ON")
    assert code != 0
    assert "ULPGATE_MPI=ON" in err and "libopenmpi-dev" in err
    assert "non-existent path" not in err


def test_a_word_that_is_none_of_the_three_is_an_error(tmp_path, half_an_mpi):
    code, out, err = configure(tmp_path, half_an_mpi, "-DULPGATE_MPI=yes")
    assert code != 0
    assert "ON, OFF or AUTO, not 'yes'" in err


def test_a_program_of_functions_alone_compiles_nothing_of_scenes(tmp_path):
    alone = ("-DULPGATE_FUNCTIONS_ONLY=ON", "-DULPGATE_TYPES=double")
    code, out, err = configure(tmp_path, tmp_path, *alone)
    assert code == 0, out + err
    commands = json.loads((tmp_path / "build" / "compile_commands.json").read_text())
    files = " ".join(command["file"] for command in commands)
    assert "unity_function_of_double" in files
    for word in ("dem", "stepper", "order", "scene", "stress", "kernel_subjects"):
        assert word not in files.replace(str(tmp_path), "").replace(str(ROOT), "")

    # What both builds compile they compile alike: the second goes on from the first.
    # A source may be another target's as well.
    def object_of(c):
        return re.search(r" -o (\S+)", c["command"])[1]

    alone_commands = {object_of(c): c["command"] for c in commands}
    configure(tmp_path, tmp_path, "-DULPGATE_FUNCTIONS_ONLY=OFF", alone[1])
    whole = json.loads((tmp_path / "build" / "compile_commands.json").read_text())
    assert len(whole) > len(commands)
    assert len({object_of(c) for c in whole} & set(alone_commands)) > len(commands) // 2
    for command in whole:
        mine = alone_commands.get(object_of(command), command["command"])
        assert mine == command["command"]


def test_a_program_of_functions_alone_has_no_tests(tmp_path):
    alone = ("-DULPGATE_FUNCTIONS_ONLY=ON", "-DULPGATE_BUILD_TESTS=ON")
    code, _, err = configure(tmp_path, tmp_path, *alone)
    assert code != 0 and "-DULPGATE_BUILD_TESTS=OFF" in err
