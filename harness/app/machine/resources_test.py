"""Tests of resources that are not there, of files that are somebody else's, and of what the program then says."""

import json
import os
import pathlib
import resource
import signal
import subprocess
import time

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))
SIN_RUN = "math --functions sin --types double --strata uniform --timing off".split()


def run(*words, limit_mb=None, **environment):
    def limited():
        resource.setrlimit(resource.RLIMIT_AS, (limit_mb << 20, limit_mb << 20))

    done = subprocess.run(
        [ULPGATE, *map(str, words)],
        capture_output=True,
        text=True,
        env=dict(os.environ) | environment,
        timeout=60,
        preexec_fn=limited if limit_mb else None,
    )
    return done.returncode, done.stdout, done.stderr


def sin_run(out, *words, samples=4000, **how):
    return run(*SIN_RUN, "--samples", samples, "--out", out, *words, **how)


# Memory and threads


def test_b6_a_plan_that_no_memory_holds_is_refused_with_its_size(tmp_path):
    code, _, err = sin_run(tmp_path / "out", samples=10**12)
    assert code == 2 and "GB" in err and "--allow-large" in err
    assert not (tmp_path / "out").exists()


@pytest.mark.skipif(
    "ULPGATE_SANITIZED" in os.environ, reason="sanitizers map more than the limit"
)
def test_b6_memory_that_is_not_there_is_said_and_blames_nobody(tmp_path):
    words = ["--allow-large", "--threads", "1"]
    code, _, err = sin_run(
        tmp_path / "out", *words, samples=2 * 10**11, limit_mb=1024
    )
    assert code == 4 and "out of memory" in err and "sin" not in err


@pytest.mark.skipif(
    "ULPGATE_SANITIZED" in os.environ, reason="sanitizers map more than the limit"
)
def test_b7_too_little_memory_for_main_is_exit_4():
    code, _, err = run("--version", limit_mb=98)
    assert code == 4 and "out of memory" in err, (code, err)


@pytest.mark.skipif(
    "ULPGATE_SANITIZED" in os.environ, reason="sanitizers map more than the limit"
)
def test_b7_threads_that_cannot_be_created_are_said_and_blame_nobody(tmp_path):
    code, _, err = sin_run(tmp_path / "out", "--threads", "400", limit_mb=700)
    assert code == 4 and "cannot start thread" in err and "sin" not in err, err
    code, _, err = run("search", "sin", "double", "--threads", "400", limit_mb=700)
    assert code == 4 and "cannot start thread" in err and "sin" not in err, err


@pytest.mark.skipif(
    "ULPGATE_SANITIZED" in os.environ, reason="sanitizers map more than the limit"
)
def test_c_a_library_that_gives_up_is_no_regression():
    words = ["scene", "run", "collision", "--steps", "3", "--threads", "200"]
    code, _, err = run(*words, limit_mb=400, OMP_WAIT_POLICY="passive")
    assert code == 4 and "could not go on" in err, (code, err)


# Words


def test_c_a_wrong_verb_is_named():
    code, _, err = run("maths", "--functions", "sin")
    assert code == 2 and "'maths'" in err and "did you mean 'math'" in err


def test_c_nan_is_not_called_finite():
    code, out, _ = run("at", "sin", "double", "nan")
    assert code == 0 and "finite" not in out and "NaN, as it should be" in out
    code, out, _ = run("at", "exp", "double", "inf")
    assert code == 0 and "infinite, as it should be" in out
    assert (
        json.loads(run("at", "sin", "double", "nan", "--json")[1])["outcome"]
        == "finite"
    )


@pytest.mark.skipif(not pathlib.Path("/dev/full").exists(), reason="no /dev/full")
def test_c_a_full_disk_behind_stdout_is_exit_4():
    words = [
        "integrators",
        "--drift",
        "10",
        "--integrators",
        "leapfrog",
        "--types",
        "double",
    ]
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [ULPGATE, *words], stdout=full, stderr=subprocess.PIPE, text=True
        )
    assert done.returncode == 4 and "standard output" in done.stderr


def test_c_links_and_leftovers_are_not_written_through(tmp_path):
    out, victim = tmp_path / "out", tmp_path / "victim"
    victim.write_text("mine")
    out.mkdir()
    for name in ("math.jsonl", "context.json"):
        (out / f"{name}.part").symlink_to(victim)
    code, _, err = sin_run(out)
    assert code == 0, err
    assert victim.read_text() == "mine"
    assert (out / "math.jsonl").is_file() and not (out / "math.jsonl").is_symlink()
    assert {p.name for p in out.iterdir() if p.name.endswith(".part")} == {
        "math.jsonl.part",
        "context.json.part",
    }


def test_c_report_does_not_outlive_its_parent(tmp_path):
    # An interpreter that says who it is and then waits.
    python = tmp_path / "python"
    python.write_text('#!/bin/sh\necho $$ > "$PID_FILE"\nexec sleep 60\n')
    python.chmod(0o755)
    pid_file = tmp_path / "pid"
    env = dict(os.environ) | {"ULPGATE_PYTHON": str(python), "PID_FILE": str(pid_file)}
    process = subprocess.Popen(
        [ULPGATE, "report", str(tmp_path), "--print"],
        env=env,
        stderr=subprocess.DEVNULL,
    )
    for _ in range(400):
        if pid_file.exists() and pid_file.read_text().strip():
            break
        time.sleep(0.02)
    child = int(pid_file.read_text())
    process.kill()
    process.wait()
    for _ in range(400):
        try:
            state = (
                pathlib.Path(f"/proc/{child}/stat")
                .read_text()
                .rsplit(")", 1)[1]
                .split()[0]
            )
        except FileNotFoundError:
            return
        if state == "Z":
            return
        time.sleep(0.02)
    os.kill(child, signal.SIGKILL)
    pytest.fail("the report program lives on")
