"""A run of `ulpgate math` in shards: its job file, what a finished shard is, and the merge.

OUT/shards/job.json     plan, number of shards, program, options; written before a shard starts
OUT/shards/I-of-N/      records of a shard, its log, its checkpoints
OUT/shards/I-of-N/done  written last: plan, shard, exit code and checksums; without a valid one a shard runs again

Standard library alone: the scripts run on nodes where nothing else is installed.
"""

import argparse
import fcntl
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Exit codes are ulpgate's.
PASS, REGRESSION, BAD_INPUT, INCOMPLETE, ENVIRONMENT = range(5)
# These are the shards' own.
RESERVED = ("--shard", "--resume", "--timing", "--json", "--dry-run")


class Failure(Exception):
    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


def main_of(run):
    """Runs a script's main and turns failures into a message and an exit code."""
    name = pathlib.Path(sys.argv[0]).stem
    try:
        sys.exit(run(sys.argv[1:]))
    except Failure as e:
        print(f"{name}: {e}", file=sys.stderr)
        sys.exit(e.code)
    except OSError as e:
        print(f"{name}: {e}", file=sys.stderr)
        sys.exit(ENVIRONMENT)
    except KeyboardInterrupt:
        print(f"{name}: interrupted; the same command goes on", file=sys.stderr)
        sys.exit(INCOMPLETE)


def whole(least):
    def parse(text):
        if not text.isdecimal() or not least <= int(text) <= 999999:
            raise argparse.ArgumentTypeError(
                f"'{text}': a whole number from {least} to 999999 is wanted"
            )
        return int(text)

    return parse


