#!/usr/bin/env python3
"""What the gate meets of a bug of 3 ULP in a narrow interval: plants it by a preloaded library, runs, gates, counts.

    narrow_bugs.py [--ulpgate PROGRAM] [--trials 14] [--seed 1] [--strata drawn,narrow]

`drawn` is the gate's 2e4 samples of the strata uniform, stratified, binades, edges and hard, `narrow` its scan.
Prints one line for every function, band of exponents and relative width: of how many trials the gate turned red.
"""

import argparse
import os
import pathlib
import random
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
SOURCE = pathlib.Path(__file__).with_name("narrow_bugs.c")
PLANS = {
    "drawn": ("ci/budgets", "uniform,stratified,binades,edges,hard"),
    "narrow": ("ci/budgets/narrow", "narrow"),
}
# Function under test, type, name of the C function, binary exponents of the band, relative widths.
BANDS = [
    ("sin", "double", "sin", (-1, 6), (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)),
    ("sin", "double", "sin", (-30, 30), (1e-2, 1e-3, 1e-4)),
    ("sin", "double", "sin", (-300, 1000), (1e-1, 1e-2)),
    ("exp", "double", "exp", (-1, 6), (1e-3, 1e-4, 1e-6)),
    ("exp", "float", "expf", (-1, 6), (1e-3, 1e-4, 1e-5, 1e-6)),
]


def build(folder):
    """The library to preload."""
    library = pathlib.Path(folder) / "narrow_bugs.so"
    subprocess.run(
        ["cc", "-O1", "-shared", "-fPIC", "-o", library, SOURCE, "-ldl", "-lm"],
        check=True,
    )
    return library


def environment(library, plan):
    """The environment of a program with the bug "FUNCTION LOW HIGH ULP"."""
    return {**os.environ, "LD_PRELOAD": str(library), "NARROW_BUG": plan}


def interval(rng, exponents, width):
    low = 2 ** rng.uniform(*exponents)
    return low, low * (1 + width)


def caught(ulpgate, library, function, token, plan, which, folder, samples=20000):
    """Exit code of the gate on records measured with the bug, and the largest error of them."""
    budgets, strata = PLANS[which]
    words = ["--functions", function, "--types", token, "--strata", strata]
    words += [
        "--samples",
        str(samples),
        "--timing",
        "off",
        "--overwrite",
        "--out",
        folder,
    ]
    measured = subprocess.run(
        [ulpgate, "math", *words],
        env=environment(library, plan),
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert measured.returncode in (0, 1), measured.stderr
    gate = subprocess.run(
        [ulpgate, "gate", folder, "--budgets", budgets, "--only-measured"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert gate.returncode in (0, 1), gate.stdout + gate.stderr
    return gate.returncode


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--ulpgate", default=str(ROOT / "build/release/harness/app/ulpgate")
    )
    parser.add_argument("--trials", type=int, default=14)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--strata", default="drawn,narrow")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        library = build(folder)
        for function, token, name, exponents, widths in BANDS:
            for width in widths:
                rng = random.Random(options.seed)
                plans = [
                    f"{name} {low.hex()} {high.hex()} 3"
                    for low, high in (
                        interval(rng, exponents, width) for _ in range(options.trials)
                    )
                ]
                counts = [
                    f"{which} {sum(caught(options.ulpgate, library, function, token, p, which, folder + '/o') for p in plans)}"
                    for which in options.strata.split(",")
                ]
                print(
                    f"{function} {token} 2^{exponents[0]}..2^{exponents[1]} width {width:g}: "
                    f"{', '.join(counts)} of {options.trials}",
                    flush=True,
                )


if __name__ == "__main__":
    main()
