#!/usr/bin/env python3
"""Holds ulpgate against the packaged YADE in one run: the pendulum bit for bit, the deposition's speed.

scripts/peers/compare_yade.py [--ulpgate PROGRAM] [--pendulum-steps N] [--deposition-steps N] [--threads N] [--repeats N]

Exit codes: 0 the trajectories are equal, 1 they are not, 3 there is no `yade` on this machine (Debian's package).
"""

import argparse
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PEERS = ROOT / "scripts/peers"


def run_yade(script, threads, out, **settings):
    environment = dict(os.environ, PEER_OUT=str(out), OMP_NUM_THREADS=str(threads))
    environment |= {name: str(value) for name, value in settings.items()}
    done = subprocess.run(
        ["yade", f"-j{threads}", "-x", "-n", str(PEERS / script)],
        env=environment,
        cwd=out.parent,
        capture_output=True,
        text=True,
    )
    if done.returncode != 0 or not out.exists():
        sys.exit(
            f"compare_yade: yade {script} failed:\n{done.stdout[-2000:]}{done.stderr[-2000:]}"
        )
    return json.loads(out.read_text())


def run_ulpgate(program, *words):
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(
            f"compare_yade: ulpgate {' '.join(map(str, words))}: exit {done.returncode}: {done.stderr}"
        )


def our_states(program, folder, steps, dt, damping):
    """Positions and velocities of the movable bodies, as hexfloats, at multiples of the first of `steps`."""
    words = [
        "scene",
        "run",
        "pendulum3",
        "--types",
        "double",
        "--steps",
        max(steps),
        "--dt",
        dt,
    ]
    words += ["--set", "mass=yade", "--set", f"damping={damping}"]
    words += [
        "--set",
        f"record_every={min(steps)}*({dt})",
        "--record",
        "--out",
        folder,
    ]
    run_ulpgate(program, *words)
    states = {}
    with open(folder / "trajectory/pendulum3_double.csv") as file:
        for row in csv.DictReader(file):
            if int(row["step"]) in steps:
                states[int(row["step"])] = [
                    [float(row[f"{q}_{body}"]).hex() for q in ("x", "y", "vx", "vy")]
                    for body in (1, 2, 3)
                ]
    return states


def compare_pendulum(o, folder):
    last = o.pendulum_steps
    steps = sorted({last // 12 * i for i in range(1, 13)} - {0} | {last})
    equal = True
    for dt, damping in (("1e-5", "0"), ("1e-5", "5e-3"), ("1e-6", "0")):
        theirs = run_yade(
            "yade_pendulum.py",
            1,
            folder / "yade.json",
            PEER_STEPS=",".join(map(str, steps)),
            PEER_DT=dt,
            PEER_DAMPING=damping,
        )
        ours = our_states(
            o.ulpgate, folder / f"pendulum_{dt}_{damping}", steps, dt, damping
        )
        same = [step for step in steps if ours.get(step) == theirs["states"][str(step)]]
        verdict = (
            "bit for bit equal" if same == steps else f"DIFFERENT, equal at {same}"
        )
        print(
            f"pendulum dt {dt} damping {damping}: {last} steps, states at {len(steps)} of them: {verdict}"
        )
        print(f"  yade: {1e9 * theirs['seconds'] / last:.0f} ns a step")
        equal = equal and same == steps
    return equal


def compare_deposition(o, folder):
    rates = {"yade": [], "ulpgate": []}
    for repeat in range(o.repeats):
        theirs = run_yade(
            "yade_deposition.py",
            o.threads,
            folder / "yade.json",
            PEER_STEPS=o.deposition_steps,
        )
        rates["yade"].append(theirs["iterations_per_s"])
        out = folder / f"deposition{repeat}"
        words = [
            "scene",
            "speed",
            "deposition",
            "--types",
            "double",
            "--steps",
            o.deposition_steps,
        ]
        run_ulpgate(
            o.ulpgate, *words, "--threads", o.threads, "--repeats", 1, "--out", out
        )
        rates["ulpgate"].append(
            json.loads((out / "timing.jsonl").read_text())["iterations_per_s"]
        )
    for name, values in rates.items():
        print(
            f"deposition {o.deposition_steps} steps, {o.threads} threads, {name}: "
            + ", ".join(f"{v:.1f}" for v in values)
            + " iterations/s"
        )
    ratios = sorted(u / y for u, y in zip(rates["ulpgate"], rates["yade"]))
    print(
        f"  ulpgate is {ratios[len(ratios) // 2]:.2f} times as fast (median of {len(ratios)})"
    )
    print(
        f"  yade: {theirs['spheres']} spheres, at the end kinetic energy {theirs['kinetic_energy']:.10g} J, "
        f"mean y {theirs['mean_y']:.10g} m"
    )


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument(
        "--ulpgate", default=str(ROOT / "build/release/harness/app/ulpgate")
    )
    parser.add_argument("--pendulum-steps", type=int, default=1_200_000, help="0: none")
    parser.add_argument("--deposition-steps", type=int, default=7000, help="0: none")
    parser.add_argument("--threads", type=int, default=1, help="of the deposition")
    parser.add_argument("--repeats", type=int, default=1, help="of the deposition")
    o = parser.parse_args()
    if shutil.which("yade") is None:
        print(
            "compare_yade: no yade on this machine: apt-get install yade",
            file=sys.stderr,
        )
        return 3
    if not os.access(o.ulpgate, os.X_OK):
        print(f"compare_yade: no program {o.ulpgate}; build first", file=sys.stderr)
        return 2
    equal = True
    with tempfile.TemporaryDirectory() as folder:
        if o.pendulum_steps > 0:
            equal = compare_pendulum(o, pathlib.Path(folder))
        if o.deposition_steps > 0:
            compare_deposition(o, pathlib.Path(folder))
    return 0 if equal else 1


if __name__ == "__main__":
    sys.exit(main())
