"""Makes synthetic scenes for the tests: deterministic, no simulation; `python3 -m ulpgate_report.testing.sample_scenes DIR`."""
import decimal
import json
import math
import sys
from pathlib import Path

from ulpgate_report.testing.sample_records import PLAN, TYPES, share

BITS = {row[0]: row[-1] for row in TYPES}
SLOWDOWN = (0.97, 1.0, 1.6, 5.5, 14.0, 20.5, 26.0)
ENERGIES = "rotational_on_step elastic potential friction damping viscous".split()
DT = 1e-4
STEPS = 7001


def context():
    """A context.json of scenes: no seed, no strata, no list of types."""
    return {
        "tool": {"name": "ulpgate", "version": "0.1.0"},
        "compiler": "g++ 12.2.0",
        "flags": "-O2 -ffp-contract=off",
        "libraries": {"boost": "1.81"},
        "cpu": "synthetic",
        "plan": PLAN,
    }


def account(time, token):
    """(kinetic, parts) of the energy at a time, exact decimals; their sum drifts by roundings of the type."""
    with decimal.localcontext(decimal.Context(prec=400)):
        exact = decimal.Decimal
        fallen = min(exact(1), exact(time) / exact("0.7"))
        kinetic = 4 * fallen * (1 - fallen) + exact("0.01")
        parts = [kinetic / 10, fallen / 2, 5 * (1 - fallen), 3 * fallen, exact(0)]
        noise = (1 + 40 * time) * (1 + share(time, token))
        drift = exact(noise) * exact(2) ** (1 - BITS[token])
        return kinetic, [*parts, exact("5.01") - kinetic - sum(parts) + drift]


def scene_record(token, scene="deposition", **changes):
    """One line of scenes.jsonl."""
    kinetic, parts = account(STEPS * DT, token)
    kinetic, parts = float(kinetic), list(map(float, parts))
    energy = {"translational_on_step": kinetic, **dict(zip(ENERGIES, parts))}
    found = {
        "scene": scene,
        "type": token,
        "integrator": "leapfrog",
        "dt": "1e-4",
        "variant": "",
        "steps": STEPS,
        "t_end": STEPS * DT,
        "bodies": 10021,
        "contacts": 9892,
        "parts_left_out": [{"part": "damping", "why": "it is 0"}],
        "kinetic_energy_half_step_J": kinetic,
        "mean_position": [-1.5e-4, -0.345608, 2.5e-4],
        "energy": {**energy, "sum": sum(energy.values())},
        "energy_start": 5.01,
        "max_energy_error": 2.0 ** (6 - BITS[token]),
        "state_hash": f"{int(share(token, scene) * 2**48):016x}",
        "plan": PLAN,
    }
    return {**found, **changes}


def timing_record(token, threads=1, scene="deposition"):
    """One line of timing.jsonl."""
    slower = SLOWDOWN[list(BITS).index(token)]
    speed = 250.0 * threads**0.9 / slower
    return {
        "what": "scene",
        "scene": scene,
        "type": token,
        "threads": threads,
        "steps": 500,
        "repeats": 10,
        "kept": 9,
        "iterations_per_s": speed,
        "deviation": 0.02 * speed,
        "memory_bytes": 1234567,
        "slowdown_against_double": slower,
    }


def csv_text(header, rows):
    lines = [header, *(",".join(map(repr_of, row)) for row in rows)]
    return "\n".join(lines) + "\n"


def repr_of(value):
    """A field of a CSV file."""
    return repr(value) if isinstance(value, (int, float)) else str(value)


def series(token, every=50):
    """The energy of a scene against time."""
    names = [f"{name}_J" for name in ENERGIES]
    header = ["step", "time_s", "kinetic_half_step_J", "translational_on_step_J"]
    header += [*names, "mean_x_m", "mean_y_m", "mean_z_m"]
    rows = []
    for step in range(0, STEPS, every):
        kinetic, parts = account(step * DT, token)
        mean = (-1.5e-4, -0.5 * step / STEPS, 2.5e-4)
        rows.append((step, step * DT, kinetic, kinetic, *parts, *mean))
    return csv_text(",".join(header), rows)


def divergence(token):
    """How a type leaves its reference: slowly, then as chaos does, until the bodies are as far as the box is wide."""
    header = (
        "step,time_s,max_position_error_m,max_position_ulp,max_velocity_error_m_per_s,"
        "max_velocity_ulp,energy_error_J,contacts_only_here,contacts_only_in_reference"
    )
    rows, step = [], 0
    while step < STEPS:
        grown = step**1.5 * math.exp(min(60.0, step / 200))
        ulp = 0.3 * grown * (1 + share(step, token))
        error = min(0.5, ulp * 2.0 ** -BITS[token])
        ulp = error * 2.0 ** BITS[token]
        apart = int(error > 1e-4)
        rows.append(
            (step, step * DT, error, ulp, 10 * error, 10 * ulp, error, apart, apart)
        )
        step += max(1, step // 8)
    return csv_text(header, rows)


def snapshot(step, bodies=200):
    """Spheres that settle, one facet first."""
    rows = [("0", "facet", 0.0, 0.0, 0.0, 0.0, 0.0, step * DT)]
    radius = 0.4 / bodies ** (1 / 3)
    for body in range(bodies):
        x, y, z = (share(axis, body) - 0.5 for axis in "xyz")
        y = max(-0.5, y - 0.6 * step / STEPS)
        energy = 10.0 ** (-6 * share("k", body, step)) * (step > 0)
        rows.append((str(body + 1), "sphere", x, y, z, radius, energy, step * DT))
    return csv_text("body,shape,x_m,y_m,z_m,radius_m,kinetic_J,time_s", rows)


def short_columns(**values):
    """The columns of a series of three instants."""
    found = {"step": [0, 1, 2], "time_s": [0.0, 0.1, 0.2]}
    for name, numbers in values.items():
        found[name] = [decimal.Decimal(str(number)) for number in numbers]
    return found


def write_sample(directory, tokens=tuple(BITS), bodies=200):
    """A whole run: records, times on 1 and 4 threads, series, divergences, five snapshots of one type."""
    directory = Path(directory)
    for folder in ("series", "snapshots"):
        (directory / folder).mkdir(parents=True, exist_ok=True)
    lines = {
        "context.json": [context()],
        "scenes.jsonl": [scene_record(token) for token in tokens],
        "timing.jsonl": [timing_record(t, n) for n in (1, 4) for t in tokens],
    }
    for name, objects in lines.items():
        text = "".join(json.dumps(one) + "\n" for one in objects)
        (directory / name).write_text(text, "utf-8")
    for token in tokens:
        base = directory / "series"
        (base / f"deposition_{token}.csv").write_text(series(token))
        (base / f"divergence_deposition_{token}.csv").write_text(divergence(token))
    for step in (0, 1000, 3000, 5000, 7000):
        name = f"deposition_double_{step}.csv"
        (directory / "snapshots" / name).write_text(snapshot(step, bodies))
    return directory


if __name__ == "__main__":
    write_sample(sys.argv[1])
