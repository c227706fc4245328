"""Makes synthetic lines of collisions.jsonl for the tests; `python3 -m ulpgate_report.testing.sample_collisions DIR`."""
import json
import sys
from pathlib import Path

from ulpgate_report.testing.sample_records import PLAN, share
from ulpgate_report.testing.sample_scenes import BITS, context, scene_record

# Of a visco-elastic contact that lasts eleven steps.
RESTITUTION, DURATION, DT = 0.2, 1.05e-3, 1e-4


def _run(scene, token, **changes):
    found = {"scene": scene, "type": token, "integrator": "leapfrog", "dt": "1e-4"}
    return {**found, "variant": "", "plan": PLAN, **changes}


def collision(scene, token, number, **changes):
    """One collision: bodies that meet at 1 mm/s to 10 m/s; a quarter of them makes some energy."""
    speed = 10.0 ** (-3 + 4 * share(scene, number, "speed"))
    before = 0.5 * speed**2
    rounding = 16 * 2.0 ** -BITS[token] * 40 * before
    step = before * 10.0 ** (-9 + 8 * share(scene, number, "step"))
    bound = rounding + step
    part = share(scene, number, "part") ** 3
    gained = bound * part if share(scene, number) < 0.25 else -0.9 * before
    restitution = RESTITUTION * (1 + 0.1 * (share(scene, number, "e") - 0.5))
    inside = 9 + int(4 * share(scene, number, "steps"))
    begin = 40 * number
    found = {
        "what": "collision",
        **_run(scene, token),
        "first": number % 7,
        "second": 7 + number % 11,
        "open": False,
        "begin_step": begin,
        "end_step": begin + inside,
        "steps_inside": inside,
        "begin_s": (begin - 0.4) * DT,
        "end_s": (begin - 0.4) * DT + DURATION,
        "duration_s": DURATION * (1 + 0.02 * share(scene, number, "duration")),
        "normal_velocity_before": -speed,
        "normal_velocity_after": restitution * speed,
        "restitution": restitution,
        "largest_overlap_m": speed * DURATION / 3,
        "energy_before_J": before,
        "energy_after_J": restitution**2 * before,
        "energy_gained_J": gained,
        "energy_created": max(gained, 0.0) / before,
        "omega_dt": 0.3,
        "condition": 40.0,
        "rounding_bound_J": rounding,
        "step_bound_J": step,
        "law_bound_J": 0.0,
        "beyond_condition": False,
    }
    return {**found, **changes}


def left_open(scene, token, number, **changes):
    """A collision that the end of the run left open: what is of its end is null."""
    ends = (
        "end_s duration_s normal_velocity_after restitution energy_after_J energy_gained_J energy_created condition "
        "rounding_bound_J step_bound_J law_bound_J"
    ).split()
    return {
        **collision(scene, token, number),
        "open": True,
        **dict.fromkeys(ends),
        **changes,
    }


def part_of_bound(row):
    """What a collision gained as a part of what it may."""
    bounds = (row[f"{name}_bound_J"] for name in ("rounding", "step", "law"))
    return max(0.0, row["energy_gained_J"]) / sum(bounds)


def _place(row):
    return [row["first"], row["second"], row["begin_step"]]


def ledger(rows, **changes):
    """The totals of some collisions of a run."""
    ended = [row for row in rows if not row["open"]]
    created = max(ended, key=lambda row: row["energy_created"], default=None)
    nearest = max(ended, key=part_of_bound, default=None)
    largest = created["energy_created"] if created else 0
    part = part_of_bound(nearest) if nearest else 0
    restitutions = [r["restitution"] for r in ended if r["restitution"] is not None]
    mean = sum(restitutions) / len(restitutions) if restitutions else None
    first = rows[0]
    names = ("scene", "type", "integrator", "dt", "variant", "plan")
    found = {
        "what": "ledger",
        **{name: first[name] for name in names},
        "rows": len(rows),
        "ended": len(ended),
        "still_open": len(rows) - len(ended),
        "creating": sum(row["energy_gained_J"] > 0 for row in ended),
        "beyond": sum(row["beyond_condition"] for row in ended),
        "largest_created": largest,
        "largest_created_at": _place(created) if largest else None,
        "largest_part_of_bound": part,
        "largest_part_of_bound_at": _place(nearest) if part else None,
        "mean_restitution": mean,
        "shortest_steps": min((row["steps_inside"] for row in ended), default=0),
        "largest_omega_dt": max(row["omega_dt"] for row in rows),
    }
    return {**found, **changes}


def of_run(scene, token, count, **changes):
    """The lines of a run: `count` collisions that ended, two that did not, and the totals."""
    rows = [collision(scene, token, number, **changes) for number in range(count)]
    rows += [left_open(scene, token, count + n, **changes) for n in range(2)]
    return [*rows, ledger(rows)]


def write(directory, lines, scenes=("packing",)):
    """Write the files of a run with the records of its scenes."""
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    runs = {(row["scene"], row["type"]): None for row in lines}
    records = [
        scene_record(token, scene, dt="1e-4")
        for scene, token in runs
        if scene in scenes
    ]
    files = {
        "context.json": [context()],
        "scenes.jsonl": records,
        "collisions.jsonl": lines,
    }
    for name, objects in files.items():
        text = "".join(json.dumps(one) + "\n" for one in objects)
        (directory / name).write_text(text, "utf-8")
    return directory


if __name__ == "__main__":
    everything = [row for token in BITS for row in of_run("packing", token, 2000)]
    write(sys.argv[1], everything)
