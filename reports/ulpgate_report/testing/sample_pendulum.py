"""Makes a synthetic suite of the pendulum for the tests, without simulation; `python3 -m ulpgate_report.testing.sample_pendulum DIR`."""
import json
import math
import sys
from pathlib import Path

from ulpgate_report.testing.sample_records import PLAN, TYPES, share
from ulpgate_report.testing.sample_scenes import context, csv_text, scene_record
from ulpgate_report.values.time_step import seconds

SCENE = "pendulum3"
BITS = {row[0]: row[-1] for row in TYPES}
REFERENCE = "mpfr150"
END_S = 16.0
CHUNK_S = 0.05
LIMIT = 0.9
START_J = 2.1e-8
# The growth of an error by chaos, in bits a second, and how far the error of a step of 1 s would be at the start.
_BITS_PER_S = 22.0
_STEP_BITS = 2.0
# Integrator and order; the errors' factor comes from the name.
INTEGRATORS = (
    ("leapfrog", 2),
    ("velocity_verlet", 2),
    ("forest_ruth", 4),
    ("pefrl", 4),
    ("yoshida6", 6),
    ("yoshida8", 8),
    ("composition10", 10),
    ("gauss_legendre6", 6),
    ("cash_karp54", 5),
    ("fehlberg78", 8),
    ("bulirsch_stoer", 12),
)


def duration(token, dt):
    """(t_s, what limits it) that the synthetic curves have."""
    rounding = 0.5 + BITS[token] / _BITS_PER_S
    stepping = 1.0 - math.log2(dt) / _STEP_BITS
    end = min(rounding, stepping) if token != REFERENCE else END_S
    t_s = round(CHUNK_S * math.floor(min(end, END_S) / CHUNK_S), 10)
    if t_s >= END_S:
        return END_S, "the end of the run"
    return t_s, "rounding" if rounding <= stepping else "time-stepping"


def order_rows(errors, order=4, **changes):
    """Lines of orders.jsonl of halved steps: one of each of these errors."""
    found, before = [], None
    for halving, error in enumerate(errors):
        usable = all(isinstance(e, float) and e > 0 for e in (before, error))
        row = {
            "what": "order",
            "integrator": "rule",
            "order": order,
            "type": "double",
            "problem": "kepler",
            "dt": 0.5**halving,
            "steps": 2**halving,
            "error": error,
            "measured_order": math.log2(before / error) if usable else None,
        }
        found.append({**row, **changes})
        before = error
    return found


def correlation_record(token, dt="1e-5", variant="mass=yade", **changes):
    """One line of correlation.jsonl."""
    t_s, limit = duration(token, seconds(dt))
    found = {
        "what": "correlation",
        "scene": SCENE,
        "type": token,
        "against": REFERENCE,
        "integrator": "leapfrog",
        "dt": dt,
        "variant": variant,
        "t_s": t_s,
        "to_the_end": limit == "the end of the run",
        "limited_by": limit,
        "plan": PLAN,
    }
    return {**found, **changes}


def reference_records(dt, variant):
    """The two lines that judge the reference itself."""
    stepping = round(
        CHUNK_S * math.floor((1.0 - math.log2(seconds(dt)) / 2) / 0.05), 10
    )
    own = {"against": "RealHP4", "limited_by": "rounding", "to_the_end": True}
    half = {"against": "half_step", "limited_by": "time-stepping", "t_s": stepping}
    return [
        correlation_record(REFERENCE, dt, variant, **{**own, "t_s": END_S}),
        correlation_record(REFERENCE, dt, variant, **{**half, "to_the_end": False}),
    ]


def curve(row):
    """The text of a correlation/*.csv whose first chunk below the limit is at t_s."""
    rows = []
    for chunk in range(int(END_S / CHUNK_S)):
        time = round(chunk * CHUNK_S, 10)
        apart = time >= row["t_s"] and not row["to_the_end"]
        noise = share(row["type"], row["against"], row["dt"], chunk)
        first = apart and time < row["t_s"] + CHUNK_S
        value = (0.4 if first else 2 * noise - 1) if apart else 1 - 1e-3 * noise
        rows.append((time, value))
    return csv_text("time_s,correlation", rows)


