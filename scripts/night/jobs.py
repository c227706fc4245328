"""What a night runs, the most important first, and how large: each job is one command that keeps its own checkpoints.

A job that is killed goes on with the same command, so a night is no more than an order of jobs and a note of those done.
"""

import dataclasses
import json
import pathlib
import subprocess

from night_common import BAD_INPUT, ROOT, Failure

# A seed and a size of its own are another plan, and few types less, than those of the budgets.
HELD = ("--budgets", str(ROOT / "ci/budgets"), "--other-plan", "--only-measured")
NATIVE = ["float", "double", "long_double", "float128"]
# `small` takes less than a minute on two cores: it is what the tests of the night run.  Where no functions are named the
# searches are of all real ones.
SIZES = {
    "night": {
        "math": 20000000,
        "special": 2000000,
        "kernels": 20000,
        "search": 4000000,
        "searched": (),
        "scene_steps": 3000,
        "pendulum": True,
        "exhaustive": True,
        "stress": (),
    },
    "small": {
        "math": 2000,
        "special": 0,
        "kernels": 8,
        "search": 2000,
        "searched": ("sqrt", "sin", "pow", "lgamma"),
        "scene_steps": 50,
        "pendulum": False,
        "exhaustive": False,
        "stress": ("--kinds", "formula"),
    },
}


@dataclasses.dataclass(frozen=True)
class Job:
    """One command.  Its records stand in OUT/<name>; `words` are those of ulpgate, without --out and --resume."""

    name: str
    words: tuple
    # 0: as many threads as the night has; jobs of one thread run beside each other.
    threads: int = 0
    # What its records are held to, of `ulpgate gate`; empty where its own exit code is the verdict.
    gate: tuple = ()
    # Whether the verb takes --resume; one without is short, or has nothing to go on from.
    resumes: bool = True
    # --out names a file and not a directory.
    out_is_file: bool = False
    # Another program than ulpgate; its words are whole, with {out} for OUT/<name>.
    program: str = ""
    # It measures time: nothing runs beside it, and how many threads it has is among its words.
    alone: bool = False
    # How it is shown to people, where its words say more than they should know.
    shown: str = ""

    def cores(self, all_cores):
        """How many it takes of those that a run of jobs has."""
        return all_cores if self.alone else self.threads or all_cores

    def command(self, ulpgate, place, threads):
        """What is run, with all its words."""
        if self.program:
            words = [word.replace("{out}", str(place)) for word in self.words]
            return [self.program, *words]
        words = [ulpgate, *self.words, "--out", str(place)]
        if self.resumes:
            words.append("--resume")
        if self.threads != 1 and not self.alone:
            words += ["--threads", str(threads)]
        return words


def asked(program, *words):
    """What the program prints for WORDS."""
    done = subprocess.run([program, *words], capture_output=True, text=True)
    if done.returncode != 0:
        raise Failure(
            BAD_INPUT,
            f"`ulpgate {' '.join(words)}` ended with {done.returncode}: {done.stderr.strip()}",
        )
    return done.stdout


def types_of(program, wanted):
    """The types that were built, in the order of their cost; those of WANTED alone where it is not 'all'."""
    built = [
        row["token"] for row in json.loads(asked(program, "list", "types", "--json"))
    ]
    types = built if wanted == "all" else wanted.split(",")
    for token in types:
        if token not in built:
            raise Failure(
                BAD_INPUT,
                f"--types: no type '{token}' was built; these were: {', '.join(built)}",
            )
    return sorted(types, key=built.index)


def math_job(name, functions, types, samples, seed, strata, known):
    words = (
        "math",
        "--functions",
        functions,
        "--types",
        types,
        "--samples",
        str(samples),
        "--seed",
        str(seed),
    )
    worst = ("--worst-cases", str(known), "--strata", strata)
    return Job(f"math/{name}", words + worst, gate=HELD)


def known_beside(worst_cases):
    """The worst cases as they were when the night began."""
    return pathlib.Path(worst_cases).with_name("known_cases")


