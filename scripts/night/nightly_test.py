"""Tests of the night: killed at random moments, stopped, out of time, on a full disk, two in one directory: the same bytes."""

import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import time

import pytest

sys.path.insert(0, os.path.dirname(__file__))
import estimates
from jobs import Job
from night_common import ROOT, more_serious
from records import Seals, record_files

ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))
pytestmark = pytest.mark.skipif(
    not os.path.exists(ULPGATE), reason=f"{ULPGATE} is not built"
)
NIGHT = [
    str(ROOT / "ci/nightly"),
    "--size",
    "small",
    "--types",
    "float",
    "--seed",
    "20260101",
    "--ulpgate",
    ULPGATE,
]
# How many nights are killed; whoever wants more asks for them.
KILLS = int(os.environ.get("ULPGATE_NIGHT_KILLS", "1"))


def night(out, *words, **more):
    return subprocess.run(
        [*NIGHT, "--out", str(out), *words], capture_output=True, text=True, **more
    )


def start(out, *words):
    return subprocess.Popen(
        [*NIGHT, "--out", str(out), *words],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )


def status(out):
    return json.loads((out / "status.json").read_text())


def records(out):
    """Bytes of every record of a night, by path."""
    return {
        str(f.relative_to(out)): f.read_bytes()
        for name in ("math", "kernels", "search", "scenes", "stress")
        for f in record_files(out / name)
    }


@pytest.fixture(scope="module")
def through(tmp_path_factory):
    """A night that ran through."""
    out = tmp_path_factory.mktemp("nights") / "through"
    done = night(out)
    assert done.returncode == 0, done.stderr
    return out, done.stderr


def wait_for(condition, seconds=120):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


def jobs_done(out):
    return len(list((out / "done").rglob("*.json")))


