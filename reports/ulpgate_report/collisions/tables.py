"""The tables of the collisions as plain data."""
import math
import shlex

from ulpgate_report.tables.table import Column, Table, columns_of
from ulpgate_report.values import numbers

_RUN = columns_of("code", scene="scene", type="type")
_STEP = columns_of("text", dt="step (s)", variant="variant")
# Of those beyond their condition so many of a run are tabled: one mistake makes thousands.
MOST_FINDINGS = 20
_LISTED = "Quantiles are of the collisions that are listed and ended, at most the first 20 000 of a run."


def quantile(values, share):
    """The smallest of some values that at least this share of them does not exceed; None of none."""
    found = sorted(values)
    return found[max(0, math.ceil(share * len(found)) - 1)] if found else None


def _finite(run, name):
    values = (getattr(one, name) for one in run.ended)
    return [value for value in values if value is not None and math.isfinite(value)]


def place_text(place):
    """Which collision: `3-7 from step 40`; None of none."""
    return f"{place[0]}-{place[1]} from step {place[2]}" if place else None


def command(run):
    """What runs this scene again with its ledger."""
    told = run.totals
    words = ["ulpgate scene run", shlex.quote(told["scene"]), "--types", run.type]
    words += ["--dt", shlex.quote(run.dt)]
    if run.steps is not None:
        words += ["--steps", str(run.steps)]
    if run.integrator != "leapfrog":
        words += ["--integrator", run.integrator]
    for change in filter(None, run.variant.split(",")):
        words += ["--set", shlex.quote(change)]
    return " ".join([*words, "--collisions --out DIR"])


def _about(run):
    return (run.scene, run.type, run.dt, run.variant or None)


def collision_table(collisions):
    """How bodies met and parted."""
    rows = []
    for run in collisions.runs:
        restitutions = _finite(run, "restitution")
        steps = [one.steps for one in run.ended]
        rows.append(
            (
                *_about(run),
                *(run.totals[name] for name in ("ended", "still_open", "rows")),
                *(quantile(restitutions, share) for share in (0.05, 0.5, 0.95)),
                numbers.signed(run.totals["mean_restitution"]),
                quantile(_finite(run, "duration_s"), 0.5),
                run.totals["shortest_steps"] if run.totals["ended"] else None,
                quantile(steps, 0.5),
                numbers.signed(run.totals["largest_omega_dt"]),
            )
        )
    told = columns_of("count", ended="ended", still_open="open", listed="listed")
    told += columns_of(
        "real",
        restitution_5="restitution, 5 %",
        restitution_50="median",
        restitution_95="95 %",
        restitution_mean="mean",
        duration_s="duration, median (s)",
    )
    told += columns_of("count", fewest_steps="fewest steps", median_steps="median")
    told += columns_of("real", omega_dt="largest omega dt")
    caption = (
        "Collisions: how many ended or were left open, restitution (velocity of parting over that of approach), how long and "
        "how many steps bodies were inside each other, and the largest omega dt, of which a contact is stable below 2. "
        + _LISTED
    )
    return Table("collision_table", caption, (*_RUN, *_STEP, *told), tuple(rows))


def _part_of(run, place):
    """Gained energy over bound of a listed collision; None where it is not listed."""
    found = run.at(place)
    return found and found.part_of_bound


def collision_energy(collisions):
    """What contacts made of energy, against what they may."""
    rows = []
    for run in collisions.runs:
        told = run.totals
        has_ended = told["ended"] > 0
        created, nearest = told["largest_created_at"], told["largest_part_of_bound_at"]
        rows.append(
            (
                *_about(run),
                told["creating"],
                numbers.signed(told["largest_created"]) if has_ended else None,
                _part_of(run, created),
                place_text(created),
                numbers.signed(told["largest_part_of_bound"]) if has_ended else None,
                place_text(nearest),
                told["beyond"],
                command(run),
            )
        )
    told = columns_of("count", creating="made energy")
    told += columns_of(
        "real", largest_created="largest, of the pair's", created_part="of its bound"
    )
    told += columns_of("text", created_at="bodies")
    told += columns_of("real", largest_part="nearest to the bound")
    told += columns_of("text", nearest_at="bodies of it")
    told += columns_of("count", beyond="beyond")
    told += columns_of("command", command="command")
    caption = (
        "Energy that contacts made: in how many collisions, the most of it as a part of the energy of the pair and of what its "
        "condition allows (rounding, time step and law together), and the collision that comes nearest to its bound or "
        "exceeds it; beyond: collisions that made more than their bound."
    )
    return Table("collision_energy", caption, (*_RUN, *_STEP, *told), tuple(rows))


def collision_findings(collisions):
    """The collisions that made more energy than their condition allows, of each run the worst first."""
    rows = []
    for run in collisions.runs:
        found = [one for one in run.ended if one.beyond]
        found.sort(key=lambda one: -one.part_of_bound)
        rows += [
            (
                *_about(run),
                place_text(one.place),
                one.steps,
                one.speed,
                one.restitution,
                one.gained_J,
                one.bound_J,
                one.part_of_bound,
                command(run),
            )
            for one in found[:MOST_FINDINGS]
        ]
    told = columns_of("text", bodies="bodies") + columns_of(
        "count", steps="steps inside"
    )
    told += columns_of(
        "real",
        speed="approach (m/s)",
        restitution="restitution",
        gained_J="gained (J)",
        bound_J="bound (J)",
        part="gained / bound",
    )
    told += columns_of("command", command="command")
    caption = (
        "Collisions beyond their condition: the contact made more energy than rounding, time step and law together may; of "
        f"each run at most {MOST_FINDINGS}, the worst first."
    )
    return Table("collision_findings", caption, (*_RUN, *_STEP, *told), tuple(rows))


def groups(collisions):
    """{(scene, integrator, step, variant): {type: run}}: what differs in its type alone."""
    found = {}
    for run in collisions.runs:
        key = (run.scene, run.integrator, run.dt, run.variant)
        found.setdefault(key, {})[run.type] = run
    return found


def labels(collisions):
    """{key of a group: what it is called}: the scene, and where it was run in several ways, how."""
    found = {}
    keys = list(groups(collisions))
    for key in keys:
        scene, integrator, dt, variant = key
        is_alone = sum(other[0] == scene for other in keys) == 1
        how = [scene] if is_alone else [scene, integrator, f"dt={dt}", variant]
        found[key] = " ".join(filter(None, how))
    return found


def collision_matrix(collisions):
    """Of each scene and type the largest part of its bound that a collision gained, for the page."""
    names, tokens = labels(collisions), collisions.type_tokens
    rows = []
    for key, of_type in groups(collisions).items():
        runs = (of_type.get(token) for token in tokens)
        rows.append((names[key], *(run and part_of_run(run) for run in runs)))
    told = (Column("scene", "scene", "code"),)
    told += tuple(Column(token, token, "ulp") for token in tokens)
    caption = (
        "Energy that a contact made over what its condition allows, the largest of a run: 0 where none was made, above 1 "
        "beyond it. A cell leads to the run and the command that repeats it."
    )
    return Table("collision_matrix", caption, told, tuple(rows))


def part_of_run(run):
    """The largest part of its bound that a collision of a run gained; None where none ended."""
    part = numbers.signed(run.totals["largest_part_of_bound"])
    return part if run.totals["ended"] else None
