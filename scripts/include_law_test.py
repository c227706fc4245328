"""Tests that the include law holds for the project and that breaking it is seen."""

import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import include_law  # noqa: E402

LAW = """floors = ["low", "high"]
most_files = 3
longest_file = 10
[rooms]
"low/numbers" = []
"low/text" = ["low/numbers"]
"high/run" = ["low/text"]
"high/shell" = ["high/run"]
"""


@pytest.fixture
def tree(tmp_path):
    """A project that keeps the law; `broken` says what a change to it breaks."""

    class Tree:
        law = tmp_path / "rooms.toml"
        root = tmp_path / "project"

        def write(self, name: str, text: str) -> None:
            file = self.root / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)

        def broken(self) -> list[str]:
            return include_law.broken_laws(self.root, self.law)

    tree = Tree()
    tree.law.write_text(LAW)
    for room in ("low/numbers", "low/text", "high/run", "high/shell"):
        tree.write(f"{room}/README.md", "# A room\n")
        tree.write(f"{room}/a.hpp", "// A.\n")
    tree.write("high/run/b.cpp", '// B.\n#include "low/numbers/a.hpp"\n')
    return tree


def test_the_project_keeps_the_law():
    assert include_law.broken_laws(include_law.ROOT) == []


def test_a_tree_that_keeps_the_law_passes(tree):
    assert tree.broken() == []


@pytest.mark.parametrize(
    "name, text, place, why",
    [
        ("low/text/c.hpp", '// C.\n#include "high/run/a.hpp"\n', ":2:", "a floor up"),
        ("low/numbers/c.hpp", '// C.\n #  include "low/text/a.hpp"\n', ":2:", "a room"),
        ("high/run/c.cpp", '// C.\n#include "high/shell/a.hpp"\n', ":2:", "a room up"),
        (
            "low/text/c.cpp",
            '// C.\n#include "low/numbers/a_test.hpp"\n',
            ":2:",
            "tests",
        ),
        ("high/run/c.cpp", '// C.\n#include "low/nowhere/a.hpp"\n', ":2:", "no room"),
        ("low/text/c.cpp", "int x;\n", ":1:", "says nothing"),
        ("low/text/c.cpp", "// C.\n" + "int x;\n" * 10, "11 lines", "long"),
        ("low/attic/c.cpp", "// C.\n", "low/attic", "a folder that is no room"),
        ("low/c.cpp", '// C.\n#include "high/run/a.hpp"\n', ":2:", "outside rooms"),
    ],
)
def test_a_broken_law_is_named(tree, name, text, place, why):
    tree.write(name, text)
    broken = tree.broken()
    assert len(broken) >= 1, why
    assert any(place in law for law in broken), broken


def test_tests_may_include_all_of_their_floor_but_none_above(tree):
    tree.write("low/numbers/c_test.cpp", '// C.\n#include "low/text/a.hpp"\n')
    tree.write("low/numbers/testing/d.hpp", '// D.\n#include "low/text/a.hpp"\n')
    assert tree.broken() == []
    tree.write("low/numbers/e_test.cpp", '// E.\n#include "high/run/a.hpp"\n')
    assert len(tree.broken()) == 1


def test_a_room_stays_small_and_says_what_it_is(tree):
    for i in range(3):
        tree.write(f"low/text/more_{i}.hpp", "// More.\n")
    (tree.root / "low/numbers/README.md").unlink()
    broken = tree.broken()
    assert any("low/text: 4 files, at most 3" in law for law in broken)
    assert any(law.startswith("low/numbers: a README.md") for law in broken)
    assert len(broken) == 2


def test_rooms_that_include_each_other_are_no_law(tree):
    tree.law.write_text(
        LAW.replace('"low/numbers" = []', '"low/numbers" = ["low/text"]')
    )
    assert any("does not stand before it" in law for law in tree.broken())
