"""Every verb's help shows two examples at least, and all of them run, one after the other in one folder."""

import os
import pathlib
import re
import subprocess
import sys

import pytest

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "testing")]

import help_tree  # noqa: E402
from program import ROOT, ULPGATE  # noqa: E402
from smaller import smaller  # noqa: E402

EXAMPLE = re.compile(r"^  (ulpgate .*?)(?:   +# exit (\d))?$", re.MULTILINE)

# What examples leave at its default size is given a small one.
ADDED = [
    (r"^ulpgate scene (run|compare|speed) (?!.*--steps)", " --steps 20"),
    # Less cannot be correlated.
    (r"^ulpgate scene correlate", " --steps 6000"),
    (r"^ulpgate scene correlate (?!.*--types)", " --types float,double"),
    (r"^ulpgate advise", " --search-seconds 2"),
    (r"^ulpgate work-precision .*kepler", " --steps 64..512"),
    (r"^ulpgate (math|claims) (?!.*--samples)", " --samples 60"),
    (r"^ulpgate claims", " --evaluations 500"),
]
REPLACED = [
    (" --exhaustive", ""),
    (" --until 1e11", " --until 40"),
    (" --dt plan:1e-3..1e-12", " --dt plan:1e-3..1e-5"),
    (
        " --cases pendulum3 --until 0.1",
        " --cases pendulum3 --until 0.0002 --dt 1e-5,1e-5/2",
    ),
    (
        "advise pendulum3 --error 1e-10 --until 0.1",
        "advise pendulum3 --error 1e-10 --until 0.002 --types double",
    ),
    ("sin,exp,kernel", "sin,exp"),
]

# By the beginning of the command: exit codes of a run that is as it should be.  A setting that meets an error, a bound
# that holds and records without a difference are not promised of all machines, or of samples as few as here.
CODES = [
    ("ulpgate advise", (0, 3)),
    ("ulpgate claims", (0, 1)),
    ("ulpgate search", (0, 1)),
    ("ulpgate compare ", (0, 1, 3)),
    ("ulpgate compare-output", (0, 1)),
    (
        "ulpgate math --functions exp --types double --timing repeats --samples 2000 --out B",
        (0, 1, 3),
    ),
]


@pytest.fixture(scope="module")
def tree():
    return help_tree.read(ULPGATE)


def texts(tree):
    """{words: help} of the verbs, in the order in which the help names them."""
    found = {}
    for words in tree:
        done = subprocess.run(
            [ULPGATE, *words, "--help"], capture_output=True, text=True, check=True
        )
        found[words] = done.stdout
    return found


def small(command):
    command = smaller(command)
    for pattern, options in ADDED:
        if re.search(pattern, command):
            command += options
    for large, little in REPLACED:
        command = command.replace(large, little)
    return command


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """What examples compare is there: two runs, and two outputs of a program beside one of more digits."""
    place = tmp_path_factory.mktemp("examples")
    (place / "ci").symlink_to(ROOT / "ci")
    for name, step in (("good/series", 1.0), ("new/series", 1.0), ("float", 1.0)):
        file = place / f"{name}.csv"
        file.parent.mkdir(exist_ok=True)
        file.write_text(f"step,energy_J\n1,{step}\n2,{2 * step}\n")
    for name in ("double", "float128"):
        (place / f"{name}.csv").write_text("step,energy_J\n1,1.0\n2,2.0\n")
    for name in ("debian12", "debian13"):
        words = ["math", "--functions", "exp", "--types", "double", "--samples", "60"]
        subprocess.run([ULPGATE, *words, "--out", str(place / name)], check=True)
    git = ["git", "-c", "user.name=reader", "-c", "user.email=reader@localhost"]
    subprocess.run([*git, "init", "--quiet"], cwd=place, check=True)
    commit = [*git, "commit", "--quiet", "--allow-empty", "--message", "mine"]
    subprocess.run(commit, cwd=place, check=True)
    return place


def test_every_verb_has_two_examples_that_run(tree, folder):
    path = f"{pathlib.Path(ULPGATE).resolve().parent}:{os.environ['PATH']}"
    sleef = subprocess.run(["ldconfig", "-p"], capture_output=True, text=True).stdout
    wrong = []
    for words, text in texts(tree).items():
        examples = EXAMPLE.findall(text)
        own = " ".join(("ulpgate", *words))
        if len(examples) < 2 or not all(own in command for command, _ in examples):
            wrong.append(f"{own}: not two examples of it")
        for command, code in examples:
            if "claims sleef" in command and "libsleef" not in sleef:
                continue
            # A second one of the same directory.
            done = subprocess.run(
                ["bash", "-c", small(command)],
                cwd=folder,
                capture_output=True,
                text=True,
                env=os.environ | {"PATH": path},
            )
            codes = next((c for start, c in CODES if command.startswith(start)), (0,))
            if done.returncode not in ((int(code),) if code else codes):
                wrong.append(f"{small(command)}: {done.returncode}\n{done.stderr}")
    assert not wrong, "\n".join(wrong)


def test_an_error_on_the_command_line_is_said_on_stderr():
    done = subprocess.run(
        [ULPGATE, "math", "--out", "o", "--sample", "1"], capture_output=True
    )
    assert done.returncode == 2 and not done.stdout and b"--sample" in done.stderr
