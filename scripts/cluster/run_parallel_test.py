"""Tests of run_parallel: the bytes of one process, shards that are killed, altered or foreign, machines over ssh."""

import getpass
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time

import pytest

sys.path.insert(0, os.path.dirname(__file__))
from shards_testing import (
    ROOT,
    SMALL,
    ULPGATE,
    bytes_of_one_process,
    killed_once,
    script,
    shards_run,
)

pytestmark = [
    pytest.mark.skipif(not os.path.exists(ULPGATE), reason=f"{ULPGATE} is not built"),
    pytest.mark.skipif(shutil.which("parallel") is None, reason="no GNU parallel"),
]


@pytest.fixture(scope="module")
def one(tmp_path_factory):
    return bytes_of_one_process(tmp_path_factory.mktemp("one"))


def parallel(out, *words, program=ULPGATE):
    base = ["--out", out, "--ulpgate", program, "--shards", 3, "--jobs", 2]
    return script("run_parallel", *base, *words, *SMALL)


def test_shards_give_the_bytes_of_one_process_and_are_not_run_again(one, tmp_path):
    program = killed_once(tmp_path, "none", tmp_path)
    done = parallel(tmp_path / "a b", program=program)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "a b/math.jsonl").read_bytes() == one
    context = json.loads((tmp_path / "a b/context.json").read_text())
    assert context["complete"] is True
    assert sorted(shards_run(tmp_path)) == ["0/3", "1/3", "2/3"]

    # One record altered, one seal torn: these two run again, the third does not.
    (tmp_path / "runs").unlink()
    with open(tmp_path / "a b/shards/0-of-3/math.jsonl", "a") as records:
        records.write("{}\n")
    seal = tmp_path / "a b/shards/2-of-3/done"
    seal.write_text(seal.read_text()[:-40])
    done = parallel(tmp_path / "a b", program=program)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "a b/math.jsonl").read_bytes() == one
    assert sorted(shards_run(tmp_path)) == ["0/3", "2/3"]


def test_a_killed_shard_is_named_and_the_same_command_goes_on(one, tmp_path):
    program = killed_once(tmp_path, "1/3", tmp_path / "o")
    done = parallel(tmp_path / "o", "--retries", 0, program=program)
    assert done.returncode == 4
    assert "1 of 3 shards are not done: 1;" in done.stderr
    assert "signal 9" in done.stderr
    assert not (tmp_path / "o/math.jsonl").exists()
    kept = tmp_path / "o/shards/1-of-3/units/log.txt"
    assert " u " in kept.read_text()
    (tmp_path / "runs").unlink()
    done = parallel(tmp_path / "o", "--retries", 0, program=program)
    assert done.returncode == 0, done.stderr
    assert shards_run(tmp_path) == ["1/3"]
    assert "--resume" in (tmp_path / "runs").read_text()
    assert not kept.exists()
    assert (tmp_path / "o/math.jsonl").read_bytes() == one


def test_a_killed_shard_is_retried(one, tmp_path):
    done = parallel(
        tmp_path / "o", program=killed_once(tmp_path, "1/3", tmp_path / "o")
    )
    assert done.returncode == 0, done.stderr
    assert sorted(shards_run(tmp_path)) == ["0/3", "1/3", "1/3", "2/3"]
    assert (tmp_path / "o/math.jsonl").read_bytes() == one


def test_what_another_machine_began_starts_anew(one, tmp_path):
    # As `ulpgate math` does with units of another processor or library.
    program = tmp_path / "ulpgate"
    program.write_text(
        f"""#!/bin/sh
case " $* " in *" --shard 1/3 "*--resume*) echo another setting >&2; exit 2 ;; esac
exec "{ULPGATE}" "$@"
"""
    )
    program.chmod(0o755)
    done = parallel(tmp_path / "o", "--retries", 0, program=program)
    assert done.returncode == 0, done.stderr
    assert "from the start" in (tmp_path / "o/shards/1-of-3/log").read_text()
    assert (tmp_path / "o/math.jsonl").read_bytes() == one


def test_an_interrupted_run_goes_on(one, tmp_path):
    # The program of shard 1 waits for its interrupt.
    program = tmp_path / "ulpgate"
    program.write_text(
        f"""#!/bin/sh
case " $* " in *" --shard 1/3 "*) [ -e "{tmp_path}/started" ] || {{
  trap 'kill $!; exit 3' TERM
  touch "{tmp_path}/started"
  sleep 1000 & wait
}} ;; esac
exec "{ULPGATE}" "$@"
"""
    )
    program.chmod(0o755)
    words = ["--out", tmp_path / "o", "--ulpgate", program, "--shards", "3"]
    child = subprocess.Popen(
        [ROOT / "scripts/run_parallel", *words, *SMALL],
        stderr=subprocess.PIPE,
        text=True,
    )
    while not (tmp_path / "started").exists() and child.poll() is None:
        time.sleep(0.01)
    child.send_signal(signal.SIGTERM)
    _, err = child.communicate(timeout=100)
    assert child.returncode == 3 and "interrupted" in err
    done = script("run_parallel", *words, *SMALL)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "o/math.jsonl").read_bytes() == one