def parser(name, doc):
    """The options that every script has; its doc string is its help."""
    p = argparse.ArgumentParser(
        prog=f"scripts/{name}",
        description=doc,
        usage=f"scripts/{name} --out DIR [option...] [option of `ulpgate math`...] [-- option...]",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    p.add_argument(
        "--out",
        required=True,
        metavar="DIR",
        help="the joined records; the shards' own stand in DIR/shards",
    )
    p.add_argument(
        "--retries",
        type=whole(0),
        default=2,
        metavar="R",
        help="a shard that fails is run again up to R times (default 2)",
    )
    p.add_argument(
        "--ulpgate",
        default=str(ROOT / "build/release/harness/app/ulpgate"),
        metavar="PROGRAM",
        help="default build/release/harness/app/ulpgate; under the same path on every machine, as these scripts",
    )
    p.add_argument(
        "--overwrite",
        action="store_true",
        help="DIR holds the records of another plan, and may lose them",
    )
    return p


def split_words(p, words):
    """(our options, options of `ulpgate math`, what follows `--`)."""
    cut = words.index("--") if "--" in words else len(words)
    options, math = p.parse_known_args(words[:cut])
    for word in math:
        if word.split("=")[0] in RESERVED:
            raise Failure(
                BAD_INPUT, f"{word}: the shards have their own, it cannot be given"
            )
    return options, math, words[cut + 1 :]


def absolute_paths(math):
    """A relative path means the caller's directory, and a shard may run in another one."""
    math = list(math)
    given = False
    for i, word in enumerate(math):
        if word == "--worst-cases" and i + 1 < len(math):
            math[i + 1] = os.path.abspath(math[i + 1])
        elif word.startswith("--worst-cases="):
            math[i] = "--worst-cases=" + os.path.abspath(word.split("=", 1)[1])
        given = given or word.split("=")[0] == "--worst-cases"
    return math if given else math + ["--worst-cases", str(ROOT / "ci/worst_cases")]


def plan_in(directory):
    """The plan hash in DIR/context.json; None where there is none."""
    try:
        return json.loads((directory / "context.json").read_text())["plan"]
    except FileNotFoundError:
        return None
    except (ValueError, KeyError, TypeError):
        return "unreadable"


def find_plan(program, math):
    """Lets the program check the options and name the plan; its hash and the number of its units."""
    words = [*math, "--timing", "off", "--dry-run", "--out", os.devnull]
    done = subprocess.run([program, "math", *words], capture_output=True, text=True)
    if done.returncode != 0:
        sys.stderr.write(done.stderr)
        known = 0 < done.returncode <= ENVIRONMENT
        raise Failure(
            done.returncode if known else ENVIRONMENT,
            f"`ulpgate math` does not take these options (exit code {done.returncode}); see above",
        )
    facts = json.loads(done.stdout)
    return facts["plan"], facts["units"]


def has_resume(program):
    text = subprocess.run([program, "math", "--help"], capture_output=True, text=True)
    return "--resume" in text.stdout


def write_aside(path, text):
    aside = path.with_name(path.name + ".part")
    with open(aside, "w") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    os.replace(aside, path)


class Job:
    """A run in shards."""

    def __init__(self, out, facts):
        self.out = pathlib.Path(out)
        self.plan = facts["plan"]
        self.shards = facts["shards"]
        # What stands in OUT may be another plan's, and was given up.
        self.over = ["--overwrite"] if facts.get("overwrite") else []
        self.threads = facts["threads"]
        self.retries = facts["retries"]
        self.program = facts["program"]
        self.math = facts["math"]
        self.resume = facts["resume"]

    @staticmethod
    def prepare(options, math):
        """Checks options and OUT, and writes the job file."""
        program = shutil.which(options.ulpgate)
        if program is None:
            raise Failure(
                BAD_INPUT,
                f"no program {options.ulpgate}; build first: cmake --preset release && cmake --build --preset release",
            )
        math = absolute_paths(math)
        program = os.path.abspath(program)
        plan, units = find_plan(program, math)
        shards = min(options.shards, units)
        if shards < options.shards:
            print(f"note: the plan has {units} units: {shards} shards", file=sys.stderr)
        out = pathlib.Path(os.path.abspath(options.out))
        (out / "shards").mkdir(parents=True, exist_ok=True)
        file = out / "shards/job.json"
        there = plan_in(out)
        if there is None and file.exists():
            there = Job.read(out).plan
        if there not in (None, plan) and not options.overwrite:
            raise Failure(
                BAD_INPUT,
                f"{out} holds the records of another plan ({there}); choose another --out or give --overwrite",
            )
        facts = {
            "plan": plan,
            "shards": shards,
            "overwrite": options.overwrite,
            "threads": options.threads,
            "retries": options.retries,
            "program": program,
            "math": math,
            # Whether the program keeps checkpoints.
            "resume": has_resume(program),
        }
        write_aside(file, json.dumps(facts, indent=1) + "\n")
        return Job(out, facts)

    @staticmethod
    def read(out):
        file = pathlib.Path(out) / "shards/job.json"
        try:
            return Job(out, json.loads(file.read_text()))
        except FileNotFoundError:
            raise Failure(
                BAD_INPUT,
                f"{file}: no such file; run_parallel and run_slurm write it",
            )
        except (ValueError, KeyError, TypeError) as e:
            raise Failure(BAD_INPUT, f"{file}: not a job file: {e!r}")

    def directory(self, index):
        return self.out / f"shards/{index}-of-{self.shards}"

    def seal(self, index, code):
        """What `done` says of a finished shard; None where its records are not there."""
        text = f"plan {self.plan}\nshard {index}/{self.shards}\ncode {code}\n"
        for name in ("math.jsonl", "context.json"):
            try:
                content = (self.directory(index) / name).read_bytes()
            except FileNotFoundError:
                return None
            text += f"{hashlib.sha256(content).hexdigest()}  {name}\n"
        return text

    def finished_code(self, index):
        """0 or 1 (the oracles disagree) of a shard that is done; None of one that is torn, foreign or not done."""
        try:
            text = (self.directory(index) / "done").read_text()
        except (FileNotFoundError, UnicodeDecodeError):
            return None
        for code in (PASS, REGRESSION):
            if text == self.seal(index, code):
                return code
        return None

    def missing(self):
        return [i for i in range(self.shards) if self.finished_code(i) is None]

    def last_code(self, index):
        """Exit code of the last attempt; INCOMPLETE where none is known."""
        try:
            return int((self.directory(index) / "exit_code").read_text())
        except (FileNotFoundError, ValueError):
            return INCOMPLETE

    def fail_unless_done(self):
        missing = self.missing()
        if not missing:
            return
        codes = [self.last_code(i) for i in missing]
        # No verdict before a bad one, and a crash before all.
        for code in (ENVIRONMENT, BAD_INPUT, INCOMPLETE, REGRESSION):
            if code in codes:
                break
        names = ", ".join(str(i) for i in missing[:20])
        raise Failure(
            code,
            f"{len(missing)} of {self.shards} shards are not done: {names}{', ...' if len(missing) > 20 else ''}; "
            f"logs are in {self.out}/shards/I-of-{self.shards}/log; the same command runs these again",
        )

    def merge(self):
        """Joins the shards into OUT; the exit code."""
        self.fail_unless_done()
        directories = [str(self.directory(i)) for i in range(self.shards)]
        code = subprocess.run(
            [self.program, "merge", *directories, "--out", str(self.out), *self.over]
        ).returncode
        if not 0 <= code <= ENVIRONMENT:
            raise Failure(ENVIRONMENT, f"ulpgate merge ended with {code}")
        write_aside(self.merge_file(), f"{code}\n")
        return code

    def merge_file(self):
        return self.out / "shards/merge_code"

    def merge_code(self):
        """Exit code of the last merge; None where there was none."""
        try:
            return int(self.merge_file().read_text())
        except (FileNotFoundError, ValueError):
            return None


def lock(path, wait=False):
    """An open file that holds a lock as long as it, or a child that inherits it, lives; None: another has it."""
    file = open(path, "a")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
    except BlockingIOError:
        return None
    except OSError:
        pass  # A file system without locks: nobody else is kept out.
    return file
