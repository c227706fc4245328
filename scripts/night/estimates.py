"""How long jobs should take: from an earlier night on this machine, or from a pilot of a few samples."""

import json
import pathlib
import subprocess
import tempfile
import time

PILOT = {"math": "--samples", "kernels": "--samples", "search": "--evaluations"}
PILOT_SIZE = {"math": 1000, "kernels": 8, "search": 20000}


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


def pilot_of(job):
    """(words of a small run, how many times larger the job is); None where a verb has no size that time goes with."""
    option = PILOT.get(job.words[0])
    if option is None or option not in job.words or "exhaustive" in job.words:
        return None
    at = job.words.index(option) + 1
    size = PILOT_SIZE[job.words[0]]
    words = (*job.words[:at], str(size), *job.words[at + 1 :])
    if "--worst-cases" in words:
        worst = words.index("--worst-cases")
        words = (*words[:worst], *words[worst + 2 :])
    return words, int(job.words[at]) / size


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
                began = time.monotonic()
                target = pathlib.Path(place) / "out"
                run = subprocess.run(
                    [program, *words, "--out", target, "--threads", str(threads)],
                    capture_output=True,
                )
                tried[key] = (
                    time.monotonic() - began if run.returncode in (0, 1) else None
                )
        if tried[key] is not None:
            seconds[job.name] = tried[key] * times
    return seconds
