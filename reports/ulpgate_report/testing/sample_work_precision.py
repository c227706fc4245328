"""Makes synthetic lines of work_precision.jsonl for the tests; `python3 -m ulpgate_report.testing.sample_work_precision DIR`."""
import json
import math
import sys
from pathlib import Path

from ulpgate_report.testing.sample_records import PLAN, REAL, TYPES, share
from ulpgate_report.testing.sample_scenes import context

BITS = {row[0]: row[-1] for row in TYPES}
# Seconds of an evaluation in each type, against double.
COSTS = dict(zip(BITS, (0.9, 1.0, 2.0, 35.0, 60.0, 110.0, 240.0)))
_SECOND = 2e-8
# Name, order, evaluations a step, error of a step of 1.
INTEGRATORS = (
    ("symplectic_euler", 1, 1, 1.0),
    ("leapfrog", 2, 1, 0.3),
    ("velocity_verlet", 2, 1, 0.3),
    ("ruth3", 3, 3, 0.2),
    ("forest_ruth", 4, 3, 3.0),
    ("suzuki4", 4, 5, 0.1),
    ("pefrl", 4, 4, 0.02),
    ("yoshida6", 6, 7, 2.0),
    ("yoshida8", 8, 15, 5.0),
    ("suzuki_umeno8", 8, 15, 0.5),
    ("composition10", 10, 35, 1.0),
    ("rk4", 4, 4, 0.5),
    ("cash_karp54", 5, 6, 0.3),
    ("dormand_prince5", 5, 6, 0.1),
    ("fehlberg78", 8, 13, 0.1),
    ("bulirsch_stoer", 8, 20, 0.05),
    ("gauss_legendre6", 6, 12, 0.01),
    ("gauss_legendre12", 12, 40, 1e-4),
    ("radau_iia_3", 5, 20, 0.05),
    ("radau_iia_7", 13, 60, 1e-4),
    ("rosenbrock4", 4, 6, 0.7),
)
KERNELS = (
    "hertz_normal linear_normal coulomb mindlin_tangential quaternion_step euler_equations "
    "sphere_sphere sphere_facet sphere_box ray_plane"
).split()


def line(subject, name, token, error, **changes):
    """One line of work_precision.jsonl."""
    found = {
        "what": "work_precision",
        "subject": subject,
        "name": name,
        "type": token,
        "failure": None,
        "evaluations": 10000,
        "final_error": None,
        "largest_error": error,
        "energy_error": None,
        "reference_error": None,
        "correct_digits": None if error is None else 7.0,
        "plan": PLAN,
    }
    return {**found, **changes}


def of_run(subject, name, token, integrator, steps, error, **changes):
    """The line of a problem or scene."""
    run = {"integrator": integrator, "end": "10", "steps": steps, "dt": 10 / steps}
    if subject == "scene":
        run["dt_text"] = f"10/{steps}"
    found = {"steps_taken": steps, "final_error": error, "regime": "time-stepping"}
    return {**line(subject, name, token, None), **run, **found, **changes}


def timed(error, seconds, **changes):
    """A line of a run with its time, as a report has them."""
    row = of_run("trajectory", "kepler", "double", "leapfrog", 10, error)
    return {**row, "seconds": seconds, **changes}


def failed(row, failure, why):
    """The line of a setting that failed: it has no error."""
    errors = dict.fromkeys(("final_error", "largest_error", "energy_error"))
    return {**row, **errors, "failure": failure, "why": why, "regime": "failed"}


def timing(row, seconds, **changes):
    """The line of work_precision_timing.jsonl of a setting."""
    told = "subject name type integrator end steps dt dt_text".split()
    found = {name: row[name] for name in told if name in row}
    found.update(what="work_precision_timing", key="/".join(map(str, found.values())))
    found.update(seconds=seconds, median_s=1.02 * seconds, spread_s=0.03 * seconds)
    found.update(repeats=2, samples_s=[seconds, 1.04 * seconds], on_front=False)
    return {**found, "noise_floor": 0.02, "plan": PLAN, **changes}


def subjects(kind, names, tokens):
    """(lines, their times) of functions or kernels."""
    rows, times = [], []
    for name in names:
        for token in tokens:
            unit = 2.0 ** -BITS[token]
            ulps = 0.5 + 3 * share(name, token) ** 6 * (300 if share(name) > 0.9 else 1)
            exact = name in ("fmod", "logb")
            rows.append(line(kind, name, token, 0.0 if exact else ulps * unit))
            cost = COSTS[token] * (0.3 + 6 * share(name, "cost") ** 2)
            times.append(timing(rows[-1], cost * 1e-8))
    return rows, times