def angle(time, token, damping=0.0):
    """The first angle in rad: a swing that dies away, another one after the type has parted."""
    parted = 0.5 + BITS[token] / _BITS_PER_S
    late = max(0.0, time - parted)
    phase = 9.0 * time + 2 * math.sin(2.3 * time) + share(token) * 4 * late
    swing = math.cos(phase) * math.exp(-damping * 40 * time)
    return abs(math.pi - 2.2 * abs(swing))


SERIES = (
    "step,time_s,kinetic_half_step_J,translational_on_step,rotational_on_step,elastic,potential,friction,damping,viscous,broken,work,sum,"
    "mean_x_m,mean_y_m,mean_z_m,angle_1_rad,angle_2_rad,angle_product,energy_error_J,raw_energy_error_J"
)


def series(token, dt=1e-5, damping=0.0, end=END_S, every=1e-2):
    """A series of a chain: the step before the first record has no account, as in a real one."""
    rows = []
    stride = round(every / dt)
    for step in (0, 1, *range(stride, round(end / dt) + 1, stride)):
        time = step * dt
        first = angle(time, token, damping)
        second = angle(time + 0.1, token, damping)
        spread = math.cos(8 * time) ** 2
        kinetic, potential = 8e-8 * (1 - spread), 8e-8 * spread - 8e-8 + START_J
        elastic = 1e-12 * spread
        noise = (1 + time) ** 0.5 * (0.2 + share(token, step))
        error = START_J * (2.0 ** -BITS[token] * 1e3 * noise + 1e4 * dt**2 * spread)
        raw = error + START_J * 30 * dt * spread
        parts = (kinetic, 0, elastic, potential - elastic, 0, 0, 0, 0, 0)
        total = START_J + error
        if step == 0:
            parts, total, error, raw, kinetic = (0,) * 9, 0, 0, 0, 0
        row = (step, time, kinetic, *parts, total, 0.01, -0.02, 0, first, second)
        rows.append((*row, first * second, error, raw))
    return csv_text(SERIES, rows)


def snapshot(token, time):
    """The four nodes at one instant."""
    x, y, rows = 0.0, 0.0, []
    late = max(0.0, time - 0.5 - BITS[token] / _BITS_PER_S)
    for node in range(4):
        rows.append((str(node), "sphere", x, y, 0.0, 0.001, 1e-9 * node, time))
        turn = 0.35 - 9 * time - node * math.sin(3 * time) + share(token) * late
        x, y = x + 0.025 * math.cos(turn), y + 0.025 * math.sin(turn)
    return csv_text("body,shape,x_m,y_m,z_m,radius_m,kinetic_J,time_s", rows)


def record(token, dt, variant="mass=yade", **changes):
    """One line of scenes.jsonl with the fields of a chain."""
    rounding = START_J * 2.0 ** (12 - BITS[token])
    averaged = rounding + START_J * 1e4 * seconds(dt) ** 2
    found = {
        "dt": dt,
        "variant": variant,
        "steps": round(END_S / seconds(dt)),
        "t_end": END_S,
        "bodies": 4,
        "contacts": 3,
        "energy_start": START_J,
        "max_energy_error": averaged,
        "max_energy_error_raw": averaged + START_J * 30 * seconds(dt),
        "energy_slope": 0.5 + 0.1 * share(token, dt),
        "energy_slope_raw": None,
    }
    return scene_record(token, SCENE, **{**found, **changes})


def order_records(tokens=("double", "float128", "mpfr62"), problem="kepler", steps=18):
    """Lines of orders.jsonl: each error falls by its order down to the roundings of the type."""
    found = []
    for token in tokens:
        for name, order in INTEGRATORS:
            before = None
            for halving in range(steps):
                dt = 0.25 / 2**halving
                ideal = (0.2 + share(name)) * dt**order
                floor = 2.0 ** (3 - BITS[token]) * (0.5 + share(name, halving))
                error = ideal + floor * 2 ** (halving / 2)
                measured = None if before is None else math.log2(before / error)
                found.append(
                    {
                        "what": "order",
                        "integrator": name,
                        "order": order,
                        "type": token,
                        "problem": problem,
                        "dt": dt,
                        "steps": 100 * 2**halving,
                        "error": error,
                        "measured_order": measured,
                    }
                )
                before = error
    return found


