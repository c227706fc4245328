"""The tables of a run of scenes as plain data."""
import math

from ulpgate_report.scenes import benchmark
from ulpgate_report.tables.table import Column, Table, columns_of
from ulpgate_report.values import numbers

_SCENE = Column("scene", "scene", "code")
_TYPE = Column("type", "type", "code")


def _field(record, name):
    return numbers.signed(record.get(name))


def _energy_error(record):
    """None where no account was kept: a record has 0 there."""
    found = _field(record, "max_energy_error")
    return found if found != 0 or record.get("energy") else None


def scene_table(scenes):
    """What was run and where it ended."""
    rows = []
    for record in scenes.records:
        mean = record.get("mean_position") or (None, None, None)
        rows.append(
            (
                record["scene"],
                record["type"],
                record.get("variant") or None,
                record["integrator"],
                str(record["dt"]),
                record["steps"],
                _field(record, "t_end"),
                record["bodies"],
                record.get("contacts"),
                _field(record, "kinetic_energy_half_step_J"),
                *map(numbers.signed, mean),
                _energy_error(record),
            )
        )
    columns = (
        _SCENE,
        _TYPE,
        Column("variant", "variant", "text"),
        Column("integrator", "integrator", "code"),
        Column("dt_s", "dt (s)", "text"),
        Column("steps", "steps", "count"),
        Column("t_end_s", "end (s)", "real"),
        *columns_of("count", bodies="bodies", contacts="contacts"),
        *columns_of(
            "real",
            kinetic_half_step_J="kinetic, half step (J)",
            mean_x_m="mean x (m)",
            mean_y_m="mean y (m)",
            mean_z_m="mean z (m)",
            max_energy_error_J="energy error (J)",
        ),
    )
    caption = "Scenes at their end: kinetic energy of the velocities half a step before, and mean position of the bodies"
    if any(row[-1] is not None for row in rows):
        caption += (
            "; the largest distance of the energy account from its value at the start (- where no "
            "account was kept)"
        )
    return Table("scene_table", caption + ".", columns, tuple(rows))


def scene_states(scenes):
    """What identifies a result: its hash, and what was left out on the way."""
    rows = []
    for record in scenes.records:
        left_out = record.get("parts_left_out") or ()
        rows.append(
            (
                record["scene"],
                record["type"],
                record.get("variant") or None,
                record.get("state_hash"),
                record["plan"],
                "; ".join(f"{entry['part']}: {entry['why']}" for entry in left_out),
            )
        )
    columns = (
        _SCENE,
        _TYPE,
        Column("variant", "variant", "text"),
        *columns_of("code", state_hash="state hash", plan="plan"),
        Column("left_out", "left out, and why", "prose"),
    )
    caption = "Hash of the last state, to compare bit for bit, and the parts of a step that the scene did not need."
    return Table("scene_states", caption, columns, tuple(rows))


def energy_table(scenes):
    """The energy account at the end."""
    kept = [record for record in scenes.records if record.get("energy")]
    names = list(dict.fromkeys(name for r in kept for name in r["energy"]))
    # The sum is what the parts are for: last, whatever the order in the file.
    names.sort(key=lambda name: name == "sum")
    rows = [
        (
            record["scene"],
            record["type"],
            *(numbers.signed(record["energy"].get(name)) for name in names),
            _field(record, "energy_start"),
            _field(record, "max_energy_error"),
        )
        for record in kept
    ]
    columns = (
        _SCENE,
        _TYPE,
        *(Column(f"{name}_J", f"{name} (J)", "real") for name in names),
        Column("energy_start_J", "sum at start (J)", "real"),
        Column("max_energy_error_J", "largest error (J)", "real"),
    )
    caption = "The energy account at the end of each scene, and how far its sum ever was from the start."
    return Table("energy_table", caption, columns, tuple(rows))


def divergence_table(scenes):
    """How far a type is from the reference at the end."""
    rows = []
    for scene in scenes.names:
        for token, columns in scenes.of(scenes.divergences, scene):
            if columns["step"]:
                rows.append(
                    (
                        scene,
                        token,
                        int(columns["step"][-1]),
                        columns["max_position_error_m"][-1],
                        columns["max_position_ulp"][-1],
                        _first_step_with_other_contacts(columns),
                    )
                )
    columns = (
        _SCENE,
        _TYPE,
        Column("step", "last step", "count"),
        *columns_of(
            "real",
            max_position_error_m="position error (m)",
            max_position_ulp="position error (ULP)",
        ),
        Column("other_contacts_step", "other contacts from step", "count"),
    )
    caption = (
        "RealHP<1> against RealHP<4> from one state: the largest error of a position at the last step recorded, and the "
        "first recorded step at which the two do not have the same contacts."
    )
    return Table("divergence_table", caption, columns, tuple(rows))


def _first_step_with_other_contacts(columns):
    names = ("contacts_only_here", "contacts_only_in_reference")
    if any(name not in columns for name in names):
        return None
    for step, here, there in zip(columns["step"], *(columns[n] for n in names)):
        if here or there:
            return int(step)
    return None


def benchmark_table(scenes):
    """How fast the scenes run, and how much slower than in double."""
    rows = []
    for bar in benchmark.bars(scenes):
        timing = bar.timing
        rows.append(
            (
                timing["scene"],
                timing["type"],
                timing["threads"],
                timing["steps"],
                f"{timing['kept']} of {timing['repeats']}",
                timing["iterations_per_s"],
                timing["deviation"],
                timing.get("memory_bytes"),
                bar.slowdown,
                bar.slowdown_deviation
                if math.isfinite(bar.slowdown_deviation)
                else None,
                bar.paper_slowdown,
            )
        )
    columns = (
        _SCENE,
        _TYPE,
        *columns_of("count", threads="threads", steps="steps"),
        Column("kept", "repeats kept", "text"),
        *columns_of("rough", iterations_per_s="iterations/s", deviation="deviation"),
        Column("memory_bytes", "memory (bytes)", "count"),
        *columns_of(
            "rough",
            slowdown="slowdown",
            slowdown_deviation="its deviation",
            paper_slowdown="published",
        ),
    )
    caption = (
        "Iterations per second: mean and standard deviation of the repeats within two standard deviations; slowdown "
        "against double on as many threads, beside the published one (16 threads)."
    )
    return Table("benchmark_table", caption, columns, tuple(rows))
