"""Runs a list of jobs in one directory that survives being killed: of a night, or of a paper."""

import shutil
import subprocess
import sys
import time

from children import PATIENCE_S, Child
from estimates import earlier, keep, kept, pilot
from night_common import (
    ENVIRONMENT,
    INCOMPLETE,
    PASS,
    REGRESSION,
    ROOT,
    more_serious,
    write_aside,
)
from records import Seals, set_aside, write_manifest
from status import Status, clock, line_of, stamp

LEAST_ROOM = 64 << 20  # bytes; with less on the disk no job can keep what it has
ATTEMPTS = 2
# Sizes that pilot runs are worth their time for.
LARGE = ("night",)
# Exit codes of what a job and its gate found; `unheld`: rows without a budget.
CODES = {"pass": PASS, "red": REGRESSION, "unheld": INCOMPLETE}


class JobRun:
    """What runs jobs in their order; `name` stands before what it says, `command` goes on with it."""

    name = "jobs"
    command = ""

    def __init__(self, options, out, plan, types, jobs):
        self.options = options
        self.out = out
        self.plan = plan
        self.types = types
        self.jobs = jobs
        self.seals = Seals(out)
        self.status = Status(out, self.say)
        self.done = {}
        self.failed = {}
        self.running = []
        self.left = []
        self.attempts = {}
        self.estimates = {}
        self.ending = ""
        self.began = time.time()
        self.deadline = (
            None if options.hours is None else self.began + 3600 * options.hours
        )
        self.worst = PASS
        self.last_line = ""

    def say(self, text):
        try:
            print(f"{self.name}: {text}", file=sys.stderr, flush=True)
        except OSError:
            pass  # Nobody listens any more; the files say it.

    def stop(self, *_):
        """Of a signal: the first ends what runs and keeps it, the second ends at once."""
        if self.ending == "interrupted":
            for child in self.running:
                child.kill()
        self.ending = "interrupted"

    # What is known by now, as status.json has it.
    def facts(self, state):
        now = time.time()
        waiting = [job.name for job in self.left]
        unknown = [
            n
            for n in waiting + [c.job.name for c in self.running]
            if n not in self.estimates
        ]
        remaining = sum(self.estimates.get(n, 0) for n in waiting)
        remaining += sum(
            max(0, self.estimates.get(c.job.name, 0) - (now - c.since))
            for c in self.running
        )
        end = now + remaining
        if self.deadline is not None:
            end = min(end, self.deadline)
        return {
            "state": state,
            "out": str(self.out),
            "size": self.plan["size"],
            "seed": self.plan["seed"],
            "types": self.types,
            "machine": self.plan["machine"],
            "started": stamp(self.began),
            "deadline": None if self.deadline is None else stamp(self.deadline),
            "now": stamp(now),
            "expected_end": stamp(end) if state == "running" else None,
            "without_estimate": unknown,
            "jobs": len(self.jobs),
            "done": list(self.done.values()),
            "failed": list(self.failed.values()),
            "running": [
                {
                    "name": c.job.name,
                    "seconds": round(now - c.since, 1),
                    "estimate": self.estimates.get(c.job.name),
                }
                for c in self.running
            ],
            "left": waiting,
        }

    def tell(self, state="running"):
        facts = self.facts(state)
        self.status.write(facts)
        return facts

    def run(self):
        for job in self.jobs:
            sealed = self.seals.read(job)
            if sealed is None:
                self.left.append(job)
                if self.seals.file(job).exists() and (self.out / job.name).exists():
                    spoiled = set_aside(self.out, job)
                    self.say(
                        f"{job.name}: not the records that were sealed, now in {spoiled}"
                    )
            else:
                self.done[job.name] = sealed
                self.worst = more_serious(self.worst, CODES[sealed["verdict"]])
        self.say(
            f"{self.out}: seed {self.plan['seed']}, {len(self.jobs)} jobs, {len(self.done)} done before"
        )
        self.tell()
        self.estimate()
        told = 0
        while self.left or self.running:
            self.start_what_fits()
            self.settle()
            self.end_where_time_is_over()
            if self.ending and not self.running:
                break
            if time.monotonic() - told > 5:
                told = time.monotonic()
                self.tell()
            time.sleep(0.1)
        return self.finish()

    def estimate(self):
        self.estimates = earlier(self.out) | kept(self.out)
        missing = [job for job in self.left if job.name not in self.estimates]
        if missing and self.plan["size"] in LARGE:
            self.say("pilot runs, for the time each job should take")
            self.estimates |= pilot(
                self.options.ulpgate,
                missing,
                self.options.threads,
                lambda: bool(self.ending),
            )
            if not self.ending:
                keep(self.out, self.estimates)

    def start_what_fits(self):
        while self.left and not self.ending:
            job = self.left[0]
            wants = job.cores(self.options.threads)
            if sum(c.threads for c in self.running) + wants > self.options.threads:
                return
            free = shutil.disk_usage(self.out).free
            if free < LEAST_ROOM:
                self.ending = f"no room: {free >> 20} MiB are free where {self.out} is"
                self.worst = more_serious(self.worst, ENVIRONMENT)
                return
            try:
                child = Child(job, self.options.ulpgate, self.out, wants)
            except OSError as e:
                self.ending = f"{job.name} cannot be started: {e}"
                self.worst = more_serious(self.worst, ENVIRONMENT)
                return
            self.left.pop(0)
            self.running.append(child)
            self.tell()

    def settle(self):
        for child in list(self.running):
            code = child.code()
            if code is None:
                continue
            self.running.remove(child)
            seconds = time.time() - child.since
            if code in (PASS, REGRESSION):
                self.seal(child, code, seconds)
            elif child.told:
                self.left.insert(0, child.job)
            else:
                self.fail(child, code)
            self.tell()

    def seal(self, child, code, seconds):
        job = child.job
        try:
            verdict, why = self.judge(job, code, child)
            before = self.seals.file(job)
            facts = {
                "verdict": verdict,
                "why": why,
                "code": code,
                "seconds": round(seconds, 1),
            }
            self.done[job.name] = self.seals.write(job, facts)
        except OSError as e:
            self.ending = f"{before}: {e}"
            self.worst = more_serious(self.worst, ENVIRONMENT)
            self.left.insert(0, job)
            return
        self.worst = more_serious(self.worst, CODES[verdict])
        self.remember(job)
        self.say(
            f"{job.name}: {verdict} in {clock(seconds)}{': ' + why if why else ''}"
        )

    def judge(self, job, code, child):
        """('pass', 'red' or 'unheld', why): of the command itself, and of the gate where the job has budgets."""
        if code != PASS:
            return "red", child.last_words()
        if not job.gate:
            return "pass", ""
        words = [self.options.ulpgate, "gate", str(self.out / job.name), *job.gate]
        text = subprocess.run(words, capture_output=True, text=True)
        write_aside(
            self.out / "logs" / job.name / "gate.txt", text.stdout + text.stderr
        )
        if text.returncode == PASS:
            return "pass", ""
        lines = (text.stdout + text.stderr).strip().splitlines()
        why = f"gate: exit {text.returncode}: {lines[0] if lines else ''} (logs/{job.name}/gate.txt)"
        # Rows that have no budget, or too few samples for one: no verdict is neither a pass nor a failure.
        return "unheld" if text.returncode == INCOMPLETE else "red", why

    def remember(self, job):
        """Into the history; a file that cannot be written is said and is no fault of the job."""
        place = self.out / job.name
        if self.options.history is None or not (place / "context.json").exists():
            return
        words = [
            self.options.ulpgate,
            "history",
            "--add",
            str(place),
            "--db",
            self.options.history,
        ]
        done = subprocess.run(words, capture_output=True, text=True, cwd=ROOT)
        if done.returncode != PASS:
            lines = done.stderr.strip().splitlines()
            self.say(f"history: {lines[-1] if lines else f'exit {done.returncode}'}")
            self.worst = more_serious(self.worst, ENVIRONMENT)

    def fail(self, child, code):
        job = child.job
        self.attempts[job.name] = self.attempts.get(job.name, 0) + 1
        why = child.last_words()
        self.say(f"{job.name}: exit {code}: {why}")
        if shutil.disk_usage(self.out).free < LEAST_ROOM:
            self.left.insert(0, job)
            return  # Not the job's fault; the next start says that there is no room.
        if self.attempts[job.name] < ATTEMPTS:
            self.left.append(job)
            return
        self.failed[job.name] = {
            "name": job.name,
            "code": code,
            "why": why,
            "log": f"logs/{job.name}/log.txt",
        }
        self.worst = more_serious(self.worst, code)

    def end_where_time_is_over(self):
        if (
            self.deadline is not None
            and time.time() >= self.deadline
            and not self.ending
        ):
            self.ending = "out of time"
        if not self.ending:
            return
        for child in self.running:
            child.tell_to_end()
            if child.told and time.time() > child.told_at + PATIENCE_S:
                child.kill()

    def finish(self):
        left = [job.name for job in self.left]
        if left or self.failed:
            self.worst = more_serious(self.worst, INCOMPLETE)
        state = self.ending or ("complete" if not self.failed else "some jobs failed")
        try:
            write_manifest(self.out, self.done.values())
            self.add()
        except OSError as e:
            self.say(str(e))
            self.worst = more_serious(self.worst, ENVIRONMENT)
        facts = self.tell(state)
        self.say(line_of(facts))
        if left:
            self.say(f"left out: {', '.join(grouped(left))}")
            self.say(f"go on with: {self.command}")
        return self.worst

    def add(self):
        """What a kind of run writes beside its records."""


def grouped(jobs):
    """Names of jobs for people: searches of many functions of one type are one."""
    groups = {}
    for name in jobs:
        many = name.startswith("search/") and "_" in name
        groups.setdefault(name.rsplit("_", 1)[0] + "_*" if many else name, []).append(
            name
        )
    return [
        f"{group} ({len(names)})" if len(names) > 1 else names[0]
        for group, names in groups.items()
    ]
