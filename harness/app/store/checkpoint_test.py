"""Tests of checkpoints and of the exhaustive stratum, through the program itself: kill, resume, damage, full disk."""

import json
import os
import pathlib
import random
import resource
import signal
import subprocess
import sys
import time

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

import program  # noqa: E402
from program import ROOT, ULPGATE  # noqa: E402

SLOW = "ULPGATE_SANITIZED" in os.environ

SIZE = ["--functions", "sin,pow,lgamma,csqrt", "--types", "double,mpfr62"]
SIZE += ["--samples", "4000" if SLOW else "40000", "--strata", "uniform,binades,hard"]


def words(out, *more, verb="math", size=SIZE):
    timing = ["--timing", "off"] if verb == "math" else []
    return [ULPGATE, verb, "--out", str(out), *timing, *size, *more]


def run(out, *more, **options):
    done = subprocess.run(
        words(out, *more, **options), capture_output=True, text=True, cwd=ROOT
    )
    return done.returncode, done.stderr


def log_of(out):
    """The units' log of a run: which file it is, and how many units it holds."""
    try:
        log = out / "units/log.txt"
        return log.stat().st_ino, log.read_text().count("\n") - 1
    except FileNotFoundError:
        return None, 0


def killed(out, units, *more, how=signal.SIGKILL, **options):
    """Starts a run and ends it when it has finished so many units: its exit code (a run may end before), stderr.

    By units and not by seconds: a machine may be ten times as fast as another.
    """
    # A process that resumes begins a log of its own.
    before, _ = log_of(out)
    process = subprocess.Popen(
        words(out, *more, **options), stderr=subprocess.PIPE, text=True, cwd=ROOT
    )
    while process.poll() is None:
        log, done = log_of(out)
        if log != before and done >= units:
            process.send_signal(how)
            break
        time.sleep(0.002)
    _, err = process.communicate(timeout=120)
    return process.returncode, err


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The records of an uninterrupted run."""
    out = tmp_path_factory.mktemp("whole")
    code, err = run(out)
    assert code == 0, err
    assert not (out / "units").exists(), "a complete run keeps no units"
    return (out / "math.jsonl").read_bytes()


def partial(out, *more):
    """A run that was killed with a few units done."""
    code, _ = killed(out, 4, *more)
    assert code == -signal.SIGKILL, "the run was to be killed"


def test_ten_kills_and_a_resume_give_the_same_bytes(tmp_path, whole):
    random.seed(1)
    kills = 0
    sizes = []
    for _ in range(10):
        units = random.randint(1, 2 if SLOW else 20)
        code, err = killed(tmp_path, units, "--resume", "--threads", "2")
        assert code in (0, -signal.SIGKILL), err
        kills += code != 0
        if (tmp_path / "units/done.txt").exists():
            sizes.append((tmp_path / "units/done.txt").stat().st_size)
    assert kills >= 5, "most of the runs were to be killed"
    assert sizes[-1] > sizes[0], "every process goes on where the last one was"
    code, err = run(tmp_path, "--resume")
    assert code == 0, err
    assert (tmp_path / "math.jsonl").read_bytes() == whole
    assert not (tmp_path / "units").exists()
    code, err = run(tmp_path, "--resume")
    assert code == 0 and "complete already" in err


def test_a_partial_run_is_neither_lost_nor_mixed(tmp_path, whole):
    partial(tmp_path)
    kept = (tmp_path / "units/log.txt").read_bytes()
    code, err = run(tmp_path)
    assert code == 2 and "--resume" in err and "--overwrite" in err
    code, err = run(tmp_path, "--resume", "--seed", "2")
    assert code == 2 and "another plan" in err and "--overwrite" in err
    code, err = run(tmp_path, "--resume", "--shard", "0/2")
    assert code == 2 and "shard" in err
    code, err = run(tmp_path, "--resume", "--overwrite")
    assert code == 2 and "excludes" in err
    assert (tmp_path / "units/log.txt").read_bytes() == kept
    code, err = run(tmp_path, "--overwrite")
    assert code == 0, err
    assert (tmp_path / "math.jsonl").read_bytes() == whole


def test_units_of_another_machine_are_refused(tmp_path):
    partial(tmp_path)
    program.move_to_another_machine(tmp_path)
    code, err = run(tmp_path, "--resume")
    assert code == 2 and "libraries glibc" in err


def test_damaged_units_are_noted_and_done_again(tmp_path, whole):
    partial(tmp_path)
    log = tmp_path / "units/log.txt"
    lines = log.read_bytes().splitlines(keepends=True)
    lines[1] = lines[1][:60] + b"7" + lines[1][61:]
    lines[-1] = lines[-1][: len(lines[-1]) // 2]
    log.write_bytes(b"".join(lines))
    code, err = run(tmp_path, "--resume")
    assert code == 0, err
    assert "log.txt:2: 2 damaged or torn lines" in err
    assert (tmp_path / "math.jsonl").read_bytes() == whole


def test_a_file_without_its_header_is_not_trusted(tmp_path, whole):
    partial(tmp_path)
    log = tmp_path / "units/log.txt"
    log.write_bytes(b"X" + log.read_bytes())
    code, err = run(tmp_path, "--resume")
    assert code == 0 and "header is damaged" in err
    assert (tmp_path / "math.jsonl").read_bytes() == whole


def test_a_full_disk_is_exit_4_and_loses_nothing(tmp_path, whole):
    # A limit on file sizes fails a write as a full disk does.
    done = subprocess.run(
        words(tmp_path),
        capture_output=True,
        text=True,
        cwd=ROOT,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (6000, 6000)),
    )
    assert done.returncode == 4, done.stderr
    assert "units/log.txt" in done.stderr and "--resume" in done.stderr
    units = (tmp_path / "units/log.txt").read_text().count("\n") - 1
    assert units >= 1
    code, err = run(tmp_path, "--resume")
    assert code == 0, err
    assert (tmp_path / "math.jsonl").read_bytes() == whole


def test_ctrl_c_leaves_records_and_resumable_units(tmp_path, whole):
    code, err = killed(tmp_path, 6, how=signal.SIGINT)
    assert code == 3 and "--resume" in err
    assert json.loads((tmp_path / "context.json").read_text())["complete"] is False
    code, err = run(tmp_path, "--resume")
    assert code == 0, err
    assert (tmp_path / "math.jsonl").read_bytes() == whole


def test_resumed_shards_merge_to_the_same_bytes(tmp_path, whole):
    for i in range(2):
        shard = ["--shard", f"{i}/2"]
        killed(tmp_path / str(i), 3, *shard)
        code, err = run(tmp_path / str(i), "--resume", *shard)
        assert code == 0, err
    merged = subprocess.run(
        [ULPGATE, "merge", tmp_path / "0", tmp_path / "1", "--out", tmp_path / "m"]
    )
    assert merged.returncode == 0
    assert (tmp_path / "m/math.jsonl").read_bytes() == whole


def test_two_processes_do_not_share_a_directory(tmp_path, whole):
    first = subprocess.Popen(words(tmp_path), stderr=subprocess.DEVNULL, cwd=ROOT)
    try:
        for _ in range(100):
            if (tmp_path / "units/log.txt").exists():
                break
            time.sleep(0.02)
        code, err = run(tmp_path, "--resume")
        if first.poll() is None:
            assert code == 2 and "another process" in err
    finally:
        first.kill()
        first.wait()


def test_kernels_resume_to_the_same_bytes(tmp_path):
    size = ["--samples", "200" if SLOW else "3000", "--types", "double"]
    size += ["--strata", "uniform,deep", "--kernels", "sphere_sphere,wall_sphere"]
    known = json.loads(
        subprocess.run(
            [ULPGATE, "list", "kernels", "--json"], capture_output=True, text=True
        ).stdout
    )
    names = [k["kernel"] for k in known][:3]
    size[-1] = ",".join(names)
    code, err = run(tmp_path / "whole", verb="kernels", size=size)
    assert code == 0, err
    killed(tmp_path / "cut", 2, verb="kernels", size=size)
    code, err = run(tmp_path / "cut", "--resume", verb="kernels", size=size)
    assert code == 0, err
    one, other = (tmp_path / d / "kernels.jsonl" for d in ("whole", "cut"))
    assert one.read_bytes() == other.read_bytes()


def test_a_terminal_shows_the_time_left(tmp_path):
    shown = program.shown_on_terminal(*words(tmp_path)[1:])
    assert b"% " in shown or b"left" in shown
    assert b" left" in shown


EXHAUSTIVE_REFUSED = [
    (["--types", "double"], "takes float alone"),
    (["--types", "float,double"], "takes float alone"),
    (["--functions", "pow"], "2 arguments"),
    (["--functions", "sin,csin"], "a complex function"),
    (["--functions", "factorial"], "a special function"),
]


@pytest.mark.parametrize("more,message", EXHAUSTIVE_REFUSED)
def test_what_cannot_be_exhausted_is_refused(tmp_path, more, message):
    code, err = run(tmp_path / "o", *more, size=["--strata", "exhaustive"])
    assert code == 2 and message in err


def test_exhaustive_rows_are_resumable_and_not_part_of_all(tmp_path):
    size = ["--strata", "exhaustive", "--functions", "real", "--types", "all"]
    # One unit in 26 * 4096: the first of sqrt.
    shard = ["--shard", f"0/{26 * 4096}"]
    code, err = run(tmp_path / "o", *shard, size=size)
    assert code == 0, err
    records = (tmp_path / "o/math.jsonl").read_text().splitlines()
    record = json.loads(records[0])
    assert len(records) == 1 and record["stratum"] == "exhaustive"
    assert record["planned"] == 2**32 and record["samples"] == 2**20
    assert "proof" not in record, "a part proves nothing"
    context = json.loads((tmp_path / "o/context.json").read_text())
    assert len(context["functions"]) == 26
    assert [t["token"] for t in context["types"]] == ["float"]
    small = ["--strata", "all", "--functions", "sqrt", "--types", "float"]
    code, err = run(tmp_path / "all", size=[*small, "--samples", "10"])
    assert code == 0, err
    strata = json.loads((tmp_path / "all/context.json").read_text())["strata"]
    assert "exhaustive" not in strata and "uniform" in strata
