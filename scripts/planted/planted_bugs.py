"""Plants bugs, one at a time, and asks whether the gate turns red and names the culprit first.

    ci/planted [--ulpgate PROGRAM] [--bugs LIST] [--out DIR] [--list]

Bugs in C functions are preloaded into PROGRAM (build/release).  Those in sources are changed in a copy of the last commit
below DIR (out/planted), which is built for a few types.  Every command is run without the bug first: it must be green,
else its red says nothing.  scripts/planted/bugs.toml says what is planted, which size of the gate finds it and which is known to miss it.

Prints a line for each bug and size.  Exit codes: 0 everything is as bugs.toml says; 1 a bug was not found that
should be, or another row came first; 2 bad usage; 4 a build or a program failed.
"""

import argparse
import json
import os
import pathlib
import shlex
import subprocess
import sys
import tomllib
from dataclasses import dataclass, field

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUGS = pathlib.Path(__file__).with_name("bugs.toml")
LIBRARY = ROOT / "harness/app/run/narrow_bugs.c"


class Failure(Exception):
    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


@dataclass
class Size:
    found: bool
    words: list
    budgets: str = ""  # of words for ulpgate; none for words of ci/gate
    culprit: str = ""  # of this size, where it is not the bug's

    @property
    def text(self):
        return shlex.join((["ulpgate"] if self.budgets else ["ci/gate"]) + self.words)


@dataclass
class Bug:
    name: str
    what: str
    culprit: str
    sizes: list
    preload: str = ""
    file: str = ""
    before: str = ""
    after: str = ""
    outcomes: list = field(default_factory=list)


def read_bugs(file=BUGS):
    """(types of the build, bugs); Failure names what is wrong with one."""
    try:
        data = tomllib.loads(file.read_text())
        bugs = []
        for entry in data["bug"]:
            sizes = [
                Size(
                    s["found"],
                    s.get("gate") or s["ulpgate"],
                    s.get("budgets", ""),
                    s.get("culprit", ""),
                )
                for s in entry.pop("sizes")
            ]
            bugs.append(Bug(sizes=sizes, **entry))
        return data["types"], bugs
    except (OSError, tomllib.TOMLDecodeError, KeyError, TypeError) as e:
        raise Failure(2, f"{file}: {e!r}")


def planted(text, bug):
    """The text of a source with the bug; where its place is gone the bug no longer exists, which is said."""
    if text.count(bug.before) != 1:
        raise Failure(
            4,
            f"{bug.name}: {bug.file} holds `{bug.before}` {text.count(bug.before)} times, not once: mend {BUGS.name}",
        )
    return text.replace(bug.before, bug.after)


def run(words, cwd, environment=None, codes=(0,)):
    done = subprocess.run(
        [str(w) for w in words],
        cwd=cwd,
        env={**os.environ, **(environment or {})},
        capture_output=True,
        text=True,
        errors="replace",
    )
    if done.returncode not in codes:
        raise Failure(
            4,
            f"`{shlex.join(map(str, words))}` ended with {done.returncode}:\n{(done.stdout + done.stderr)[-3000:]}",
        )
    return done


def first_finding(sarif):
    """'kernels/double/row' and message of what the gate names first; None where it names nothing."""
    results = json.loads(sarif.read_text())["runs"][0]["results"]
    failed = [r for r in results if r["level"] == "error"]
    if not failed:
        return None
    place = failed[0]["locations"][0]["logicalLocations"][0]["fullyQualifiedName"]
    return place, failed[0]["message"]["text"].splitlines()[0], len(failed)


def gated(size, program, tree, out, environment):
    """Exit code of the gate on what `program` computes, and the first finding."""
    out.mkdir(parents=True, exist_ok=True)
    sarif = out / "gate.sarif"
    sarif.unlink(missing_ok=True)
    outputs = ["--sarif", sarif]
    if size.budgets:
        words = [program, *size.words, "--out", out / "records", "--overwrite"]
        done = run(words, tree, environment, codes=range(256))
        if done.returncode not in (0, 1):
            (out / "gate.txt").write_text(done.stdout + done.stderr)
            return done.returncode, None
        gate = [program, "gate", out / "records", "--budgets", tree / size.budgets]
        done = run([*gate, "--only-measured", *outputs], tree, codes=range(256))
    else:
        gate = [tree / "ci/gate", "--ulpgate", program, "--out", out]
        done = run([*gate, *size.words, *outputs], tree, environment, range(256))
    (out / "gate.txt").write_text(done.stdout + done.stderr)
    return done.returncode, first_finding(sarif) if sarif.exists() else None


