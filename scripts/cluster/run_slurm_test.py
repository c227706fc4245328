"""Tests of run_slurm on a cluster of one node whose daemons the test starts in a temporary configuration."""

import getpass
import json
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import time

import pytest

sys.path.insert(0, os.path.dirname(__file__))
from run_slurm import ranges
from shards_testing import (
    SMALL,
    ULPGATE,
    bytes_of_one_process,
    killed_once,
    script,
    shards_run,
)

DAEMONS = ("munged", "slurmctld", "slurmd", "sbatch")
PATHS = "/usr/sbin:" + os.environ["PATH"]
LACKING = [name for name in DAEMONS if shutil.which(name, path=PATHS) is None]
built = pytest.mark.skipif(not os.path.exists(ULPGATE), reason=f"{ULPGATE} not built")


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


def slurm_conf(directory):
    host = socket.gethostname().split(".")[0]
    controller, node = free_ports(2)
    return f"""ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser={getpass.getuser()}
SlurmctldPort={controller}
SlurmdPort={node}
AuthType=auth/munge
AuthInfo=socket={directory}/munge.socket
CredType=cred/munge
SlurmctldPidFile={directory}/slurmctld.pid
SlurmdPidFile={directory}/slurmd.pid
SlurmdSpoolDir={directory}/spool
StateSaveLocation={directory}/state
ProctrackType=proctrack/linuxproc
SwitchType=switch/none
TaskPlugin=task/none
MpiDefault=none
ReturnToService=2
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_interval=1
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/none
MaxArraySize=10
NodeName={host} NodeAddr=127.0.0.1 CPUs=3 State=UNKNOWN
PartitionName=here Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


@pytest.fixture(scope="module")
def cluster():
    if LACKING:
        pytest.skip(f"no {', '.join(LACKING)}; scripts/setup --cluster installs them")
    if os.geteuid() != 0:
        pytest.skip("the daemons want root")
    # munged wants directories that everybody can enter.
    directory = pathlib.Path(tempfile.mkdtemp(prefix="slurm-"))
    directory.chmod(0o755)
    for name in ("spool", "state"):
        (directory / name).mkdir()
    (directory / "slurm.conf").write_text(slurm_conf(directory))
    (directory / "munge.key").write_bytes(os.urandom(128))
    (directory / "munge.key").chmod(0o400)
    munge = {"key-file": "key", "socket": "socket", "pid-file": "pid"}
    munge |= {"log-file": "log", "seed-file": "seed"}
    munge = [f"--{option}={directory}/munge.{end}" for option, end in munge.items()]
    os.environ["SLURM_CONF"] = str(directory / "slurm.conf")
    daemons = []

    def start(*words):
        log = open(directory / f"{words[0]}.log", "w")
        words = [shutil.which(words[0], path=PATHS), *words[1:]]
        daemons.append(subprocess.Popen(words, stdout=log, stderr=log))

    try:
        start("munged", "--foreground", *munge)
        wait_until(lambda: (directory / "munge.socket").exists(), "munged")
        start("slurmctld", "-D")
        start("slurmd", "-D")
        wait_until(lambda: "idle" in query("sinfo", "-h", "-o", "%t"), "slurmd")
        yield directory
    finally:
        for daemon in reversed(daemons):
            daemon.terminate()
        for daemon in daemons:
            daemon.wait()
        shutil.rmtree(directory)
        del os.environ["SLURM_CONF"]


def query(*words):
    return subprocess.run(words, capture_output=True, text=True).stdout


def wait_until(happened, what, seconds=60):
    end = time.monotonic() + seconds
    while not happened():
        assert time.monotonic() < end, f"{what}: not within {seconds} s"
        time.sleep(0.1)


@pytest.fixture(scope="module")
def one(tmp_path_factory):
    return bytes_of_one_process(tmp_path_factory.mktemp("one"))


def slurm(out, *words, program=ULPGATE):
    base = ["--out", out, "--ulpgate", program, "--shards", 3, "--partition", "here"]
    return script("run_slurm", *base, "--time", 10, *words, *SMALL)


@built
def test_an_array_and_its_merge_give_the_bytes_of_one_process(one, cluster, tmp_path):
    # The first run of shard 1 is killed: its job repeats it.
    out = tmp_path / "a b"
    program = killed_once(tmp_path, "1/3", out)
    done = slurm(out, "--wait", program=program)
    assert done.returncode == 0, done.stderr
    assert (out / "math.jsonl").read_bytes() == one
    assert json.loads((out / "context.json").read_text())["complete"] is True
    assert sorted(shards_run(tmp_path)) == ["0/3", "1/3", "1/3", "2/3"]
    (merge,) = (out / "shards").glob("slurm-merge-*.log")
    assert "3 shards merged" in merge.read_text()


@built
def test_a_failed_shard_alone_is_submitted_again(one, cluster, tmp_path):
    program = killed_once(tmp_path, "1/3", tmp_path / "o")
    out = tmp_path / "o"
    done = slurm(out, "--wait", "--retries", 0, program=program)
    assert done.returncode == 4
    assert "1 of 3 shards are not done: 1;" in done.stderr
    assert not (out / "math.jsonl").exists()
    (tmp_path / "runs").unlink()
    done = slurm(out, "--wait", "--retries", 0, program=program)
    assert done.returncode == 0, done.stderr
    assert shards_run(tmp_path) == ["1/3"]
    assert (out / "math.jsonl").read_bytes() == one


@built
def test_a_shard_that_slurm_takes_from_its_node_runs_again(one, cluster, tmp_path):
    # As when a node fails: shard 1 hangs in its first run, and Slurm queues it again.
    program = tmp_path / "ulpgate"
    program.write_text(
        f"""#!/bin/sh
