"""Tests that a release is refused where versions differ or the citation lacks what its format asks for."""

import os
import pathlib
import shutil
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[1]
FILES = ("CMakeLists.txt", "CITATION.cff", "CHANGELOG.md")
VERSION = subprocess.run(
    [ROOT / "scripts/release", "--check"], capture_output=True, text=True
).stdout.strip()


def check(root):
    done = subprocess.run(
        [ROOT / "scripts/release", "--check"],
        capture_output=True,
        text=True,
        env={**os.environ, "ULPGATE_RELEASE_ROOT": str(root)},
    )
    return done.returncode, done.stdout, done.stderr


def test_the_tree_has_one_version():
    code, out, err = check(ROOT)
    assert code == 0, err
    assert out.strip().count(".") == 2


@pytest.mark.parametrize(
    "file, old, new, said",
    [
        ("CITATION.cff", f"version: {VERSION}", "version: 9.9.9", "version 9.9.9"),
        ("CHANGELOG.md", f"## {VERSION}", "## 9.9.9", "its newest version is 9.9.9"),
        ("CITATION.cff", "\ntitle:", "\ntitled:", "no title"),
        ("CITATION.cff", "  - name:", "  - named:", "authors without a name"),
        ("CITATION.cff", "cff-version: 1.2.0", "cff-version: 1.1.0", "not 1.2.0"),
        ("CMakeLists.txt", "project(ulpgate", "project(other", "no version"),
    ],
)
def test_what_is_wrong_is_named(tmp_path, file, old, new, said):
    for name in FILES:
        shutil.copy(ROOT / name, tmp_path / name)
    text = (tmp_path / file).read_text()
    assert old in text
    (tmp_path / file).write_text(text.replace(old, new, 1))
    code, _, err = check(tmp_path)
    assert code == 1 and file in err and said in err, err


@pytest.mark.parametrize("words", [["--no"], ["a", "b"]])
def test_bad_usage(words):
    done = subprocess.run([ROOT / "scripts/release", *words], capture_output=True)
    assert done.returncode == 2
