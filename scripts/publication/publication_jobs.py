"""What a paper runs, by size: each job's records stand in OUT/runs/<name>, where reports/paper.py looks for them."""

from jobs import NATIVE, ROOT, Job, pendulum_jobs

# One or two of each order and kind: all of them take ten minutes, and Bulirsch-Stoer alone three of the stiff case.
FEW_INTEGRATORS = (
    *("leapfrog", "velocity_verlet", "forest_ruth", "yoshida8", "gauss4", "radau5"),
    *("rodas3", "rk4", "dormand_prince54"),
)

# `quick` takes minutes on two cores, `full` a night; `small` is what the tests run.
SIZES = {
    "small": {
        "functions": "sin,lgamma,cpow",
        "kernel_names": "sphere_sphere",
        "math": 200,
        "kernels": 4,
        "pendulum": None,
        "steps": 20,
        "snapshots": "0,0.001",
        "speed": (2, 2),
        "stress": ("--types", "double", "--kinds", "formula"),
        "work": ("--cases", "kepler", "--types", "float,double", "--repeats", "0"),
        "libraries": 0,
        "claims": 0,
        "builds": False,
        "published": 100,
    },
    "quick": {
        "functions": "all",
        "kernel_names": "all",
        "math": 20000,
        "kernels": 64,
        "pendulum": "quick",
        "steps": 7000,
        "snapshots": "0,0.15,0.3,0.7",
        "speed": (20, 8),
        "stress": ("--types", "float,double,long_double,float128"),
        "work": (
            *("--cases", "kepler,robertson", "--types", "float,double,float128"),
            *("--integrators", ",".join(FEW_INTEGRATORS), "--repeats", "2"),
        ),
        "libraries": 20000,
        "claims": 20000,
        "builds": False,
        "published": 0,
    },
    "full": {
        "functions": "all",
        "kernel_names": "all",
        "math": 200000,
        "kernels": 1000,
        "pendulum": "paper",
        "steps": 7000,
        "snapshots": "0,0.15,0.3,0.7",
        "speed": (100, 50),
        "stress": ("--types", "all"),
        "work": ("--cases", "kepler,robertson", "--types", "all"),
        "libraries": 2000000,
        "claims": 200000,
        "builds": True,
        "published": 20000000,
    },
}
CLAIMED = ("sleef", "libmvec", "libm")


# A run beside the times says what machine and libraries they are of.
SPEED = (
    'ulpgate="$1" out="$2"; shift 2; rm -rf "$out";'
    ' "$ulpgate" scene run deposition --types "$1" --steps "$3" --out "$out" &&'
    ' exec "$ulpgate" scene speed deposition --types "$@" --out "$out"'
)


def _speed_jobs(program, types, size, cores):
    """On one core, and on two."""
    steps, repeats = size["speed"]
    for threads in sorted({1, min(2, cores)}):
        words = ("--steps", str(steps), "--repeats", str(repeats))
        words = (",".join(types), *words, "--threads", str(threads))
        yield Job(
            f"speed/release_{threads}",
            ("-c", SPEED, "speed", program, "{out}", *words),
            program="/bin/sh",
            alone=True,
            shown=f"ulpgate scene speed deposition --types {' '.join(words)}",
        )


# Of each build: compiler and options.  The types are those whose arithmetic a compiler makes.
BUILDS = [(c, v) for c in ("gcc", "clang") for v in ("default", "vectorised", "native")]
BUILT_TYPES = ("float", "double", "long_double")


def _build_jobs(types, size, cores):
    """The same speeds of other compilers and options."""
    steps, repeats = size["speed"]
    named = [t for t in BUILT_TYPES if t in types] or types[:1]
    for compiler, variant in BUILDS if size["builds"] else ():
        for threads in sorted({1, min(2, cores)}):
            words = (compiler, variant, str(threads), str(steps), str(repeats))
            yield Job(
                f"speed/{compiler}_{variant}_{threads}",
                ("{out}", *words, ",".join(named)),
                program=str(ROOT / "scripts/publication/build_speed"),
                alone=True,
            )


def jobs_of(program, size_name, types, seed, cores):
    """All jobs of a paper; those that the most of it rests on come first."""
    size = SIZES[size_name]
    joined = ",".join(types)
    known = str(ROOT / "ci/worst_cases")
    words = ("math", "--functions", size["functions"], "--types", joined)
    words += ("--seed", str(seed))
    words += ("--samples", str(size["math"]), "--worst-cases", known)
    yield Job("math", words)
    kernels = ("kernels", "--kernels", size["kernel_names"], "--types", joined)
    kernels += ("--samples", str(size["kernels"]))
    yield Job("kernels", (*kernels, "--seed", str(seed)))
    yield from _speed_jobs(program, types, size, cores)
    deposition = ("scene", "run", "deposition", "--types", _one_of(types, "double"))
    deposition += ("--steps", str(size["steps"]), "--snapshots", size["snapshots"])
    yield Job("deposition/spheres", deposition, threads=1)
    if size["pendulum"]:
        yield from pendulum_jobs(program, types, size["pendulum"])
    yield Job("stress", ("stress", *_some(size["stress"], types)))
    yield Job(
        "work_precision",
        ("work-precision", *_some(size["work"], types)),
        resumes=False,
        alone=True,
    )
    if size["libraries"]:
        words = ("{out}", "--samples", str(size["libraries"]), "--threads", "1")
        yield Job(
            "libraries", words, program=str(ROOT / "scripts/libraries"), alone=True
        )
    if size["claims"]:
        for library in CLAIMED:
            words = ("claims", library, "--samples", str(size["claims"]))
            yield Job(f"claims/{library}", words, resumes=False)
    yield from _build_jobs(types, size, cores)
    if size["published"]:
        native = [t for t in types if t in NATIVE]
        for token in native:
            names = "real" if size["functions"] == "all" else "sin"
            words = ("math", "--functions", names, "--types", token, "--allow-large")
            words += ("--samples", str(size["published"]), "--seed", str(seed))
            words += ("--strata", "uniform,stratified")
            yield Job(f"published/{token}", words)


def _one_of(types, wanted):
    return wanted if wanted in types else types[0]


def _some(words, types):
    """The words, --types cut to those that are asked for."""
    if "--types" not in words:
        return words
    at = words.index("--types") + 1
    named = types if words[at] == "all" else words[at].split(",")
    kept = [t for t in named if t in types] or types[:1]
    return (*words[:at], ",".join(kept), *words[at + 1 :])