def search_jobs(program, types, sizes, seed, worst_cases):
    """What a search finds goes into WORST_CASES, what it knows stays: one that was killed after it had added its own, and is
    made again, would else pass over them."""
    known = known_beside(worst_cases)
    rows = json.loads(asked(program, "list", "functions", "--json"))
    real = [row["function"] for row in rows if row["class"] == "real"]
    for token in types:
        for function in sizes["searched"] or real:
            words = (
                "search",
                function,
                token,
                "--evaluations",
                str(sizes["search"]),
                "--seed",
                str(seed),
            )
            keep = ("--worst-cases", str(worst_cases), "--known", str(known))
            yield Job(
                f"search/{token}_{function}",
                words + keep,
                resumes=False,
                out_is_file=True,
            )


def pendulum_jobs(program, types, size="night"):
    """The suite's own list: scripts/pendulum says what it runs."""
    words = [
        "--size",
        size,
        "--types",
        ",".join(types),
        "--ulpgate",
        program,
        "--list",
    ]
    done = subprocess.run(
        [ROOT / "scripts/pendulum", *words], capture_output=True, text=True
    )
    if done.returncode != 0:
        raise Failure(
            BAD_INPUT,
            f"`scripts/pendulum --list` ended with {done.returncode}: {done.stderr.strip()}",
        )
    for line in done.stdout.splitlines():
        name, *command = line.split("\t")
        yield Job(
            f"pendulum/{name}",
            tuple(word for word in command if word != "--resume"),
            threads=1,
        )


def jobs_of(program, size, types, seed, worst_cases):
    """All jobs of a night, in the order in which they matter: what a merge could have missed comes first."""
    sizes = SIZES[size]
    joined = ",".join(types)
    native = [t for t in types if t in NATIVE]
    first = [t for t in native if t in ("float", "double")]
    wide = [t for t in types if t not in NATIVE]

    known = known_beside(worst_cases)

    def drawn(kinds, tokens):
        for kind in kinds:
            samples = sizes["math"] if kind == "real" else sizes["special"]
            for t in tokens if samples else ():
                strata = "uniform,stratified,binades"
                yield math_job(f"{kind}_{t}", kind, t, samples, seed, strata, known)

    jobs = [math_job("lists", "all", joined, 20000, seed, "edges,hard,worst", known)]
    # In the plan of the budgets, and in many more states, whose verdicts stand in the records.
    kernels = ("kernels", "--types", joined, "--samples")
    gate = ("--budgets", str(ROOT / "ci/budgets/kernels"), "--only-measured")
    jobs.append(Job("kernels/budgets", (*kernels, "64"), gate=gate))

    # A job a type: in one, multiprecision would take the hours of all that comes after it.
    def large(tokens):
        for t in tokens:
            words = ("kernels", "--types", t, "--samples", str(sizes["kernels"]))
            yield Job(f"kernels/large_{t}", (*words, "--seed", str(seed)))

    jobs += drawn(["real"], first)
    jobs += large(first)
    jobs.append(Job("stress", ("stress", "--types", joined, *sizes["stress"])))
    others = [t for t in native if t not in first]
    jobs += drawn(["real"], others)
    jobs += large(others)
    if sizes["exhaustive"] and "float" in types:
        every = ("math", "--types", "float", "--strata", "exhaustive")
        jobs.append(
            Job(
                "math/exhaustive",
                every,
                gate=("--budgets", str(ROOT / "ci/budgets/exhaustive")),
            )
        )
    jobs += search_jobs(program, native, sizes, seed, worst_cases)
    if native:
        words = (
            "scene",
            "compare",
            "deposition",
            "--steps",
            str(sizes["scene_steps"]),
            "--types",
            ",".join(native),
        )
        jobs.append(Job("scenes/deposition", words, resumes=False))
    if sizes["pendulum"]:
        jobs += pendulum_jobs(program, types)
    jobs += drawn(["complex", "special"], native)
    jobs += large(wide)
    jobs += drawn(["real", "complex", "special"], wide)
    return jobs