def test_a_night_says_what_it_did_and_its_checksums_are_right(through):
    out, said = through
    facts = status(out)
    assert facts["state"] == "complete" and not facts["left"] and not facts["running"]
    assert len(facts["done"]) == facts["jobs"] > 8
    assert (
        f"{facts['jobs']} of {facts['jobs']} jobs done"
        in (out / "status.txt").read_text()
    )
    assert facts["seed"] == 20260101
    done = subprocess.run(
        ["sha256sum", "--check", "--quiet", "records.sha256"],
        cwd=out,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    listed = {
        line.split("  ")[1]
        for line in (out / "records.sha256").read_text().splitlines()
    }
    assert listed == set(records(out))
    assert "math/lists" in said and "search/float_sin" in said


def test_its_new_worst_cases_are_a_patch(through):
    out, _ = through
    patch = (out / "worst_cases.patch").read_text()
    assert all(line.startswith(("+", "-", " ", "@")) for line in patch.splitlines())
    if patch:
        checked = subprocess.run(
            ["git", "apply", "--check", str(out / "worst_cases.patch")],
            cwd=ROOT,
            capture_output=True,
            text=True,
        )
        assert checked.returncode == 0, checked.stderr


def test_nights_killed_at_random_moments_end_in_the_same_bytes(through, tmp_path):
    out, _ = through
    wanted = records(out)
    draw = random.Random(7)
    for i in range(KILLS):
        killed = tmp_path / f"night{i}"
        words = []
        for _ in range(2):
            child = start(killed, *words)
            time.sleep(draw.uniform(0.2, 12))
            child.kill()
            child.communicate()
            if (killed / "night.json").exists():
                words = ["--resume"]
        wait_for(lambda: not at_work_in(killed))
        done = night(killed, *words)
        assert done.returncode == 0, done.stderr
        assert records(killed) == wanted
        assert (killed / "records.sha256").read_bytes() == (
            out / "records.sha256"
        ).read_bytes()


def at_work_in(place):
    """Whether a command of a night that was killed still works there."""
    found = subprocess.run(
        ["pgrep", "-f", f"{ULPGATE} .*{place}/"], capture_output=True
    )
    return found.returncode == 0


def test_commands_end_with_a_night_that_is_killed(tmp_path):
    out = tmp_path / "n"
    child = start(out)
    wait_for(lambda: at_work_in(out))
    child.kill()
    child.communicate()
    wait_for(lambda: not at_work_in(out), seconds=20)


def test_a_stopped_night_says_so_and_goes_on(through, tmp_path):
    out = tmp_path / "n"
    child = start(out)
    wait_for(lambda: jobs_done(out) >= 1)
    child.send_signal(signal.SIGTERM)
    _, said = child.communicate(timeout=60)
    assert child.returncode == 3
    assert "interrupted" in said and "go on with: ci/nightly --out" in said
    assert status(out)["state"] == "interrupted" and status(out)["left"]
    # Another plan is refused, and so is a start over it.
    assert night(out, "--resume", "--types", "double").returncode == 2
    assert "holds a night" in night(out).stderr
    assert night(out, "--resume").returncode == 0
    assert records(out) == records(through[0])


def test_a_night_out_of_time_names_what_was_left_out(tmp_path):
    out = tmp_path / "n"
    done = night(out, "--hours", "0.0008")
    assert done.returncode == 3, done.stderr
    facts = status(out)
    assert facts["state"] == "out of time" and facts["left"]
    assert f"left out: {facts['left'][0]}" in done.stderr
    # What matters most was begun first.
    assert (
        "search/float_lgamma" in facts["left"] and "math/lists" not in facts["left"][1:]
    )


def test_two_nights_do_not_share_a_directory(tmp_path):
    out = tmp_path / "n"
    child = start(out)
    wait_for(lambda: (out / "night.json").exists())
    second = night(out, "--resume")
    assert second.returncode == 4 and "another night is at work" in second.stderr
    child.send_signal(signal.SIGINT)
    child.communicate()


def test_a_record_that_was_altered_is_made_again(through, tmp_path):
    out = tmp_path / "n"
    subprocess.run(["cp", "-a", str(through[0]), str(out)], check=True)
    wanted = records(out)
    with open(out / "kernels/large_float/kernels.jsonl", "a") as file:
        file.write("{}\n")
    seal = out / "done/math/lists.json"
    seal.write_text(seal.read_text()[:50])
    done = night(out, "--resume")
    assert (
        "kernels/large_float: pass" in done.stderr and "math/lists: pass" in done.stderr
    )
    assert "search/float_sin: pass" not in done.stderr
    assert records(out) == wanted


def test_a_crashing_program_is_tried_twice_and_named(tmp_path):
    program = tmp_path / "ulpgate"
    program.write_text(
        f'#!/bin/sh\ncase "$1" in kernels) kill -SEGV $$ ;; *) exec "{ULPGATE}" "$@" ;; esac\n'
    )
    program.chmod(0o755)
    out = tmp_path / "n"
    done = night(out, "--ulpgate", str(program), timeout=300)
    assert done.returncode == 4
    facts = status(out)
    assert facts["state"] == "some jobs failed"
    assert [f["name"] for f in facts["failed"]] == [
        "kernels/budgets",
        "kernels/large_float",
    ]
    assert done.stderr.count("kernels/large_float: exit 4") == 2
    assert len(facts["done"]) == facts["jobs"] - 2


def test_a_row_that_is_wrong_turns_the_night_red(tmp_path):
    """A gate that fails is the night's verdict; the job's records stay."""
    program = tmp_path / "ulpgate"
    program.write_text(
        f'#!/bin/sh\ncase "$1" in gate) echo "FAIL sin"; exit 1 ;; *) exec "{ULPGATE}" "$@" ;; esac\n'
    )
    program.chmod(0o755)
    out = tmp_path / "n"
    done = night(out, "--ulpgate", str(program), timeout=300)
    assert done.returncode == 1, done.stderr
    red = [d["name"] for d in status(out)["done"] if d["verdict"] == "red"]
    assert "math/lists" in red and "kernels/budgets" in red


@pytest.fixture
def small_disk(tmp_path):
    place = tmp_path / "disk"
    place.mkdir()
    mounted = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=96m", "tmpfs", place],
        capture_output=True,
        text=True,
    )
    if mounted.returncode != 0:
        pytest.skip(f"no tmpfs can be mounted here: {mounted.stderr.strip()}")
    yield place
    subprocess.run(["umount", place], check=True)


def test_a_full_disk_loses_nothing(through, small_disk):
    out = small_disk / "n"
    child = start(out)
    wait_for(lambda: jobs_done(out) >= 2)
    filler = small_disk / "filler"
    # Unbuffered: what is still in a buffer would be written, and fail, once more when the file is closed.
    with open(filler, "wb", buffering=0) as file:
        try:
            while True:
                file.write(b"\0" * 65536)
        except OSError:
            pass
    _, said = child.communicate(timeout=300)
    assert child.returncode == 4, said
    assert "no room" in said
    filler.unlink()
    done = night(out, "--resume")
    assert done.returncode == 0, done.stderr
    assert records(out) == records(through[0])


