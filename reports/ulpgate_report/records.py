"""Loads what a run directory holds: the context, and whichever of math, kernels and scenes were run."""
from dataclasses import dataclass
from pathlib import Path

from ulpgate_report import reading, scene_records
from ulpgate_report.errors import InvalidInput, NothingMeasured


@dataclass(frozen=True)
class Run:
    """One run as read; what was not run is empty. `time_ns` has the time of (what, type)."""

    context: dict
    math: list
    time_ns: dict
    kernels: tuple = ()
    scenes: object = None


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


def _load_judged(path, schema_name, context, parts_of, listed):
    """The records of the functions or of the kernels, each one held to the context."""
    seen = {}
    found = []
    for where, record in reading.read_lines(path, schema_name):
        _check_against_context(record, where, context, parts_of, seen, listed)
        found.append(record)
    if all(record["samples"] == 0 for record in found):
        raise NothingMeasured(f"{path}: every record has 0 samples")
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


def load(directory):
    """Read and validate all of DIR that a report is made from."""
    directory = Path(directory)
    if not directory.is_dir():
        raise InvalidInput(f"{directory}: not a directory")
    math_path, kernels_path = directory / "math.jsonl", directory / "kernels.jsonl"
    has_math = reading.has_records(math_path)
    has_kernels = reading.has_records(kernels_path)
    times, scene_times = _load_timing(directory / "timing.jsonl")
    has_scenes = bool(scene_times) or scene_records.are_in(directory)
    if not (has_math or has_kernels or has_scenes):
        raise NothingMeasured(
            f"{directory}: no record in math.jsonl, kernels.jsonl or scenes.jsonl"
        )
    path = directory / "context.json"
    context = reading.parse(reading.read(path), path.name, "context")
    return Run(
        context,
        _load_math(math_path, context) if has_math else [],
        times,
        tuple(_load_kernels(kernels_path, context)) if has_kernels else (),
        scene_records.load(directory, scene_times) if has_scenes else None,
    )