case " $* " in *" --shard 1/3 "*) [ -n "$SLURM_RESTART_COUNT" ] || {{
  touch "{tmp_path}/hangs"
  exec sleep 1000
}} ;; esac
exec "{ULPGATE}" "$@"
"""
    )
    program.chmod(0o755)
    out = tmp_path / "o"
    done = slurm(out, program=program)
    assert done.returncode == 0, done.stderr
    wait_until((tmp_path / "hangs").exists, "shard 1")
    again = slurm(out, program=program)
    assert again.returncode == 2 and "scancel" in again.stderr
    shards, merge = json.loads((out / "shards/slurm.json").read_text())["jobs"]
    subprocess.run(["scontrol", "requeue", f"{shards}_1"], check=True)
    state = lambda: query("squeue", "-h", "-o", "%T %r", "-j", f"{shards}_1")
    wait_until(lambda: "PENDING" in state(), "the requeue")
    # Slurm would wait two minutes; in the second of the requeue the node still refuses the job.
    subprocess.run(
        ["scontrol", "update", f"jobid={shards}_1", "starttime=now+3"], check=True
    )
    wait_until(lambda: not query("squeue", "-h", "-j", merge), "the merge")
    assert (out / "math.jsonl").read_bytes() == one


@built
def test_bad_usage_is_exit_2_with_a_message(cluster, tmp_path):
    table = [
        (["--shards", "11"], "job arrays hold 10"),
        (["--strata", "unifrm"], "did you mean 'uniform'"),
        (["--partition", "nowhere"], "nowhere"),
        (["--cpus-per-task", "0"], "from 1 to"),
        (["--", "--no-such-option"], "no-such-option"),
    ]
    for words, message in table:
        base = ["--out", "x", "--shards", "3", "--ulpgate", ULPGATE, *SMALL]
        done = script("run_slurm", *base, *words, cwd=tmp_path)
        assert done.returncode == 2, done.stderr
        assert message in done.stderr


def test_help_and_missing_options():
    done = script("run_slurm", "--help")
    assert done.returncode == 0 and "--at-a-time" in done.stdout
    done = script("run_slurm", "--out", "x")
    assert done.returncode == 2 and "--shards" in done.stderr


def test_ranges():
    for indices, text in [([0], "0"), ([0, 1, 2, 5], "0-2,5"), ([1, 3], "1,3")]:
        assert ranges(indices) == text
