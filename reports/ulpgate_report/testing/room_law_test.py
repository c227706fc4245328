"""Tests of the rooms' law: the package keeps it, and each planted break is noticed."""
from pathlib import Path

import pytest

from ulpgate_report.testing import room_law

ROOT = Path(__file__).resolve().parents[1]


def test_the_rooms_keep_their_law():
    assert room_law.breaks(ROOT, room_law.load(ROOT)) == []


LAW = """
most_files = 3
most_readme_lines = 2
tests_may_import = ["helpers"]
test_packages = ["pytest"]
[rooms]
low = []
high = ["low"]
helpers = []
[packages]
low = []
high = ["numpy"]
helpers = []
"""
FILES = {
    "__init__.py": "",
    "rooms.toml": LAW,
    "low/a.py": "import math\n",
    "low/a_test.py": "import pytest\nfrom ulpgate_report.helpers import h\n",
    "high/b.py": "import numpy.linalg\nfrom ulpgate_report.low.a import x\n",
    "helpers/h.py": "",
}


def package(folder, changes):
    """A small package that keeps its law, but for the files in `changes`; None takes one away."""
    files = dict(FILES)
    for room in ("low", "high", "helpers"):
        files.update({f"{room}/README.md": "# r\n", f"{room}/__init__.py": ""})
    for name, text in {**files, **changes}.items():
        if text is not None:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text)
    return folder


def found(folder, changes):
    """The breaks of the small package with its changes."""
    root = package(folder, changes)
    return room_law.breaks(root, room_law.load(root))


def test_a_package_that_keeps_its_law(tmp_path):
    assert found(tmp_path, {}) == []


UP = "from ulpgate_report.high import b\n"


@pytest.mark.parametrize(
    "changes, expected, why",
    [
        ({"low/c.py": UP}, ["low/c.py:1: low may not import high"], "upwards"),
        (
            {"low/c.py": "def f():\n    " + UP},
            ["low/c.py:2: low may not import high"],
            "inside a function",
        ),
        (
            {"low/c.py": "import ulpgate_report.high.b\n"},
            ["low/c.py:1: low may not import high"],
            "in the other form",
        ),
        (
            {"low/c.py": "from ulpgate_report.helpers import h\n"},
            ["low/c.py:1: low may not import helpers"],
            "what tests alone may",
        ),
        (
            {"low/c_test.py": UP},
            ["low/c_test.py:1: low may not import high"],
            "a test that its room does not allow",
        ),
        (
            {"low/c.py": "from ..high import b\n"},
            ["low/c.py:1: ..high.b is relative; name the room"],
            "relative",
        ),
        (
            {"low/c.py": "from ulpgate_report import low\n"},
            ["low/c.py:1: ulpgate_report.low: import modules of a room, by its name"],
            "a room as a whole",
        ),
        (
            {"high/c_test.py": "from ulpgate_report.low.a_test import f\n"},
            [
                "high/c_test.py:1: ulpgate_report.low.a_test.f is a test; "
                "what tests share stands in testing"
            ],
            "another test",
        ),
        (
            {"low/c.py": "import numpy\n"},
            ["low/c.py:1: low may not import the package numpy"],
            "a package of another room",
        ),
        (
            {"high/c.py": "import pytest\n"},
            ["high/c.py:1: high may not import the package pytest"],
            "a package of tests",
        ),
        (
            {f"low/c{n}.txt": "" for n in range(2)},
            ["low: 4 files, more than 3"],
            "too many",
        ),
        (
            {f"low/in/c{n}.txt": "" for n in range(4)},
            ["low/in: 4 files, more than 3"],
            "too many in a folder of it",
        ),
        (
            {"low/in/c.py": UP},
            ["low/in: modules in a folder that is no room"],
            "a folder that the law does not see",
        ),
        ({"low/README.md": None}, ["low: no README.md"], "no README"),
        (
            {"low/README.md": "a\nb\nc\n"},
            ["low/README.md: more than 2 lines"],
            "too long",
        ),
        ({"low/__init__.py": None}, ["low: no __init__.py"], "no package"),
        ({"new/c.py": ""}, ["new: not in rooms.toml"], "a room without a law"),
        (
            {"rooms.toml": LAW.replace("low = []\nhigh", "gone = []\nlow = []\nhigh")},
            ["gone: no such folder"],
            "a law without a room",
        ),
        ({"c.py": ""}, ["c.py: a module in no room"], "beside the rooms"),
        (
            {"high/b.py": "import numpy\n"},
            ["rooms.toml: high does not import low"],
            "a room that nothing needs",
        ),
        (
            {"high/b.py": "from ulpgate_report.low import a\n"},
            ["rooms.toml: high does not import numpy"],
            "a package that nothing needs",
        ),
        (
            {
                "rooms.toml": LAW.replace("low = []\nhigh", 'low = ["high"]\nhigh'),
                "low/c.py": UP,
            },
            ["rooms.toml: low may import high, which is not above it"],
            "a circle that the data allows",
        ),
    ],
)
def test_a_planted_break_is_noticed(tmp_path, changes, expected, why):
    assert found(tmp_path, changes) == expected, why
