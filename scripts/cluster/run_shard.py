#!/usr/bin/env python3
"""Runs one shard of a run that run_parallel or run_slurm prepared, or joins them all.

    scripts/cluster/run_shard.py OUT INDEX      one attempt
    scripts/cluster/run_shard.py OUT INDEX -r   repeats what fails, as often as the run's --retries says
    scripts/cluster/run_shard.py OUT merge      exit code 3 where a shard is missing

A shard that is done is not run again; another one goes on from its checkpoints, where `ulpgate math` keeps them.
Exit codes are ulpgate's; 0 for a shard that is done.
"""

import os
import signal
import subprocess
import sys

from shards import (
    BAD_INPUT,
    ENVIRONMENT,
    PASS,
    REGRESSION,
    Failure,
    Job,
    lock,
    main_of,
    plan_in,
    write_aside,
)


class Attempts:
    """Runs the program; an interrupt is passed on, and ends the repeats."""

    def __init__(self, job, index):
        self.job = job
        self.index = index
        self.directory = job.directory(index)
        self.child = None
        self.stopped = False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self.stop)

    def stop(self, *_):
        self.stopped = True
        if self.child is not None:
            self.child.terminate()

    def run(self, start, held):
        # What an earlier attempt left could be taken for this one's.
        for name in ("done", "exit_code", "math.jsonl", "context.json"):
            (self.directory / name).unlink(missing_ok=True)
        words = [self.job.program, "math", *self.job.math]
        words += ["--threads", str(self.job.threads), "--timing", "off"]
        words += ["--shard", f"{self.index}/{self.job.shards}"]
        words += ["--out", str(self.directory), start]
        with open(self.directory / "log", "a") as log:
            # The child keeps the lock: should this process be killed, none else starts until the child has ended.
            self.child = subprocess.Popen(
                words, stdout=log, stderr=log, pass_fds=[held.fileno()]
            )
            if self.stopped:
                self.child.terminate()
            code = self.child.wait()
        self.child = None
        if not 0 <= code <= ENVIRONMENT:
            self.say(f"ulpgate was ended by signal {-code}" if code < 0 else code)
            code = ENVIRONMENT
        # 1 with records: the oracles disagree, and all is measured.
        seal = self.job.seal(self.index, code)
        if code in (PASS, REGRESSION) and seal is not None:
            plan = plan_in(self.directory)
            if plan == self.job.plan:
                write_aside(self.directory / "done", seal)
            else:
                self.say(f"plan {plan} is not that of the run, {self.job.plan}")
                code = BAD_INPUT
        write_aside(self.directory / "exit_code", f"{code}\n")
        return code

    def say(self, text):
        with open(self.directory / "log", "a") as log:
            print(f"run_shard: {text}", file=log)


def run_shard(job, index, retries):
    if job.finished_code(index) is not None:
        return PASS
    directory = job.directory(index)
    directory.mkdir(parents=True, exist_ok=True)
    held = lock(directory / "lock")
    if held is None:
        print(f"run_shard: shard {index} still runs; waiting", file=sys.stderr)
        held = lock(directory / "lock", wait=True)
    # The records of another plan are no start for this one.
    fresh = plan_in(directory) not in (None, job.plan)
    (directory / "log").write_text("")
    attempts = Attempts(job, index)
    left = retries
    while True:
        go_on = job.resume and not fresh
        code = attempts.run("--resume" if go_on else "--overwrite", held)
        if job.finished_code(index) is not None:
            return PASS
        if code == BAD_INPUT and go_on and not attempts.stopped:
            # Units of another machine or program are refused: they may differ in their last bits.
            attempts.say("nothing to go on with here; from the start")
            fresh = True
            continue
        # Bad input and a disagreement would only come again.
        if attempts.stopped or left == 0 or code in (BAD_INPUT, REGRESSION):
            break
        attempts.say(f"exit code {code}; again, {left} left")
        left -= 1
    tail = (directory / "log").read_text(errors="replace").splitlines()[-5:]
    raise Failure(
        code,
        f"shard {index}/{job.shards} on {os.uname().nodename} ended with exit code {code}:\n"
        + "\n".join(tail),
    )


def run(words):
    if "-h" in words or "--help" in words:
        print(__doc__)
        return PASS
    retry = words[2:] == ["-r"]
    if len(words) != 2 and not retry:
        raise Failure(BAD_INPUT, "wants OUT and INDEX; see --help")
    job = Job.read(words[0])
    if words[1] == "merge":
        return job.merge()
    if not words[1].isdecimal() or int(words[1]) >= job.shards:
        raise Failure(BAD_INPUT, f"no shard '{words[1]}' among 0 to {job.shards - 1}")
    return run_shard(job, int(words[1]), job.retries if retry else 0)


if __name__ == "__main__":
    main_of(run)
