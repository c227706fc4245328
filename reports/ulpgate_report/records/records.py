"""Loads what a run directory holds: the context, and whichever of math, kernels, scenes and pendulums were run."""
from dataclasses import dataclass
from pathlib import Path

from ulpgate_report.records import (
    checksums,
    collision_records,
    pendulum_records,
    reading,
    scene_records,
    stress_records,
    work_precision_records,
)
from ulpgate_report.records.errors import Incomplete, InvalidInput, NothingMeasured


@dataclass(frozen=True)
class Run:
    """One run as read; what was not run is empty. `time_ns` has the time of (what, type).

    `notes` are sentences about what was left out. `axes` are the pairs of axes that error against run time is drawn
    with, as they were asked for; empty for those of the report. `gate` is what `ulpgate gate --json` found, `before` an
    earlier run.
    """

    context: dict
    math: list
    time_ns: dict
    kernels: tuple = ()
    scenes: object = None
    pendulum: object = None
    notes: tuple = ()
    stress: object = None
    work_precision: object = None
    collisions: object = None
    axes: tuple = ()
    history: object = None
    libraries: object = None
    gate: object = None
    before: object = None


def _require(context, name, file):
    if name not in context:
        raise InvalidInput(f"context.json: record: '{name}' is needed by {file}")


def _check_against_context(record, where, context, parts_of, seen, listed):
    function, part = record["function"], record["part"]
    type_tokens = {entry["token"] for entry in context["types"]}
    if part not in parts_of.get(function, ()):
        raise InvalidInput(f"{where}: {function} {part}: not among context's {listed}")
    if record["type"] not in type_tokens:
        raise InvalidInput(f"{where}: {record['type']}: not among context's types")
    if record["stratum"] not in context["strata"]:
        raise InvalidInput(f"{where}: {record['stratum']}: not among context's strata")
    if record["plan"] != context["plan"]:
        raise InvalidInput(
            f"{where}: plan {record['plan']} is not the plan {context['plan']} of context.json"
        )
    key = (function, part, record["type"], record["stratum"])
    if key in seen:
        raise InvalidInput(
            f"{where}: {' '.join(key)}: second record; first {seen[key]}"
        )
    seen[key] = where


def _check_counts(record, where):
    """Counts that no measurement can have led to."""
    judged, histogram = record["judged"], record["histogram"]
    errors = histogram["exact"] + sum(n for _, n in histogram["buckets"])
    for wrong, why in (
        (record["samples"] > record.get("planned", record["samples"]), "planned"),
        (judged + sum(record["mismatch"].values()) != record["samples"], "samples"),
        (record["correctly_rounded"] > judged, "correctly_rounded"),
        (errors != judged, "histogram"),
        (judged > 0 and record["max_ulp"] is None, "max_ulp"),
    ):
        if wrong:
            raise InvalidInput(f"{where}: {why}: the counts do not add up")


def _check_planned(context, parts_of, samples, path):
    """Of a complete run every row that was planned is there, with all of its samples."""
    if not context["complete"]:
        return
    for token, subjects in context.get("planned", {}).items():
        for name, strata in subjects.items():
            for stratum, points in strata.items():
                for part in parts_of.get(name, ()):
                    key = (name, part, token, stratum)
                    if samples.get(key) != points:
                        raise Incomplete(
                            f"{path.name}: {' '.join(key)}: {samples.get(key, 0)} of {points} samples that were planned"
                        )


def _load_judged(path, schema_name, context, parts_of, listed):
    """The records of the functions or of the kernels, each one held to the context."""
    seen = {}
    found = []
    for where, record in reading.read_lines(path, schema_name):
        _check_against_context(record, where, context, parts_of, seen, listed)
        found.append(record)
    if all(record["samples"] == 0 for record in found):
        raise NothingMeasured(f"{path}: every record has 0 samples")
    for where, record in zip(seen.values(), found):
        _check_counts(record, where)
    samples = dict(zip(seen, (record["samples"] for record in found)))
    _check_planned(context, parts_of, samples, path)
    return found


def _load_math(path, context):
    _require(context, "functions", path.name)
    parts_of = {entry["name"]: entry["parts"] for entry in context["functions"]}
    return _load_judged(path, "math", context, parts_of, "functions")


def _load_kernels(path, context):
    _require(context, "kernels", path.name)
    parts_of = {
        entry["name"]: [output["name"] for output in entry["outputs"]]
        for entry in context["kernels"]
    }
    return _load_judged(path, "kernels", context, parts_of, "kernels")


def _load_timing(path):
    """(times in ns by (what, type), lines of the scenes)."""
    if not path.exists():
        return {}, []
    seen, times, scenes = set(), {}, []
    for where, record in reading.read_lines(path, "timing"):
        key = (record["what"], record["type"])
        if record["what"] == "scene":
            key += (record["scene"], str(record["threads"]))
            scenes.append(record)
        else:
            times[key] = float(record["ns_per_eval"])
        if key in seen:
            raise InvalidInput(f"{where}: {' '.join(key)}: second record")
        seen.add(key)
    return times, scenes


def _load_pendulum(name, directory, context, chains, scenes):
    """The pendulum's part of a run, None where it has none."""
    records = scenes.records if scenes else ()
    if not (chains or pendulum_records.are_in(directory)):
        return None
    run = pendulum_records.load(name, directory, context, chains, records)
    empty = not (
        run.records or run.correlations or run.orders or run.drifts or run.series
    )
    return None if empty else pendulum_records.Pendulum((run,))


def load(directory, name="", chains=None):
    """Read and validate all of DIR that a report is made from.

    Of a suite `name` is the directory's, and `chains` the scenes of the whole suite that are pendulums.
    """
    directory = Path(directory)
    if not directory.is_dir():
        raise InvalidInput(f"{directory}: not a directory")
    math_path, kernels_path = directory / "math.jsonl", directory / "kernels.jsonl"
    has_math = reading.has_records(math_path)
    has_kernels = reading.has_records(kernels_path)
    times, scene_times = _load_timing(directory / "timing.jsonl")
    has_scenes = bool(scene_times) or scene_records.are_in(directory)
    has_pendulum = pendulum_records.are_in(directory)
    has_stress = stress_records.are_in(directory)
    has_work = work_precision_records.are_in(directory)
    has_collisions = collision_records.are_in(directory)
    judged = has_math or has_kernels or has_stress or has_work or has_collisions
    if not (judged or has_scenes or has_pendulum):
        raise NothingMeasured(
            f"{directory}: no record in math.jsonl, kernels.jsonl, scenes.jsonl, correlation.jsonl, orders.jsonl, drift.jsonl, "
            f"{stress_records.FILE}, {work_precision_records.FILE} or {collision_records.FILE}"
        )
    path = directory / "context.json"
    context = reading.parse(reading.read(path), path.name, "context")
    if chains is None:
        chains = pendulum_records.chains_in(directory)
    scenes = scene_records.load(directory, scene_times, chains) if has_scenes else None
    run = Run(
        context,
        _load_math(math_path, context) if has_math else [],
        times,
        tuple(_load_kernels(kernels_path, context)) if has_kernels else (),
        scenes,
        _load_pendulum(name, directory, context, chains, scenes),
        stress=stress_records.load(directory) if has_stress else None,
        work_precision=(
            work_precision_records.load(directory, context) if has_work else None
        ),
        collisions=(
            collision_records.load(directory, scenes.records if scenes else ())
            if has_collisions
            else None
        ),
    )
    # Last: a line that is refused says more.
    checksums.check(directory, context)
    return run