@pytest.mark.parametrize(
    "words, text",
    [
        (["--hours", "0"], "hours above 0"),
        (["--hours", "soon"], "hours above 0"),
        (["--types", "quad"], "no type 'quad'"),
        (["--size", "huge"], "invalid choice"),
        (["--seed", "-1"], "--seed -1"),
        (["--ulpgate", "/nowhere/ulpgate"], "build first"),
        (["--frobnicate"], "unrecognized"),
    ],
)
def test_bad_usage_is_2_and_named(tmp_path, words, text):
    done = night(tmp_path / "n", *words)
    assert done.returncode == 2
    assert text in done.stderr


def test_a_plan_that_is_torn_is_refused(tmp_path):
    out = tmp_path / "n"
    out.mkdir()
    (out / "night.json").write_text('{"seed": 1')
    done = night(out, "--resume")
    assert done.returncode == 2 and "night.json" in done.stderr


def test_a_night_without_what_it_knew_is_refused(through, tmp_path):
    copy = tmp_path / "night"
    shutil.copytree(through[0], copy)
    shutil.rmtree(copy / "known_cases")
    done = night(copy, "--resume")
    assert done.returncode == 2 and "known_cases is gone" in done.stderr


def test_a_pilot_is_of_drawn_points_alone():
    """A list is as long at any size: its pilot would be the job itself, and its estimate many times too large."""
    words = ("math", "--types", "float", "--samples", "20000", "--strata")
    assert estimates.pilot_of(Job("lists", (*words, "edges,hard,worst"))) is None
    found, times = estimates.pilot_of(Job("drawn", (*words, "uniform,binades")))
    assert times == 20 and "1000" in found


def test_a_pilot_ends_with_the_night(tmp_path, monkeypatch):
    program = tmp_path / "slow"
    program.write_text(f"#!/bin/sh\necho $$ >{tmp_path}/pid\nexec sleep 600\n")
    program.chmod(0o755)
    words = ("math", "--types", "float", "--samples", "20000", "--strata", "uniform")
    job = Job("slow", words)
    pid = tmp_path / "pid"
    began = time.monotonic()
    stopped = lambda: pid.exists() and pid.read_text().endswith("\n")  # noqa: E731
    assert estimates.pilot(str(program), [job], 1, stopped) == {}
    assert time.monotonic() - began < 60, "told to stop"
    with pytest.raises(ProcessLookupError):
        os.kill(int(pid.read_text()), 0)
    # And one that takes too long is no estimate.
    monkeypatch.setattr(estimates, "LONGEST_PILOT_S", 0.2)
    assert estimates.pilot(str(program), [job, job], 1, lambda: False) == {}


def test_a_night_that_goes_on_knows_its_pilots(tmp_path):
    assert estimates.kept(tmp_path) == {}
    estimates.keep(tmp_path, {"math/lists": 96.5})
    assert estimates.kept(tmp_path) == {"math/lists": 96.5}
    for torn in ("", "[1]", '{"math/lists": "soon"}', '{"math'):
        (tmp_path / "estimates.json").write_text(torn)
        assert estimates.kept(tmp_path) == {}
    estimates.keep(tmp_path / "nowhere", {})  # said by whoever needs the disk


def test_the_more_serious_exit_code():
    assert (
        more_serious(0, 1) == 1
        and more_serious(1, 3) == 3
        and more_serious(3, 2) == 2
        and more_serious(2, 4) == 4
    )
    assert more_serious(139, 4) == 139


def test_a_seal_holds_its_records(tmp_path):
    class Named:
        name = "a/b"

    (tmp_path / "a/b").mkdir(parents=True)
    (tmp_path / "a/b/x.jsonl").write_text("1\n")
    (tmp_path / "a/b/timing.jsonl").write_text("2\n")
    seals = Seals(tmp_path)
    seals.write(Named, {"verdict": "pass"})
    assert list(seals.read(Named)["records"]) == ["a/b/x.jsonl"]
    (tmp_path / "a/b/timing.jsonl").write_text("3\n")
    assert seals.read(Named) is not None
    (tmp_path / "a/b/x.jsonl").write_text("4\n")
    assert seals.read(Named) is None
