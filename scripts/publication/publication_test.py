"""Tests of scripts/paper: every chapter has its runs, a second call measures nothing again, a killed one goes on."""

import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

import pytest

sys.path.insert(0, os.path.dirname(__file__))
import paper
import publication_jobs
from night_common import ROOT

sys.path.insert(0, str(ROOT / "reports"))
from ulpgate_report.paper.chapters import CHAPTERS

ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))
WORDS = ["--ulpgate", ULPGATE, "--no-pdf", "--types", "float"]


def run(*words):
    return subprocess.run(
        [ROOT / "scripts/paper", *words], capture_output=True, text=True
    )


def test_every_chapter_has_a_run():
    names = set()
    for size in ("quick", "full"):
        done = run(f"--{size}", "--list", "--ulpgate", ULPGATE)
        assert done.returncode == 0, done.stderr
        jobs = [line.split("\t")[0] for line in done.stdout.splitlines()]
        assert len(jobs) == len(set(jobs))
        names |= {job.split("/")[0] for job in jobs}
    # A history is given and not run.
    assert {c.run for c in CHAPTERS} - {"history"} <= names


def test_a_command_is_shown_as_people_type_it():
    jobs = publication_jobs.jobs_of(ULPGATE, "quick", ["double"], 1, 2)
    shown = {job.name: paper.shown_command(job) for job in jobs}
    assert shown["math"].startswith("ulpgate math --functions all --types double")
    assert "--worst-cases ci/worst_cases" in shown["math"]
    assert shown["speed/release_2"] == (
        "ulpgate scene speed deposition --types double --steps 20 --repeats 8 --threads 2"
    )
    assert (
        shown["libraries"] == "scripts/libraries libraries --samples 20000 --threads 1"
    )
    assert str(ROOT) not in " ".join(shown.values())


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """A small paper that was killed once on its way."""
    out = tmp_path_factory.mktemp("paper") / "out"
    words = [ROOT / "scripts/paper", "--small", *WORDS, "--out", out]
    first = subprocess.Popen(words, stderr=subprocess.PIPE, text=True)
    # Killed once its first job runs, wherever that is.
    while first.poll() is None and not (out / "runs/logs").exists():
        time.sleep(0.01)
    first.send_signal(signal.SIGTERM)
    _, said = first.communicate()
    assert first.returncode in (3, 0), said
    done = run("--small", *WORDS, "--out", str(out))
    assert done.returncode == 0, done.stderr
    return out


def test_a_killed_paper_is_finished_by_the_same_command(small):
    facts = json.loads((small / "runs/status.json").read_text())
    assert facts["state"] == "complete" and not facts["left"] and not facts["failed"]
    text = (small / "paper.tex").read_text()
    for title in ("Functions", "Kernels", "Speed of a whole simulation", "Findings"):
        assert rf"\section{{{title}" in text, title


def test_captions_name_the_command_of_their_run(small):
    text = (small / "figures/heatmap.caption.txt").read_text()
    assert re.search(
        r"Command: `ulpgate math --functions sin,lgamma,cpow .*--out math`", text
    )


def test_a_second_call_measures_nothing_and_gives_the_same_bytes(small):
    manifest = (small / "data/manifest.json").read_bytes()
    words = [ROOT / "scripts/paper", "--small", *WORDS, "--out", small]
    with subprocess.Popen(words, stderr=subprocess.PIPE, text=True) as stopped:
        lines = iter(stopped.stderr.readline, "")
        drawn = next((line for line in lines if ": heatmap" in line), None)
        stopped.send_signal(signal.SIGTERM)
        said = stopped.stderr.read()
    assert drawn and stopped.returncode == 3, said
    assert "stopped by SIGTERM while the paper was written" in said
    assert "Traceback" not in said
    done = run("--small", *WORDS, "--out", str(small))
    assert done.returncode == 0, done.stderr
    assert re.search(r"(\d+) jobs, \1 done before", done.stderr), done.stderr
    assert (small / "data/manifest.json").read_bytes() == manifest


def test_every_number_is_traced_but_the_one_changed_by_hand(small):
    changed = small / "data" / "type_table.csv"
    before = changed.read_text()
    changed.write_text(before.replace("float", "double", 1))
    try:
        done = run("--check", "--out", str(small), "--ulpgate", ULPGATE)
    finally:
        changed.write_text(before)
    assert done.returncode == 1
    named = done.stderr.splitlines()
    assert named and all("data/type_table.csv" in line for line in named), done.stderr
    told = re.search(r"; (\d+) of (\d+) commands of findings show", done.stdout)
    assert told and told[1] == told[2] != "0", done.stdout


@pytest.mark.parametrize(
    "words, expected",
    [
        (["--quick"], "was begun with size small"),
        (["--small", "--seed", "2"], "was begun with seed 1"),
        (["--small", "--ulpgate", "/nowhere"], "no program /nowhere"),
        (["--small", "--types", "half"], "no type 'half'"),
        (["--small", "--hours", "-1"], "a number of hours above 0"),
    ],
)
def test_bad_usage_is_named(small, words, expected):
    given = [*WORDS, *words, "--out", str(small)]
    if "--types" in words:
        given[-1] = str(pathlib.Path(small).with_name("other"))
    done = run(*given)
    assert done.returncode == 2 and expected in done.stderr, done.stderr
