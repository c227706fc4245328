#!/usr/bin/env python3
"""How often the gate turns red over other seeds and sizes than its own: of an untouched C library, and with a bug planted.

    false_failures.py [--ulpgate PROGRAM] [--seeds 20] [--sizes 2000,10000,20000,40000] [--types float,double]
                      [--functions real] [--bug "sin 2 4 20"]

Runs `math` and `gate --other-plan` with seeds from 2 on; --bug puts results of a C function in an interval some ULP off
(`narrow_bugs.c`).  Prints one line for every type and size: how many runs turned red, and the rows that were.  Exits 1
where an untouched library failed, or a planted bug passed.
"""

import argparse
import collections
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import narrow_bugs

ROOT = narrow_bugs.ROOT


def call(env, *words):
    done = subprocess.run(
        [str(w) for w in words], env=env, cwd=ROOT, capture_output=True, text=True
    )
    assert done.returncode in (0, 1), f"{words}: {done.stdout}{done.stderr}"
    return done.returncode, done.stdout


def red_rows(options, env, token, seed, size, folder):
    """Whether the gate is red, and the rows that it names."""
    plan = ["--functions", options.functions, "--types", token, "--timing", "off"]
    plan += ["--strata", "uniform,stratified,binades,edges,hard"]
    plan += ["--seed", seed, "--samples", size, "--overwrite", "--out", folder]
    call(env, options.ulpgate, "math", *plan)
    gate = ["gate", folder, "--budgets", "ci/budgets", "--only-measured"]
    code, out = call(dict(os.environ), options.ulpgate, *gate, "--other-plan", "--json")
    return code != 0, {finding_text(f) for f in json.loads(out)["findings"]}


def finding_text(finding):
    """The function and what is wrong with it, without the numbers."""
    what = re.sub(r"[-+]?\d\S*", "N", re.split("[,(]", finding["message"])[0])
    return f"{finding['function']}: {what.strip()}"


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--ulpgate", default=str(ROOT / "build/release/harness/app/ulpgate")
    )
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--sizes", default="2000,10000,20000,40000")
    parser.add_argument("--types", default="float,double")
    parser.add_argument("--functions", default="real")
    parser.add_argument("--bug")
    options = parser.parse_args(words)
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        env = dict(os.environ)
        if options.bug:
            env = narrow_bugs.environment(narrow_bugs.build(folder), options.bug)
        for token in options.types.split(","):
            for size in options.sizes.split(","):
                red = 0
                rows = collections.Counter()
                for seed in range(2, 2 + options.seeds):
                    is_red, named = red_rows(
                        options, env, token, seed, size, pathlib.Path(folder) / "o"
                    )
                    red += is_red
                    rows.update(named)
                wrong += options.seeds - red if options.bug else red
                print(
                    f"{token} {size} samples: {red} of {options.seeds} runs red",
                    *(f"  {row} ({n})" for row, n in sorted(rows.items())),
                    sep="\n",
                    flush=True,
                )
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