def test_another_plan_is_refused_until_overwrite(one, tmp_path):
    words = ["--functions", "sin", "--types", "float", "--samples", "100"]
    base = ["--out", tmp_path / "o", "--ulpgate", ULPGATE, "--shards", 3]
    assert script("run_parallel", *base, *words).returncode == 0
    done = parallel(tmp_path / "o")
    assert done.returncode == 2 and "another plan" in done.stderr
    done = parallel(tmp_path / "o", "--overwrite")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "o/math.jsonl").read_bytes() == one


BAD_USAGE = [
    ([], "--out"),
    (["--out", "x", "--shards", "0"], "from 1 to"),
    (["--out", "x", "--retries", "-1"], "--retries"),
    (["--out", "x", "--jobs", "many"], "--jobs 'many'"),
    (["--out", "x", "--functions", "sine"], "did you mean 'sin'"),
    (["--out", "x", "--functoins", "sin"], "--functoins"),
    (["--out", "x", "--shard", "0/3"], "the shards have their own"),
    (["--out", "x", "--resume"], "the shards have their own"),
    (["--out", "x", "--sshloginfile", "/nonexistent"], "cannot read"),
    (["--out", "x", "--fetch"], "--sshlogin"),
]


@pytest.mark.parametrize("words,message", BAD_USAGE)
def test_bad_usage_is_exit_2_with_a_message(words, message, tmp_path):
    done = script("run_parallel", *words, "--ulpgate", ULPGATE, cwd=tmp_path)
    assert done.returncode == 2
    assert message in done.stderr
    assert not (tmp_path / "x").exists()


def test_a_missing_program_is_named(tmp_path):
    done = script("run_parallel", "--out", tmp_path / "x", "--ulpgate", "/no/ulpgate")
    assert done.returncode == 2 and "/no/ulpgate" in done.stderr


def test_help_names_every_option():
    done = script("run_parallel", "--help")
    assert done.returncode == 0
    for option in "--shards --jobs --threads --retries --sshlogin --fetch".split():
        assert option in done.stdout


@pytest.fixture
def ssh_machine(tmp_path, monkeypatch):
    """A server of our own keys on this machine; yields the words that start it, and its login."""
    sshd = shutil.which("sshd", path="/usr/sbin:" + os.environ["PATH"])
    if sshd is None or shutil.which("ssh") is None:
        pytest.skip("no sshd or ssh; scripts/setup --cluster installs them")
    if os.geteuid() != 0:
        pytest.skip("sshd wants root")
    keys = tmp_path / "keys"
    keys.mkdir(mode=0o700)
    for name in ("host", "user"):
        subprocess.run(
            ["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", keys / name],
            check=True,
        )
    shutil.copy(keys / "user.pub", keys / "authorized")
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        port = s.getsockname()[1]
    os.makedirs("/run/sshd", exist_ok=True)
    config = keys / "sshd_config"
    config.write_text(
        f"Port {port}\nListenAddress 127.0.0.1\nHostKey {keys}/host\nAuthorizedKeysFile {keys}/authorized\n"
        f"StrictModes no\nUsePAM no\nPidFile {keys}/pid\nPermitRootLogin yes\nMaxStartups 100\n"
    )
    ssh = keys / "ssh_config"
    ssh.write_text(
        f"Host machine\n HostName 127.0.0.1\n Port {port}\n User {getpass.getuser()}\n IdentityFile {keys}/user\n"
        f" IdentitiesOnly yes\n StrictHostKeyChecking no\n UserKnownHostsFile {keys}/known\n LogLevel ERROR\n"
    )
    monkeypatch.setenv("PARALLEL_SSH", f"ssh -F {ssh}")
    monkeypatch.setenv("RSYNC_RSH", f"ssh -F {ssh}")
    server = []

    def start(*before):
        words = [*map(str, before), sshd, "-D", "-e", "-f", str(config)]
        server.append(subprocess.Popen(words, stderr=subprocess.PIPE, text=True))
        for line in server[0].stderr:
            if "Server listening" in line:
                return
        pytest.skip("sshd does not start here")

    yield start
    for process in server:
        process.terminate()
        process.wait()


def test_over_ssh(one, ssh_machine, tmp_path):
    ssh_machine()
    done = parallel(tmp_path / "o", "--sshlogin", "2/machine")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "o/math.jsonl").read_bytes() == one
    hosts = (tmp_path / "o/shards/joblog").read_text().splitlines()[1:]
    assert {line.split("\t")[1] for line in hosts} == {"machine"}


def test_over_ssh_without_a_shared_file_system(one, ssh_machine, tmp_path):
    here = tmp_path / "here"
    here.mkdir()
    # The server sees an empty directory where the caller's output stands.
    hide = f'mount -t tmpfs none "{here}" && exec "$@"'
    if subprocess.run(["unshare", "-m", "sh", "-c", hide, "sh", "true"]).returncode:
        pytest.skip("no mount name spaces here")
    ssh_machine("unshare", "-m", "sh", "-c", hide, "sh")
    done = parallel(here / "o", "--sshlogin", "2/machine", "--fetch")
    assert done.returncode == 0, done.stderr
    assert (here / "o/math.jsonl").read_bytes() == one
