#!/usr/bin/env python3
"""Random scenes, records, budgets and command lines, and the contract that the program keeps with all of them."""

import argparse
import concurrent.futures
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile

from fuzz_edits import EDITS, NUMBERS, edited

ROOT = pathlib.Path(__file__).resolve().parents[3]
TIME_S = 20
MEMORY = 4 << 30


def limited():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


class Program:
    """Runs the program and says what of its contract it broke."""

    def __init__(self, path):
        # Cases run in directories of their own.
        self.path = str(pathlib.Path(path).resolve())

    def run(self, words, cwd, patience_s=TIME_S):
        """Exit code and fault.  With less patience Ctrl-C follows, as for a run that was asked to be long."""
        process = subprocess.Popen(
            [self.path, *words],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            cwd=cwd,
            stdin=subprocess.DEVNULL,
            preexec_fn=limited,
        )
        try:
            try:
                out, err = process.communicate(timeout=patience_s)
            except subprocess.TimeoutExpired:
                if patience_s < TIME_S:
                    process.send_signal(signal.SIGINT)
                out, err = process.communicate(timeout=max(0, TIME_S - patience_s))
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            return None, f"no end within {TIME_S} s"
        code, err = process.returncode, err.decode("utf-8", "replace")
        if not 0 <= code <= 4:
            return code, f"exit code {code}: {err[-300:]}"
        for word in ("internal error", "crashed with", "terminate called", "Assertion"):
            if word in err:
                return code, f"{word}: {err[-300:]}"
        if code != 0 and not (err.strip() or out.strip()):
            return code, f"exit code {code} without a word"
        return code, None


