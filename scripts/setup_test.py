"""Tests that setup names packages by release, says what is missing elsewhere, and how to go on where it fails."""

import os
import pathlib
import shutil
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[1]
# What the scripts call that every system has.
TOOLS = "bash env sh cat grep head tail sort mktemp rm id dirname basename nproc mkdir"

DEBIAN_12 = 'ID=debian\nVERSION_ID="12"\nPRETTY_NAME="Debian GNU/Linux 12 (bookworm)"\n'
DEBIAN_13 = 'ID=debian\nVERSION_ID="13"\nPRETTY_NAME="Debian GNU/Linux 13 (trixie)"\n'
UBUNTU = (
    'ID=ubuntu\nID_LIKE=debian\nVERSION_ID="24.04"\nPRETTY_NAME="Ubuntu 24.04 LTS"\n'
)
FEDORA = 'ID=fedora\nVERSION_ID=42\nPRETTY_NAME="Fedora Linux 42"\n'


class Machine:
    """A PATH of few programs, and an apt-get that notes its words, prints what it is given and exits by it."""

    def __init__(self, directory: pathlib.Path):
        self.programs = directory / "bin"
        self.programs.mkdir()
        self.release = directory / "os-release"
        self.calls = directory / "calls"
        for tool in TOOLS.split():
            (self.programs / tool).symlink_to(shutil.which(tool))

    def program(self, name: str, text: str) -> None:
        file = self.programs / name
        file.write_text("#!/bin/sh\n" + text)
        file.chmod(0o755)

    def apt(self, text: str = "", code: int = 0) -> None:
        self.program(
            "apt-get",
            f'echo "$@" >>{self.calls}\n'
            'case "$*" in *APT::Status-Fd*) echo "pmstatus:x:50.0:Installing x" >&3;; esac\n'
            f'case "$1" in install) cat >&2 <<"EOF"\n{text}\nEOF\nexit {code};; esac\n',
        )

    def setup(self, release: str, *words: str, **variables: str):
        self.release.write_text(release)
        done = subprocess.run(
            [ROOT / "scripts/setup", *words],
            capture_output=True,
            text=True,
            stdin=subprocess.DEVNULL,
            env={
                "PATH": str(self.programs),
                "HOME": os.environ.get("HOME", "/"),
                "TMPDIR": str(self.programs.parent),
                "CXX": "false",
                "ULPGATE_OS_RELEASE": str(self.release),
                **variables,
            },
        )
        return done.returncode, done.stderr

    def installed(self) -> list[str]:
        calls = [line.split() for line in self.calls.read_text().splitlines()]
        return next(words for words in calls if words[0] == "install")


@pytest.fixture
def machine(tmp_path):
    m = Machine(tmp_path)
    m.program("id", "echo 0\n")
    m.program("python3", "exit 0\n")
    return m


@pytest.mark.parametrize(
    "release, boost", [(DEBIAN_12, "libboost1.81-dev"), (DEBIAN_13, "libboost1.88-dev")]
)
def test_debian_gets_the_packages_of_its_release(machine, release, boost):
    machine.apt()
    code, err = machine.setup(release)
    assert code == 0, err
    words = machine.installed()
    assert [w for w in words if w.startswith("libboost")] == [boost]
    assert "--no-remove" in words and "g++" in words and "munge" not in words
    assert "   install  50 %" in err


@pytest.mark.parametrize("option", ["--fuzz", "--asan"])
def test_builds_by_clang_get_it_whole(machine, option):
    machine.apt()
    assert machine.setup(DEBIAN_12, option)[0] == 0
    words = machine.installed()
    assert {"clang", "libclang-rt-dev", "libomp-dev"} <= set(words)
    assert "shellcheck" not in words


def test_modules_that_two_pythons_share_are_installed_for_one(machine):
    with_it = '[ "$1" = -c ] && case "$2" in *import\\ %s) exit 0;; esac\n'
    machine.program("python3", with_it % "jinja2" + "exit 1\n")
    debian = machine.programs.parent / "debian_python"
    debian.write_text("#!/bin/sh\n" + with_it % "numpy" + "exit 1\n")
    debian.chmod(0o755)
    machine.apt()
    code, err = machine.setup(DEBIAN_12, ULPGATE_DEBIAN_PYTHON=str(debian))
    words = machine.installed()
    assert "python3-jinja2" in words and "python3-numpy" not in words
    assert code == 1 and "no python3 with" in err, "nothing was really installed"


def test_a_boost_that_is_installed_and_new_enough_is_kept(machine):
    machine.program(
        "dpkg-query",
        'case "$*" in *libboost1.\\**) echo "libboost1.74-dev installed"; echo "libboost1.83-dev installed";;\n'
        "  *libboost1.83-dev*) echo installed;; esac\n",
    )
    machine.apt()
    code, err = machine.setup(DEBIAN_13)
    assert code == 0, err
    assert not any("boost" in word for word in machine.installed())


@pytest.mark.parametrize("release", [FEDORA, UBUNTU])
def test_elsewhere_what_is_missing_is_named_by_what_it_is(machine, release):
    if release == UBUNTU:
        machine.apt()
    code, err = machine.setup(release)
    assert code == 1
    assert "headers of Boost 1.81 or newer" in err and "libmpfr-dev" in err
    name = "Fedora Linux 42" if release == FEDORA else "Ubuntu 24.04 LTS"
    assert f"this is {name}" in err
    assert ("apt-get install" in err) == (release == UBUNTU)
    assert not machine.calls.exists(), "nothing is installed there"


FAILURES = [
    (
        "E: You don't have enough free space in /var/cache/apt/archives/.",
        "disk is full",
    ),
    ("E: Failed to fetch http://mirror/x.deb  Temporary failure resolving", "mirrors"),
    ("E: dpkg was interrupted, you must manually run it", "dpkg --configure -a"),
    ("E: Could not get lock /var/lib/dpkg/lock-frontend.", "another program"),
    ("E: Packages need to be removed but remove is disabled.", "would have to go"),
    ("E: Unmet dependencies. Try 'apt --fix-broken install'", "--fix-broken"),
    ("E: Unable to locate package libboost1.88-dev", "lack a package"),
]


@pytest.mark.parametrize("text, advice", FAILURES)
def test_a_failure_of_apt_says_how_to_go_on(machine, text, advice):
    machine.apt(text, 100)
    code, err = machine.setup(DEBIAN_13)
    assert code == 1
    assert text in err and "setup: FAILED: " in err
    assert advice in err.splitlines()[-1]


def test_without_root_and_sudo_the_command_is_printed(machine):
    machine.program("id", "echo 1000\n")
    machine.apt()
    code, err = machine.setup(DEBIAN_13)
    assert code == 1
    assert "there is no sudo; as root: apt-get update && apt-get install" in err
    machine.program("sudo", "exit 1\n")
    code, err = machine.setup(DEBIAN_13)
    assert code == 1
    assert "there is no terminal; as root: apt-get update && apt-get install" in err


def test_an_unknown_word_is_bad_usage(machine):
    code, err = machine.setup(DEBIAN_12, "--clusters")
    assert code == 2 and "usage" in err
