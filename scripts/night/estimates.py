"""How long jobs should take: from an earlier night on this machine, or from a pilot of a few samples."""

import json
import os
import pathlib
import signal
import subprocess
import tempfile
import time

from children import end_with_parent
from night_common import write_aside

PILOT = {"math": "--samples", "kernels": "--samples", "search": "--evaluations"}
PILOT_SIZE = {"math": 1000, "kernels": 8, "search": 20000}
# Strata whose number of points goes with --samples; the others are lists, which a pilot would work through in full.
DRAWN = {"uniform", "stratified", "binades"}
# A job whose pilot takes longer is begun without an estimate.
LONGEST_PILOT_S = 20


def earlier(out):
    """Seconds by job of the newest other night beside OUT on the same machine; {} where there is none."""
    here = json.loads((out / "night.json").read_text())
    nights = []
    for file in out.parent.glob("*/status.json"):
        try:
            facts = json.loads(file.read_text())
            same = facts["machine"] == here["machine"] and facts["size"] == here["size"]
            if same and file.parent != out:
                nights.append(
                    (facts["started"], {d["name"]: d["seconds"] for d in facts["done"]})
                )
        except (OSError, ValueError, KeyError, TypeError):
            continue
    return max(nights, key=lambda n: n[0])[1] if nights else {}


def kept(out):
    """Seconds by job as the pilots of this night found them before; {} where there were none."""
    try:
        found = json.loads((out / "estimates.json").read_text())
        return {str(name): float(seconds) for name, seconds in found.items()}
    except (OSError, ValueError, TypeError, AttributeError):
        return {}


def keep(out, seconds):
    """For the night that goes on; a disk that is full is another's matter."""
    try:
        write_aside(out / "estimates.json", json.dumps(seconds, indent=1) + "\n")
    except OSError:
        pass


def pilot_of(job):
    """(words of a small run, how many times larger the job is); None where a verb has no size that time goes with."""
    option = PILOT.get(job.words[0])
    if option is None or option not in job.words or "exhaustive" in job.words:
        return None
    if "--strata" in job.words:
        strata = job.words[job.words.index("--strata") + 1].split(",")
        if not DRAWN.issuperset(strata):
            return None
    at = job.words.index(option) + 1
    size = PILOT_SIZE[job.words[0]]
    words = (*job.words[:at], str(size), *job.words[at + 1 :])
    if "--worst-cases" in words:
        worst = words.index("--worst-cases")
        words = (*words[:worst], *words[worst + 2 :])
    return words, int(job.words[at]) / size


def seconds_of(words, stopped):
    """How long a command took; None where it failed, was stopped or took too long.  It ends with the night."""
    began = time.monotonic()
    child = subprocess.Popen(
        words,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
        preexec_fn=end_with_parent,
    )
    while child.poll() is None:
        if stopped() or time.monotonic() - began > LONGEST_PILOT_S:
            os.killpg(child.pid, signal.SIGKILL)
            child.wait()
            return None
        time.sleep(0.02)
    return time.monotonic() - began if child.returncode in (0, 1) else None


def pilot(program, jobs, threads, stopped):
    """Estimated seconds by job.  A search is tried once a type: its functions cost about the same to search."""
    seconds, tried = {}, {}
    for job in jobs:
        found = pilot_of(job)
        if found is None or stopped():
            continue
        words, times = found
        key = words[:1] + words[2:] if words[0] == "search" else words
        if key not in tried:
            with tempfile.TemporaryDirectory(prefix="ulpgate-pilot-") as place:
                target = str(pathlib.Path(place) / "out")
                whole = [program, *words, "--out", target, "--threads", str(threads)]
                tried[key] = seconds_of(whole, stopped)
        if tried[key] is not None:
            seconds[job.name] = tried[key] * times
    return seconds