class Fuzz:
    def __init__(self, program, seed, directory):
        self.program = program
        self.seed = seed
        self.directory = directory
        self.scenes = sorted((ROOT / "kernels/scenes").glob("*.toml"))
        self.samples = {}

    def prepare(self):
        """Small records of every kind with budgets that hold for them."""
        runs = {
            "math": [
                "math",
                "--functions",
                "sin,pow,ctan",
                "--types",
                "float,double",
                "--samples",
                "200",
            ],
            "kernels": [
                "kernels",
                "--kernels",
                "sphere_sphere",
                "--types",
                "float",
                "--samples",
                "3",
            ],
            "scenes": [
                "scene",
                "run",
                "collision",
                "--steps",
                "20",
                "--types",
                "float,double",
                "--series",
            ],
        }
        runs["math"] += ["--timing", "off"]
        for name, words in runs.items():
            out = self.directory / "samples" / name
            budgets = self.directory / "samples" / (name + "_budgets")
            for command in (
                [*words, "--out", str(out)],
                ["gate", str(out), "--budgets", str(budgets), "--update"],
                ["gate", str(out), "--budgets", str(budgets)],
            ):
                code, fault = self.program.run(command, ROOT)
                if code != 0:
                    raise SystemExit(f"fuzz: {' '.join(command)}: {fault or code}")
            self.samples[name] = (out, budgets)

    def rng(self, kind, k):
        return random.Random(f"{self.seed} {kind} {k}")

    def case_of_scenes(self, k, place):
        rng = self.rng("scenes", k)
        file = place / "scene.toml"
        text = edited(rng.choice(self.scenes).read_text(), rng, EDITS[:-1])
        file.write_bytes(text.encode())
        words = [
            "scene",
            "run",
            str(file),
            "--steps",
            str(rng.choice([1, 2, 5])),
            "--types",
        ]
        words += [rng.choice(["float", "double", "float128", "mpfr62"])]
        return words, None

    def case_of_records(self, k, place):
        rng = self.rng("records", k)
        name = rng.choice(sorted(self.samples))
        records, budgets = self.samples[name]
        out, held = place / "out", place / "budgets"
        shutil.copytree(records, out)
        shutil.copytree(budgets, held)
        files = [p for p in sorted(out.iterdir()) if p.suffix in (".jsonl", ".json")]
        # Twice in three the records themselves.
        target = rng.choice([*files, *files, *sorted(held.iterdir())])
        target.write_bytes(edited(target.read_text(), rng, EDITS).encode())
        verb = rng.choice(["gate", "gate", "gate", "only", "merge"])
        words = ["gate", str(out), "--budgets", str(held)]
        if verb == "only":
            words += ["--only-measured"]
        if verb == "merge" and name != "scenes":
            words = ["merge", str(out), "--out", str(place / "merged")]
        must_fail = (
            "the gate passes edited records" if target.suffix == ".jsonl" else None
        )
        return words, must_fail

    def case_of_lines(self, k, place):
        rng = self.rng("lines", k)
        verb = rng.choice(
            [
                "math",
                "kernels",
                "scene run",
                "scene compare",
                "scene explain",
                "integrators",
                "at",
                "search",
            ]
        )
        options = {
            "math": [
                "--functions",
                "--types",
                "--strata",
                "--samples",
                "--seed",
                "--threads",
                "--shard",
                "--out",
            ],
            "kernels": [
                "--kernels",
                "--types",
                "--strata",
                "--samples",
                "--seed",
                "--threads",
                "--out",
            ],
            "scene run": [
                "--types",
                "--steps",
                "--until",
                "--dt",
                "--set",
                "--snapshots",
                "--threads",
                "--integrator",
            ],
            "scene compare": [
                "--types",
                "--steps",
                "--until",
                "--dt",
                "--set",
                "--threads",
                "--integrator",
            ],
            "scene explain": ["--types", "--set", "--dt"],
            "integrators": [
                "--types",
                "--problems",
                "--integrators",
                "--most-steps",
                "--tolerance",
                "--drift",
            ],
            "at": [],
            "search": ["--seconds", "--evaluations", "--seed", "--threads"],
        }[verb]
        values = [
            *NUMBERS,
            "all",
            "float",
            "double",
            "sin",
            "sqrt,exp",
            ",",
            "float,",
            "../x",
            "/dev/null",
            "R=-1",
        ]
        values += [
            "edges",
            "uniform",
            "0/1",
            "1/1",
            "0/18446744073709551615",
            "-",
            "--",
            "collision",
            "x" * 300,
            "\u00e9",
        ]
        words = verb.split()
        if verb.startswith("scene"):
            words += [
                rng.choice(["collision", "rolling", "nosuch", ".", "/dev/null", ""]),
                "--steps",
                "3",
            ]
        elif verb in ("at", "search"):
            words += [
                rng.choice(["sin", "pow", "ctan", "nosuch"]),
                rng.choice(["float", "double", "nosuch"]),
            ]
            if verb == "at":
                words += [rng.choice(values) for _ in range(rng.randrange(4))]
            else:
                words += ["--evaluations", "2000"]
        elif verb == "math":
            words += [
                "--functions",
                "sqrt",
                "--samples",
                "50",
                "--types",
                "float",
                "--out",
                str(place / "out"),
            ]
        elif verb == "kernels":
            words += [
                "--kernels",
                "sphere_sphere",
                "--samples",
                "2",
                "--types",
                "float",
                "--out",
                str(place / "out"),
            ]
        elif verb == "integrators":
            words += ["--most-steps", "64", "--problems", "oscillator"]
        for _ in range(rng.choice([1, 1, 2])):
            if not options:
                break
            option = rng.choice(options)
            value = rng.choice(values)
            if option in words:
                words[words.index(option) + 1] = value
            else:
                words += [option, value]
        return [w.replace("\0", "") for w in words], None

    def run(self, kind, k, keep=None):
        with tempfile.TemporaryDirectory(dir=self.directory) as name:
            place = pathlib.Path(name)
            words, must_fail = getattr(self, "case_of_" + kind)(k, place)
            patience_s = 5 if kind == "lines" else TIME_S
            code, fault = self.program.run(words, place, patience_s)
            if fault is None and must_fail and code == 0:
                fault = must_fail
            if fault and keep:
                shutil.copytree(place, keep / f"{kind}_{k}", dirs_exist_ok=True)
            return fault and f"{kind}:{k}: {' '.join(words)}: {fault}"


def fuzz(program, counts, seed=1, jobs=2, only=None, keep=None):
    """Runs the cases; returns what broke the contract, as text."""
    with tempfile.TemporaryDirectory() as name:
        f = Fuzz(Program(program), seed, pathlib.Path(name))
        f.prepare()
        cases = [(kind, k) for kind, n in counts.items() for k in range(n)]
        if only:
            kind, k = only.split(":")
            cases = [(kind, int(k))]
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            return [
                found for found in pool.map(lambda c: f.run(*c, keep), cases) if found
            ]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for kind in ("scenes", "records", "lines"):
        parser.add_argument(
            "--" + kind, type=int, default=0, help=f"number of random {kind}"
        )
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2, help="programs at a time")
    parser.add_argument("--only", help="one case again, such as records:17")
    parser.add_argument(
        "--keep",
        type=pathlib.Path,
        help="directory for the files of cases that broke the contract",
    )
    parser.add_argument("--ulpgate", default=ROOT / "build/release/harness/app/ulpgate")
    o = parser.parse_args()
    counts = {"scenes": o.scenes, "records": o.records, "lines": o.lines}
    found = fuzz(
        pathlib.Path(o.ulpgate).resolve(), counts, o.seed, o.jobs, o.only, o.keep
    )
    for line in found:
        print(line)
    print(
        f"fuzz: {sum(counts.values())} cases, {len(found)} broke the contract",
        file=sys.stderr,
    )
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
