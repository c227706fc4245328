"""Runs `ulpgate math` in shards as a Slurm job array, and a job that joins them when all are done: the bytes of one process.

Wants a file system that all nodes share.  A shard that fails is repeated in its job, one whose node fails is queued again
by Slurm.  The same command again submits the shards that are not done, and no others.
What follows `--` goes to sbatch, for both jobs.

    scripts/run_slurm --out full --shards 200 --time 4:00:00 --types double --samples 20000000 -- --account=abc

Exit codes: 0 submitted (with --wait: pass), 1 accuracy regression, 2 bad usage or input, 3 incomplete, 4 crash or I/O
failure.
"""

import json
import re
import shlex
import subprocess
import sys
import time

from shards import (
    BAD_INPUT,
    ENVIRONMENT,
    INCOMPLETE,
    PASS,
    ROOT,
    Failure,
    Job,
    main_of,
    parser,
    split_words,
    whole,
    write_aside,
)


def options_of(words):
    p = parser("run_slurm", __doc__)
    p.add_argument(
        "--shards",
        type=whole(1),
        required=True,
        metavar="N",
        help="parts of the run, tasks of the job array",
    )
    p.add_argument(
        "--cpus-per-task",
        dest="threads",
        type=whole(1),
        default=1,
        metavar="C",
        help="cores and threads of a shard (default 1)",
    )
    p.add_argument("--partition", metavar="P", help="as of sbatch")
    p.add_argument("--time", metavar="T", help="limit of each job, as of sbatch")
    p.add_argument(
        "--at-a-time",
        type=whole(1),
        metavar="K",
        help="run at most K shards at a time",
    )
    p.add_argument(
        "--wait", action="store_true", help="until the records are joined, or cannot be"
    )
    return split_words(p, words)


def slurm(*words):
    """Output of a Slurm command; None and its message where it fails."""
    try:
        done = subprocess.run(words, capture_output=True, text=True)
    except FileNotFoundError:
        raise Failure(
            BAD_INPUT, f"no {words[0]} here: not a machine of a Slurm cluster"
        )
    if done.returncode != 0:
        return None, done.stderr.strip()
    return done.stdout.strip(), ""


def refuse_while_queued(file):
    """Two arrays at once would work on the same shards."""
    try:
        ids = json.loads(file.read_text())["jobs"]
    except (FileNotFoundError, ValueError, KeyError):
        return
    for job in ids:
        # A job that Slurm has forgotten is an error there.
        queued, _ = slurm("squeue", "--noheader", "--format=%T", f"--jobs={job}")
        if queued:
            raise Failure(
                BAD_INPUT,
                f"job {job} of this directory is still {queued.split()[0].lower()}; wait, or `scancel {job}`",
            )


def check_array_size(shards):
    text, message = slurm("scontrol", "show", "config")
    if text is None:
        raise Failure(ENVIRONMENT, f"Slurm does not answer: {message}")
    found = re.search(r"^MaxArraySize\s*=\s*(\d+)", text, re.MULTILINE)
    if found and shards > int(found.group(1)):
        raise Failure(
            BAD_INPUT,
            f"--shards {shards}: this cluster's job arrays hold {found.group(1)}; take fewer, with more --cpus-per-task",
        )


def ranges(indices):
    """[0, 1, 2, 5] -> "0-2,5"."""
    parts = []
    for i in indices:
        if parts and parts[-1][1] == i - 1:
            parts[-1][1] = i
        else:
            parts.append([i, i])
    return ",".join(str(a) if a == b else f"{a}-{b}" for a, b in parts)


def submit(job, options, extra, name, task, *words):
    """Writes the job's script beside the shards and submits it; its id."""
    script = job.out / f"shards/{name}.sh"
    run = shlex.join(
        ["python3", str(ROOT / "scripts/cluster/run_shard.py"), str(job.out)]
    )
    write_aside(script, f"#!/bin/sh\nexec {run} {task}\n")
    command = ["sbatch", "--parsable", f"--job-name=ulpgate-{name}", *words]
    command += ["--requeue", "--open-mode=append", f"--chdir={job.out}"]
    if options.partition:
        command.append(f"--partition={options.partition}")
    if options.time:
        command.append(f"--time={options.time}")
    out, message = slurm(*command, *extra, str(script))
    if out is None:
        raise Failure(BAD_INPUT, f"sbatch: {message}")
    return out.split(";")[0]


def wait_for(job, merge):
    """Until Slurm has no active job of that id; the exit code of the merge."""
    pause_s = 1
    while True:
        states, message = slurm(
            "squeue", "--noheader", "--format=%T", f"--jobs={merge}"
        )
        # Slurm forgets a job some minutes after its end; a controller that does not answer will again.
        if states == "" or (states is None and "Invalid job id" in message):
            break
        time.sleep(pause_s)
        pause_s = min(pause_s + 1, 15)
    job.fail_unless_done()
    code = job.merge_code()
    if code is None:
        raise Failure(
            INCOMPLETE,
            f"job {merge} joined nothing; see {job.out}/shards/slurm-merge-*.log",
        )
    return code


def run(words):
    options, math, extra = options_of(words)
    check_array_size(options.shards)
    job = Job.prepare(options, math)
    file = job.out / "shards/slurm.json"
    refuse_while_queued(file)
    missing = job.missing()
    if not missing:
        return job.merge()
    job.merge_file().unlink(missing_ok=True)
    array = ranges(missing)
    if options.at_a_time:
        array += f"%{options.at_a_time}"
    shards = submit(
        job,
        options,
        extra,
        "shard",
        '"$SLURM_ARRAY_TASK_ID" -r',
        f"--array={array}",
        f"--cpus-per-task={job.threads}",
        f"--output={str(job.out).replace('%', '%%')}/shards/slurm-%A_%a.log",
    )
    write_aside(file, json.dumps({"jobs": [shards]}) + "\n")
    merge = submit(
        job,
        options,
        extra,
        "merge",
        "merge",
        f"--dependency=afterok:{shards}",
        "--kill-on-invalid-dep=yes",
        f"--output={str(job.out).replace('%', '%%')}/shards/slurm-merge-%j.log",
    )
    write_aside(file, json.dumps({"jobs": [shards, merge]}) + "\n")
    print(
        f"run_slurm: plan {job.plan}, {len(missing)} of {job.shards} shards in job {shards}, joined by job {merge}",
        file=sys.stderr,
    )
    if not options.wait:
        return PASS
    return wait_for(job, merge)


if __name__ == "__main__":
    main_of(run)
