"""What the tests of the scripts for many machines share: a small run, and a program that is killed once."""

import os
import pathlib
import shlex
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))
SMALL = "--functions sin,pow --types double,float --samples 9000 --seed 4".split()
WORST = ["--worst-cases", str(ROOT / "ci/worst_cases")]


def script(name, *words, **more):
    return subprocess.run(
        [ROOT / "scripts" / name, *map(str, words)],
        capture_output=True,
        text=True,
        **more,
    )


def bytes_of_one_process(out):
    words = [ULPGATE, "math", *SMALL, *WORST, "--timing", "off", "--out", out]
    done = subprocess.run(words, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return (out / "math.jsonl").read_bytes()


def killed_once(directory, shard, out):
    """A program that notes its runs in DIRECTORY/runs and whose first run of the shard is killed at work."""
    program = directory / "ulpgate"
    log = shlex.quote(str(out / f"shards/{shard.replace('/', '-of-')}/units/log.txt"))
    program.write_text(
        f"""#!/bin/sh
case " $* " in *" --out "*/shards/*) echo "$*" >>"{directory}/runs" ;; esac
case " $* " in *" --shard {shard} "*) ;; *) exec "{ULPGATE}" "$@" ;; esac
[ ! -e "{directory}/killed" ] || exec "{ULPGATE}" "$@"
touch "{directory}/killed"
"{ULPGATE}" "$@" &
# Once some of its units are kept.
until grep -qs ' u ' {log} || ! kill -0 $!; do :; done
kill -9 $!
kill -9 $$
"""
    )
    program.chmod(0o755)
    return program


def shards_run(directory):
    """The shards in the order in which `killed_once` was called for them."""
    lines = (directory / "runs").read_text().splitlines()
    return [line.split("--shard ")[1].split()[0] for line in lines]