class Trials:
    """Runs sizes with and without bugs; a control is run once for each program and size."""

    def __init__(self, out, say):
        self.out = out
        self.say = say
        self.controls = {}

    def control(self, size, program, tree):
        key = (str(program), size.text)
        if key not in self.controls:
            out = self.out / "control" / str(len(self.controls))
            self.controls[key] = gated(size, program, tree, out, {})
            self.say(
                f"without a bug: {size.text}: exit {self.controls[key][0]} (wanted 0)"
            )
        return self.controls[key]

    def attempt(self, bug, size, number, program, tree, environment):
        """True where it came out as bugs.toml says; what happened is printed."""
        out = self.out / bug.name / str(number)
        code, finding = gated(size, program, tree, out, environment)
        if code == 0:
            good = not size.found
            text = "MISSED" if size.found else "missed, as is known of this size"
        elif code == 1 and finding:
            culprit = size.culprit or bug.culprit
            named = culprit in finding[0]
            good = size.found and named
            text = f"red, {finding[2]} rows, first {finding[0]}: {finding[1]}"
            if not named:
                text += f" -- NOT {culprit}"
            if not size.found:
                text += " -- bugs.toml says that this size misses it"
        else:
            good = False
            text = f"NO VERDICT, exit {code}: {out / 'gate.txt'}"
        self.say(f"{bug.name}: {size.text}: {text}")
        bug.outcomes.append({"size": size.text, "exit": code, "first": finding})
        return good


def build(tree, types, jobs):
    """The program of a tree, for a few types."""
    where = tree / "build/planted"
    if not (where / "build.ninja").exists():
        run(
            [
                *("cmake", "-S", tree, "-B", where, "-G", "Ninja"),
                *("-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O2"),
                f"-DULPGATE_TYPES={';'.join(types)}",
                *("-DULPGATE_BUILD_TESTS=OFF", "-DULPGATE_BUILD_BENCHMARKS=OFF"),
            ],
            tree,
        )
    run(
        ["cmake", "--build", where, "--parallel", jobs, "--target", "ulpgate"],
        tree,
    )
    return where / "harness/app/ulpgate"


def copy_of_commit(tree):
    """The last commit, as files; what is there already and the same is left alone, so that nothing is built twice."""
    tree.mkdir(parents=True, exist_ok=True)
    if not (tree / ".git").exists():
        run(["git", "clone", "-q", "--shared", ROOT, tree], ROOT)
    run(["git", "fetch", "-q", ROOT, "HEAD"], tree)
    run(["git", "checkout", "-q", "--force", "--detach", "FETCH_HEAD"], tree)


def library(folder):
    folder.mkdir(parents=True, exist_ok=True)
    made = folder / "planted.so"
    run(["cc", "-O1", "-shared", "-fPIC", "-o", made, LIBRARY, "-ldl", "-lm"], ROOT)
    return made


def try_preloaded(bug, trials, program, out):
    environment = {"LD_PRELOAD": str(library(out)), "NARROW_BUG": bug.preload}
    good = True
    for number, size in enumerate(bug.sizes):
        if trials.control(size, program, ROOT)[0] != 0:
            raise Failure(4, f"{size.text} is red without a bug")
        good &= trials.attempt(bug, size, number, program, ROOT, environment)
    return good


def try_in_sources(bug, trials, types, out):
    tree = out / "tree"
    jobs = os.environ.get("ULPGATE_JOBS", str(os.cpu_count()))
    source = tree / bug.file
    right = source.read_text()
    wrong = planted(right, bug)
    for size in bug.sizes:
        program = build(tree, types, jobs)
        if trials.control(size, program, tree)[0] != 0:
            raise Failure(4, f"{size.text} is red without a bug")
    try:
        source.write_text(wrong)
        program = build(tree, types, jobs)
        return all(
            [
                trials.attempt(bug, size, number, program, tree, {})
                for number, size in enumerate(bug.sizes)
            ]
        )
    finally:
        source.write_text(right)


def main(words):
    p = argparse.ArgumentParser(
        prog="ci/planted",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    p.add_argument("--ulpgate", default=str(ROOT / "build/release/harness/app/ulpgate"))
    p.add_argument("--bugs", default="all", metavar="LIST")
    p.add_argument("--out", default=str(ROOT / "out/planted"), metavar="DIR")
    p.add_argument("--list", action="store_true")
    options = p.parse_args(words)
    types, bugs = read_bugs()
    if options.list:
        for bug in bugs:
            print(f"{bug.name}: {bug.what}")
        return 0
    if options.bugs != "all":
        wanted = options.bugs.split(",")
        for name in wanted:
            if name not in [b.name for b in bugs]:
                raise Failure(2, f"--bugs: no bug '{name}'; --list names them")
        bugs = [b for b in bugs if b.name in wanted]
    program = pathlib.Path(options.ulpgate).resolve()
    if any(b.preload for b in bugs) and not os.access(program, os.X_OK):
        raise Failure(2, f"no program {program}; build first: ci/build release")
    out = pathlib.Path(options.out).resolve()
    trials = Trials(out, lambda text: print(text, flush=True))
    if any(b.file for b in bugs):
        copy_of_commit(out / "tree")
    good = 0
    for bug in bugs:
        print(f"{bug.name}: {bug.what}", flush=True)
        good += (
            try_preloaded(bug, trials, program, out)
            if bug.preload
            else try_in_sources(bug, trials, types, out)
        )
    (out / "planted.json").write_text(
        json.dumps({b.name: b.outcomes for b in bugs}, indent=2) + "\n"
    )
    print(f"planted: {good} of {len(bugs)} bugs are found as {BUGS.name} says")
    return 0 if good == len(bugs) else 1


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except Failure as failure:
        print(f"ci/planted: {failure}", file=sys.stderr)
        sys.exit(failure.code)
    except KeyboardInterrupt:
        sys.exit(130)