def settings(
    name, tokens, integrators=INTEGRATORS, kind="trajectory", stable=0.2, chaos=1.0
):
    """(lines, their times) of a problem over ten time units: errors of the step down to the roundings of the type."""
    rows, times = [], []
    for token in tokens:
        unit = 2.0 ** -BITS[token]
        for integrator, order, evaluations, factor in integrators:
            for halving in range(12):
                steps = 20 * 2**halving
                dt = 10 / steps
                rounding = unit * math.sqrt(steps) * (0.5 + share(name, integrator))
                stepping = factor * dt**order * (0.5 + share(name, order))
                error = min(2.0, chaos * (stepping + rounding))
                counts = {"evaluations": steps * evaluations, "energy_error": error / 3}
                row = of_run(kind, name, token, integrator, steps, error, **counts)
                explicit = not integrator.startswith(("gauss", "radau", "rosenbrock"))
                if explicit and dt > stable * (1 + share(integrator)):
                    rows.append(failed(row, "diverged", "not finite at step 7"))
                    continue
                rows.append(row)
                cost = COSTS[token] * row["evaluations"] * _SECOND
                noise = 1 + 0.2 * share(token, integrator, halving)
                times.append(timing(row, cost * noise))
    return rows, times


def fit(name, integrator, token, **changes):
    """One line of work_precision_fits.jsonl."""
    found = {
        "what": "work_precision_fit",
        "subject": "trajectory",
        "name": name,
        "type": token,
        "integrator": integrator,
        "end": "10",
        "error": "energy_error",
        "constant": 0.31,
        "order": 2.003,
        "walk": 0.7,
        "drift": None,
        "residual": 0.04,
        "bad": False,
        "best_dt": 1e-6,
        "best_error": 1e-13,
        "crossing_dt": 2e-6,
        "plan": PLAN,
    }
    return {**found, **changes}


def fits_of(name, rows, kind="trajectory", error="energy_error", chaos=1.0):
    """The laws that `settings` makes its errors of, with the best of its steps."""
    orders = {row[0]: row[1] for row in INTEGRATORS}
    factors = {row[0]: row[3] for row in INTEGRATORS}
    curves = {}
    for row in rows:
        if row["name"] == name and not row["failure"]:
            curves.setdefault((row["integrator"], row["type"]), []).append(row)
    found = []
    for (integrator, token), mine in curves.items():
        best, order = min(mine, key=lambda row: row[error]), orders[integrator]
        part = (3 if error == "energy_error" else 1) / chaos
        law = {
            "constant": factors[integrator] * (0.5 + share(name, order)) / part,
            "order": order,
            "walk": (0.5 + share(name, integrator)) / part,
            "best_dt": best["dt"],
            "best_error": best[error],
        }
        found.append(
            fit(
                name,
                integrator,
                token,
                subject=kind,
                error=error,
                crossing_dt=None,
                **law,
            )
        )
    return found


def write(directory, rows, times=(), fits=()):
    """Write the files of a run; without times or fits, none of those."""
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    types = [{"token": row[0], "significand_bits": row[-1]} for row in TYPES]
    about = {**context(), "types": types}
    (directory / "context.json").write_text(json.dumps(about) + "\n", "utf-8")
    for name, lines in (("", rows), ("_timing", times), ("_fits", fits)):
        if lines:
            text = "".join(json.dumps(one) + "\n" for one in lines)
            (directory / f"work_precision{name}.jsonl").write_text(text, "utf-8")
    return directory


def everything(tokens=tuple(BITS)):
    """(lines, their times, fits) of all kinds, as much as a real run has."""
    found = [
        subjects("function", REAL, tokens),
        subjects("kernel", KERNELS, tokens),
        settings("kepler", tokens),
        settings("pendulum3", tokens, INTEGRATORS[:11], chaos=1e4),
        settings("robertson", tokens, INTEGRATORS[11:], stable=1e-3),
        settings("deposition", tokens, INTEGRATORS[1:2], "scene", 0.02, 50.0),
        settings("collision", tokens, INTEGRATORS[1:4], "scene", 0.05),
    ]
    rows = [row for lines, _ in found for row in lines]
    fits = fits_of("kepler", rows) + fits_of("pendulum3", rows, chaos=1e4)
    fits += fits_of("robertson", rows, error="final_error")
    fits += fits_of("deposition", rows, "scene", chaos=50.0)
    return rows, [one for _, times in found for one in times], fits


if __name__ == "__main__":
    write(sys.argv[1], *everything())
