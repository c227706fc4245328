"""Tests of ulpgate-mpi: the bytes of one process, with any number of ranks, and with ranks that are killed."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import time

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
BUILD = ROOT / "build/release/harness/app"
ULPGATE = os.environ.get("ULPGATE", str(BUILD / "ulpgate"))
ULPGATE_MPI = os.environ.get("ULPGATE_MPI", str(BUILD / "ulpgate-mpi"))
SMALL = (
    "--functions sin,pow,tgamma --types double,mpfr62 --samples 6000 --seed 4".split()
)
MORE = ["--worst-cases", str(ROOT / "ci/worst_cases"), "--timing", "off"]
MPIRUN = ["mpirun", "--allow-run-as-root", "--oversubscribe"]
WAIT_S = 100
HOLD_S = 20

pytestmark = [
    pytest.mark.skipif(shutil.which("mpirun") is None, reason="no mpirun"),
    pytest.mark.skipif(not os.path.exists(ULPGATE_MPI), reason="no ulpgate-mpi"),
]


@pytest.fixture(scope="module")
def one(tmp_path_factory):
    out = tmp_path_factory.mktemp("one")
    words = [ULPGATE, "math", *SMALL, *MORE, "--out", str(out)]
    subprocess.run(words, check=True, capture_output=True)
    return (out / "math.jsonl").read_bytes()


def words_of(ranks, out, *words, mpirun=(), rank=()):
    words = [*rank, ULPGATE_MPI, "--patience", "2", "math", *SMALL, *MORE, *words]
    return [*MPIRUN, *mpirun, "-np", str(ranks), *words, "--out", str(out)]


def run(ranks, out, *words):
    done = subprocess.run(
        words_of(ranks, out, *words), capture_output=True, text=True, timeout=WAIT_S
    )
    return done.returncode, done.stderr


def start(ranks, directory, *mpirun):
    """A job that has kept units, and the processes of its ranks."""
    note = 'echo $$ >"$0/pid.$OMPI_COMM_WORLD_RANK"; exec "$@"'
    rank = ["sh", "-c", note, str(directory)]
    job = subprocess.Popen(
        words_of(ranks, directory / "o", mpirun=mpirun, rank=rank),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    kept = directory / "o/units/log.txt"
    while not (kept.exists() and " u " in kept.read_text()):
        assert job.poll() is None, job.communicate()[0]
        time.sleep(0.005)
    return job, [int((directory / f"pid.{k}").read_text()) for k in range(ranks)]


def signal_all(pids, number):
    for pid in pids:
        try:
            os.kill(pid, number)
        except ProcessLookupError:
            pass


def start_and_kill(ranks, victim, directory, *mpirun):
    """Kills a rank once units are kept; exit code and messages of mpirun."""
    job, pids = start(ranks, directory, *mpirun)
    # The others are held: on a busy machine they can finish before mpirun hears of the death.
    signal_all(pids, signal.SIGSTOP)
    assert not (directory / "o/math.jsonl").exists(), "the job is too short"
    victims_pid = pids.pop(victim)
    os.kill(victims_pid, signal.SIGKILL)
    if "--enable-recovery" not in mpirun:
        try:
            job.wait(timeout=HOLD_S)
        except subprocess.TimeoutExpired:
            pass
    signal_all(pids, signal.SIGCONT)
    text, _ = job.communicate(timeout=WAIT_S)
    return job.returncode, text


@pytest.mark.parametrize("ranks", [1, 3])
def test_ranks_give_the_bytes_of_one_process(ranks, one, tmp_path):
    code, err = run(ranks, tmp_path / "o")
    assert code == 0, err
    assert (tmp_path / "o/math.jsonl").read_bytes() == one
    context = json.loads((tmp_path / "o/context.json").read_text())
    assert context["complete"] is True
    assert context["threads"] == ranks


@pytest.mark.parametrize("victim", [0, 1])
def test_a_job_that_lost_a_rank_goes_on(victim, one, tmp_path):
    code, text = start_and_kill(3, victim, tmp_path)
    assert code != 0, text
    if not (tmp_path / "o/units").exists():
        # mpirun has been seen to miss a death; then the others did the dead rank's unit too.
        assert victim != 0 and f"no answer from rank {victim}" in text, text
        assert (tmp_path / "o/math.jsonl").read_bytes() == one
        return
    assert " u " in (tmp_path / "o/units/log.txt").read_text()
    code, err = run(2, tmp_path / "o")
    assert code == 2 and "--resume" in err
    code, err = run(2, tmp_path / "o", "--resume")
    assert code == 0, err
    assert (tmp_path / "o/math.jsonl").read_bytes() == one
    assert not (tmp_path / "o/units").exists()


def test_one_process_goes_on_with_what_ranks_began(one, tmp_path):
    _, text = start_and_kill(2, 1, tmp_path)
    assert (tmp_path / "o/units").exists(), text
    words = [ULPGATE, "math", *SMALL, *MORE, "--resume", "--out", str(tmp_path / "o")]
    done = subprocess.run(words, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "o/math.jsonl").read_bytes() == one


def test_the_other_ranks_finish_without_the_one_that_died(one, tmp_path):
    code, text = start_and_kill(3, 2, tmp_path, "--enable-recovery")
    assert code == 0, text
    assert "no answer from rank 2" in text
    assert (tmp_path / "o/math.jsonl").read_bytes() == one


def test_ranks_end_although_mpirun_knows_of_no_death(one, tmp_path):
    # A stopped rank is silent, but no death that anybody is told of: finalising would wait for it.
    job, pids = start(3, tmp_path, "--enable-recovery")
    os.kill(pids[2], signal.SIGSTOP)
    try:
        until = time.monotonic() + WAIT_S
        while (
            pathlib.Path(f"/proc/{pids[0]}/exe").exists() and time.monotonic() < until
        ):
            time.sleep(0.1)
        assert time.monotonic() < until, "rank 0 waits for the silent one"
    finally:
        os.kill(pids[2], signal.SIGKILL)
        job.communicate(timeout=WAIT_S)
    assert (tmp_path / "o/math.jsonl").read_bytes() == one


def test_bad_usage_is_exit_2_with_one_message(tmp_path):
    table = [
        (["--strata", "unifrm"], "did you mean 'uniform'"),
        (["--threads", "2"], "a rank is one thread"),
        (["--no-such-option"], "no-such-option"),
    ]
    for words, message in table:
        command = [*MPIRUN, "-np", "2", ULPGATE_MPI, "math", *SMALL, *words]
        command += ["--out", str(tmp_path / "x")]
        done = subprocess.run(command, capture_output=True, text=True, timeout=WAIT_S)
        assert done.returncode == 2, done.stderr
        assert done.stderr.count(message) == 1, done.stderr
        assert not (tmp_path / "x").exists()


def test_a_rank_of_another_kind_is_named(tmp_path):
    # The second rank has other worst cases: another plan.
    (tmp_path / "w").mkdir()
    (tmp_path / "w/double.txt").write_text("sin 1\n")
    own = 'if [ "$OMPI_COMM_WORLD_RANK" = 1 ]; then set -- "$@" --worst-cases "$0"; fi; exec "$@"'
    command = [*MPIRUN, "-np", "2", "sh", "-c", own, str(tmp_path / "w")]
    command += [ULPGATE_MPI, "math", *SMALL, "--timing", "off"]
    command += ["--out", str(tmp_path / "o")]
    done = subprocess.run(
        command, capture_output=True, text=True, timeout=WAIT_S, cwd=tmp_path
    )
    assert done.returncode == 2, done.stderr
    assert "rank 1" in done.stderr and "plan" in done.stderr