def drift_records(tokens=("double", "mpfr62"), problem="kepler"):
    """Lines of drift.jsonl: the error of the step, and no drift."""
    return [
        {
            "what": "drift",
            "integrator": name,
            "type": token,
            "problem": problem,
            "dt": 0.015625,
            "t_end": 512,
            "max_energy_error": max(0.015625**order, 2.0 ** (1 - BITS[token])),
            "energy_slope": None if token == "double" else 0.0,
        }
        for token in tokens
        for name, order in INTEGRATORS
    ]


def _context():
    fields = "token cpp_type total_bits decimal_places exponent_bits significand_bits"
    entries = [dict(zip(fields.split(), row)) for row in TYPES]
    return {**context(), "threads": 1, "complete": True, "types": entries}


def _write_lines(path, rows):
    path.write_text("".join(json.dumps(row) + "\n" for row in rows), "utf-8")


def _start(directory):
    for folder in ("series", "snapshots", "correlation"):
        (directory / folder).mkdir(parents=True, exist_ok=True)
    (directory / "context.json").write_text(json.dumps(_context()) + "\n", "utf-8")


def write_run(directory, dt, tokens, end=END_S, every=1e-2, variant="mass=yade"):
    """One run of the suite: correlation, records, series, snapshots at four instants of every type."""
    _start(directory)
    rows = reference_records(dt, variant) if REFERENCE in tokens else []
    rows += [correlation_record(t, dt, variant) for t in tokens if t != REFERENCE]
    _write_lines(directory / "correlation.jsonl", rows)
    for row in rows:
        name = f"{SCENE}_{row['type']}_{row['against']}.csv"
        (directory / "correlation" / name).write_text(curve(row))
    _write_lines(directory / "scenes.jsonl", [record(t, dt, variant) for t in tokens])
    for token in tokens:
        path = directory / "series" / f"{SCENE}_{token}.csv"
        path.write_text(series(token, seconds(dt), 0.0, end, every))
        for time in (0, 0.1, 0.25, 2.5):
            name = f"{SCENE}_{token}_{round(time / seconds(dt))}.csv"
            (directory / "snapshots" / name).write_text(snapshot(token, time))
    return directory


def write_damped(directory, tokens, end=END_S, every=1e-2):
    """The damped run: angles and no correlation."""
    _start(directory)
    variant = "mass=yade,damping=5e-3"
    _write_lines(
        directory / "scenes.jsonl", [record(t, "1e-5", variant) for t in tokens]
    )
    for token in tokens:
        path = directory / "series" / f"{SCENE}_{token}.csv"
        path.write_text(series(token, 1e-5, 5e-3, end, every))
    return directory


def write_orders(directory, **options):
    """The run of the integrators."""
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "context.json").write_text(json.dumps(_context()) + "\n", "utf-8")
    _write_lines(directory / "orders.jsonl", order_records(**options))
    return directory


def write_drift(directory, **options):
    """The run of the integrators' energies."""
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "context.json").write_text(json.dumps(_context()) + "\n", "utf-8")
    _write_lines(directory / "drift.jsonl", drift_records(**options))
    return directory


def write_suite(directory, tokens=tuple(BITS), steps=("1e-5", "1e-6"), **options):
    """The whole suite, as scripts/pendulum writes it."""
    directory = Path(directory)
    for dt in steps:
        write_run(directory / f"dt_{dt}", dt, tokens, **options)
    write_damped(directory / "damped", tokens, **options)
    write_orders(directory / "orders")
    write_drift(directory / "drift_mpfr62", tokens=("mpfr62",))
    return directory


if __name__ == "__main__":
    write_suite(sys.argv[1], steps=("1e-5", "1e-6", "1e-7", "1e-8"))
