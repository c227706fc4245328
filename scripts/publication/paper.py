"""One command to a paper: runs what is missing, writes tables, figures, every number plotted, findings, paper.tex and its PDF.

    scripts/paper                         # --quick: minutes on two cores, into out/paper
    scripts/paper --full --hours 4        # the published sizes; says what was left out, the same command goes on
    scripts/paper --check                 # traces every number to a record of OUT/runs; writes OUT/trace.csv; runs the findings' commands again

OUT/runs holds the records, and status.txt there what is done, running and left; a killed run goes on with the same command.
OUT/paper.tex takes OUT/tables/*.tex and OUT/figures/*.tex; figures are PDF, SVG and PNG, NAME.* as wide as a page and
NAME_column.* as wide as one column; OUT/data has every number that is plotted or tabled, and manifest.json the checksum of every file.

Exit codes: 0 written (what is wrong in a library is what the paper is for), 1 --check: a file is not what the records give
or a finding is not shown again,
2 bad usage or input, 3 stopped or out of time (written from what is there), 4 a run failed, LaTeX failed, or no room.
"""

import argparse
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir, "night"))
from job_run import JobRun  # noqa: E402
from jobs import types_of  # noqa: E402
from night_common import (  # noqa: E402
    BAD_INPUT,
    ENVIRONMENT,
    INCOMPLETE,
    PASS,
    REGRESSION,
    ROOT,
    Failure,
    lock,
    main_of,
    more_serious,
    whole,
    write_aside,
)
from plan import hours, machine  # noqa: E402
from publication_jobs import SIZES, jobs_of  # noqa: E402

PLAN = "night.json"  # the runner's name for what a directory was begun with
COMMANDS = "commands.json"
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
# The same bytes whenever it is compiled.
TEX_ENVIRONMENT = {"SOURCE_DATE_EPOCH": "0", "FORCE_SOURCE_DATE": "1"}


class Paper(JobRun):
    """Jobs of a paper: what they find wrong is a result."""

    name = "paper"

    @property
    def command(self):
        """Goes on with it."""
        return f"scripts/paper --{self.plan['size']} --out {self.out.parent}"

    def judge(self, job, code, child):
        """A wrong result of a library is no failure of the run that found it."""
        return "pass", child.last_words() if code == REGRESSION else ""


