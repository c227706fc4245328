"""Runs `ulpgate math` in shards with GNU parallel, on this machine or over ssh, and joins them: the bytes of one process.

The same command again goes on: shards that are done are not run again, the others are, from their checkpoints.
What follows `--` goes to GNU parallel.

    scripts/run_parallel --out full --types double --samples 20000000
    scripts/run_parallel --out full --types double --samples 20000000 --sshlogin 8/a,8/b --shards 64

Exit codes: 0 pass, 1 accuracy regression, 2 bad usage or input, 3 incomplete, 4 crash or I/O failure.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile

from shards import (
    BAD_INPUT,
    ENVIRONMENT,
    INCOMPLETE,
    ROOT,
    Failure,
    Job,
    lock,
    main_of,
    parser,
    split_words,
    whole,
)


def find_parallel():
    # Other programs of that name exist.
    try:
        text = subprocess.run(
            ["parallel", "--version"], capture_output=True, text=True, timeout=60
        ).stdout
    except FileNotFoundError:
        text = ""
    if "GNU parallel" not in text:
        raise Failure(BAD_INPUT, "no GNU parallel here; scripts/setup installs it")


def options_of(words):
    p = parser("run_parallel", __doc__)
    cores = os.cpu_count() or 1
    p.add_argument(
        "--shards",
        type=whole(1),
        default=4 * cores,
        metavar="N",
        help="parts of the run (default: four a core of this machine)",
    )
    p.add_argument(
        "--jobs",
        default="100%",
        metavar="J",
        help="shards at a time on a machine, as of `parallel --jobs` (default: one a core)",
    )
    p.add_argument(
        "--threads",
        type=whole(0),
        default=1,
        metavar="T",
        help="threads of a shard (default 1; 0: one a core)",
    )
    p.add_argument(
        "--sshlogin",
        action="append",
        default=[],
        metavar="L",
        help="[N/]user@host,...; `:` is this machine; may be given again",
    )
    p.add_argument(
        "--sshloginfile",
        action="append",
        default=[],
        metavar="F",
        help="machines, one a line; may be given again",
    )
    p.add_argument(
        "--fetch",
        action="store_true",
        help="the machines share no file system: send the job file, bring the shard back (rsync)",
    )
    options, math, extra = split_words(p, words)
    if not re.fullmatch(r"[+-]?\d+%?", options.jobs):
        raise Failure(
            BAD_INPUT, f"--jobs '{options.jobs}': a number or a share such as 50%"
        )
    for file in options.sshloginfile:
        if file != ".." and not os.access(file, os.R_OK):
            raise Failure(BAD_INPUT, f"--sshloginfile {file}: cannot read it")
    if options.fetch and not (options.sshlogin or options.sshloginfile):
        raise Failure(BAD_INPUT, "--fetch wants --sshlogin or --sshloginfile")
    if options.fetch and shutil.which("rsync") is None:
        raise Failure(BAD_INPUT, "--fetch wants rsync")
    return options, math, extra


def command_of(job, options, extra, indices):
    """GNU parallel over the file of indices.  It repeats what fails, over ssh on another machine."""
    words = ["parallel", "--will-cite", "--quote", "--jobs", options.jobs]
    words += ["--retries", str(job.retries + 1)]
    words += ["--joblog", str(job.out / "shards/joblog")]
    # An interrupted shard writes what it has.
    words += ["--termseq", "TERM,60000,KILL,25"]
    if sys.stderr.isatty():
        words.append("--bar")
    for login in options.sshlogin:
        words += ["--sshlogin", login]
    for file in options.sshloginfile:
        words += ["--sshloginfile", file]
    if options.fetch:
        words += ["--transferfile", str(job.out / "shards/job.json")]
        words += ["--return", f"{job.out}/shards/{{}}-of-{job.shards}"]
    words += extra
    words += ["python3", str(ROOT / "scripts/cluster/run_shard.py"), str(job.out), "{}"]
    return words + ["::::", indices]


def interrupt(*_):
    raise KeyboardInterrupt


def run_missing(job, options, extra, missing):
    with tempfile.NamedTemporaryFile("w", suffix=".shards") as indices:
        indices.write("".join(f"{i}\n" for i in missing))
        indices.flush()
        # In a session of its own: Ctrl-C comes through us, not twice.
        child = subprocess.Popen(
            command_of(job, options, extra, indices.name),
            env={**os.environ, "PARALLEL_SHELL": "/bin/sh"},
            start_new_session=True,
        )
        try:
            code = child.wait()
        except KeyboardInterrupt:
            # The first TERM ends the giving out, the second what runs.
            child.terminate()
            child.terminate()
            child.wait()
            raise
    if code == 255:
        raise Failure(ENVIRONMENT, "parallel failed; see above")


def run(words):
    options, math, extra = options_of(words)
    find_parallel()
    job = Job.prepare(options, math)
    held = lock(job.out / "shards/lock")
    if held is None:
        raise Failure(BAD_INPUT, f"another run_parallel works in {job.out}")
    missing = job.missing()
    print(
        f"run_parallel: plan {job.plan}, {len(missing)} of {job.shards} shards to run",
        file=sys.stderr,
    )
    if missing:
        run_missing(job, options, extra, missing)
    return job.merge()


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, interrupt)
    main_of(run)
