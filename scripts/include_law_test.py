"""Tests that the include law holds for the project and that breaking it is seen."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import include_law  # noqa: E402


def write(root: pathlib.Path, name: str, text: str) -> None:
    file = root / name
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)


def test_the_project_keeps_the_law():
    assert include_law.broken_laws(include_law.ROOT) == []


def test_an_include_running_back_up_is_named(tmp_path):
    write(tmp_path, "reference/a.hpp", '// A.\n#include "kernels/math/b.hpp"\n')
    write(tmp_path, "kernels/math/b.hpp", '// B.\n#include "reference/a.hpp"\n')
    write(tmp_path, "harness/core/c.cpp", '// C.\n  #  include "harness/app/d.hpp"\n')
    broken = include_law.broken_laws(tmp_path)
    assert [law.split(":")[0] for law in broken] == [
        "reference/a.hpp",
        "harness/core/c.cpp",
    ]
    assert ":2:" in broken[0]


def test_long_and_unexplained_files_are_named(tmp_path):
    write(tmp_path, "reference/long.cpp", "// Long.\n" + "int x;\n" * 400)
    write(tmp_path, "reference/silent.cpp", "int x;\n")
    broken = include_law.broken_laws(tmp_path)
    assert len(broken) == 2