def options_of(words):
    p = argparse.ArgumentParser(
        prog="scripts/paper",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    size = p.add_mutually_exclusive_group()
    for name in SIZES:
        size.add_argument(
            f"--{name}", dest="size", action="store_const", const=name, help=HELP[name]
        )
    p.add_argument("--out", default=str(ROOT / "out/paper"), metavar="DIR")
    p.add_argument("--hours", type=hours, metavar="H", help="runs end after that time")
    p.add_argument("--types", default="all", metavar="LIST")
    p.add_argument("--seed", type=whole(0), default=1, metavar="N")
    p.add_argument("--threads", type=whole(1), default=os.cpu_count() or 1, metavar="N")
    p.add_argument(
        "--history", metavar="FILE", help="trends of the runs in that SQLite file, too"
    )
    p.add_argument("--check", action="store_true", help="trace every number")
    p.add_argument("--no-pdf", action="store_true", help="leaves LaTeX out")
    p.add_argument("--list", action="store_true", help="print the jobs, and end")
    p.add_argument(
        "--ulpgate",
        default=str(ROOT / "build/release/harness/app/ulpgate"),
        metavar="PROGRAM",
    )
    options = p.parse_args(words)
    found = shutil.which(options.ulpgate)
    if found is None and not options.check:
        raise Failure(
            BAD_INPUT,
            f"no program {options.ulpgate}; build first: cmake --preset release && cmake --build --preset release",
        )
    options.ulpgate = os.path.abspath(found or options.ulpgate)
    return options


HELP = {
    "quick": "minutes on two cores (the default)",
    "full": "the published sizes, a night and more",
    "small": "seconds, to try it",
}


def plan_of(options, runs):
    """What the directory was begun with; another size, seed or list of types needs another directory."""
    file = runs / PLAN
    wanted = {"seed": options.seed, "size": options.size, "types": options.types}
    if file.exists():
        try:
            plan = json.loads(file.read_text())
            before = {key: plan[key] for key in wanted}
        except (ValueError, KeyError, TypeError) as e:
            raise Failure(BAD_INPUT, f"{file}: not the plan of a paper: {e!r}")
        for key, value in wanted.items():
            if value != before[key]:
                raise Failure(
                    BAD_INPUT,
                    f"{runs.parent} was begun with {key} {before[key]}, not {value}; give another --out",
                )
        return plan
    plan = {**wanted, "machine": machine()}
    runs.mkdir(parents=True, exist_ok=True)
    write_aside(file, json.dumps(plan, indent=1) + "\n")
    return plan


def shown_command(job):
    """The command as captions show it, without what goes on with a stopped run."""
    place = job.name.rsplit("/", 1)[-1]
    if job.shown:
        return job.shown
    if job.program:
        program = os.path.relpath(job.program, ROOT)
        return " ".join([program, *(w.replace("{out}", place) for w in job.words)])
    words = [os.path.relpath(w, ROOT) if w.startswith("/") else w for w in job.words]
    return " ".join(["ulpgate", *words, "--out", place])


def commands_of(jobs):
    """{job: command}, and of a directory of several the first of them with how many more."""
    found = {job.name: shown_command(job) for job in jobs}
    groups = {}
    for name in found:
        if "/" in name:
            groups.setdefault(name.split("/", 1)[0], []).append(name)
    for group, names in groups.items():
        others = f" and {len(names) - 1} more in {COMMANDS}" if len(names) > 1 else ""
        found[group] = found[names[0]] + others
    return found


def measure(options, runs):
    """Runs what is missing; returns the exit code."""
    plan = plan_of(options, runs)
    types = types_of(options.ulpgate, options.types)
    jobs = list(
        jobs_of(options.ulpgate, options.size, types, options.seed, os.cpu_count() or 1)
    )
    write_aside(runs / COMMANDS, json.dumps(commands_of(jobs), indent=1) + "\n")
    # The runner puts records into a history of its own option; the paper only reads one.
    for_runner = argparse.Namespace(**{**vars(options), "history": None})
    paper = Paper(for_runner, runs, plan, types, jobs)
    for number in SIGNALS:
        signal.signal(number, paper.stop)
    return paper.run()


def end_at_a_signal():
    """What is written is written anew by the next call, so that a signal can end it anywhere, and its program with it."""

    def stop(number, _):
        name = signal.Signals(number).name
        raise Failure(
            INCOMPLETE,
            f"stopped by {name} while the paper was written; the same command goes on",
        )

    for number in SIGNALS:
        signal.signal(number, stop)


def report(options, runs, out, *more):
    words = [sys.executable, str(ROOT / "reports/paper.py"), str(runs)]
    words += ["--out", str(out), *more]
    if options.history:
        words += ["--history", options.history]
    code = subprocess.run(words).returncode
    # Python's own code of a crash is that of a finding that is not shown again, which only a check can find.
    known = (PASS, BAD_INPUT, INCOMPLETE, ENVIRONMENT)
    if code in known or (code == REGRESSION and "--check" in more):
        return code
    print(f"paper: {words[1]} ended with exit code {code}", file=sys.stderr)
    return ENVIRONMENT


def compile_pdf(out):
    """paper.pdf by pdflatex, twice for its references; returns the exit code."""
    if shutil.which("pdflatex") is None:
        print(
            "paper: no pdflatex, so no paper.pdf; scripts/setup --paper installs it",
            file=sys.stderr,
        )
        return PASS
    words = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "paper.tex"]
    for _ in range(3):  # longtable settles its columns in three
        done = subprocess.run(
            words,
            cwd=out,
            capture_output=True,
            text=True,
            errors="replace",
            env={**os.environ, **TEX_ENVIRONMENT},
        )
        if done.returncode != 0:
            lines = [l for l in done.stdout.splitlines() if l.startswith(("!", "l."))]
            said = "; ".join(lines[:3]) or "no message"
            print(f"paper: pdflatex: {said} ({out}/paper.log)", file=sys.stderr)
            return ENVIRONMENT
    for suffix in ("aux", "out"):
        (out / f"paper.{suffix}").unlink(missing_ok=True)
    print(f"paper: {out / 'paper.pdf'}", file=sys.stderr)
    return PASS


def run(words):
    options = options_of(words)
    out = pathlib.Path(os.path.abspath(options.out))
    runs = out / "runs"
    if options.check:
        again = []
        if os.access(options.ulpgate, os.X_OK):
            again = ["--ulpgate", options.ulpgate]
        else:
            said = f"no program {options.ulpgate}: commands of findings are not run"
            print(f"paper: {said}", file=sys.stderr)
        return report(options, runs, out, "--check", *again)
    options.size = options.size or "quick"
    if options.list:
        types = types_of(options.ulpgate, options.types)
        for job in jobs_of(
            options.ulpgate, options.size, types, options.seed, os.cpu_count() or 1
        ):
            print(f"{job.name}\t{shown_command(job)}")
        return PASS
    runs.mkdir(parents=True, exist_ok=True)
    held = lock(runs / "lock")
    if held is None:
        raise Failure(ENVIRONMENT, f"{out}: another paper is made there")
    measured = measure(options, runs)
    end_at_a_signal()
    written = report(options, runs, out)
    if written != PASS:
        return more_serious(measured, written)
    compiled = PASS if options.no_pdf else compile_pdf(out)
    return more_serious(measured, compiled)


if __name__ == "__main__":
    main_of(run)
