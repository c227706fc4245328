"""A suite: a directory of run directories, reported as one; a directory that is a run by itself is read as that."""
import dataclasses
from pathlib import Path

from ulpgate_report.records import (
    collision_records,
    pendulum_records,
    records,
    scene_records,
    stress_records,
    work_precision_records,
)
from ulpgate_report.records.errors import InvalidInput, NothingMeasured

_CONTEXT = "context.json"
_RECORDS = "*.jsonl"
# Text of every plan, which differs from run to run and is long; checksums of each directory, which were checked.
_NOT_MERGED = ("plan_text", "planned", "records_checksum", "checksum")
# Each run has one of its own, though two may be alike.
_OF_EACH = ("plan",)


def members(directory):
    """The run directories of a suite by name, none where the directory is a run by itself or no suite."""
    directory = Path(directory)
    if not directory.is_dir() or (directory / _CONTEXT).exists():
        return []
    return [one for one in sorted(directory.iterdir()) if (one / _CONTEXT).is_file()]


def _merged_context(contexts):
    """What all runs were made with: one value where they agree, else each run's by its name."""
    merged = {}
    for key in dict.fromkeys(key for context in contexts.values() for key in context):
        if key in _NOT_MERGED:
            continue
        values = {name: c[key] for name, c in contexts.items() if key in c}
        first = next(iter(values.values()))
        alike = len(values) == len(contexts) and key not in _OF_EACH
        alike = alike and all(value == first for value in values.values())
        merged[key] = first if alike else values
    types = {}
    for context in contexts.values():
        for entry in context.get("types", ()):
            types.setdefault(entry["token"], entry)
    if types:
        merged["types"] = list(types.values())
    merged["complete"] = all(c.get("complete", True) for c in contexts.values())
    return merged


def _scene_name(scene, run):
    """A scene's name with that of the run: the same scene may be in several."""
    return f"{scene}_{run}"


def _renamed(scenes, name):
    """The scenes under names that tell the run."""

    def scene(old):
        return _scene_name(old, name)

    def rows(found):
        return tuple({**row, "scene": scene(row["scene"])} for row in found)

    def columns(found):
        return {(scene(old), token): value for (old, token), value in found.items()}

    return scene_records.Scenes(
        rows(scenes.records),
        rows(scenes.timings),
        columns(scenes.series),
        columns(scenes.divergences),
        columns(scenes.snapshots),
        tuple(f"{name}/{file}" for file in scenes.unknown),
        scenes.not_missed,
    )


def _merged_scenes(runs):
    """The scenes of all runs, None where no run has any."""
    found = [_renamed(run.scenes, name) for name, run in runs.items() if run.scenes]
    if not found:
        return None

    def rows(what):
        return tuple(row for scenes in found for row in getattr(scenes, what))

    def columns(what):
        return {
            k: v for scenes in found for k, v in sorted(getattr(scenes, what).items())
        }

    return scene_records.Scenes(
        rows("records"),
        rows("timings"),
        columns("series"),
        columns("divergences"),
        columns("snapshots"),
        rows("unknown"),
        frozenset().union(*(scenes.not_missed for scenes in found)),
    )


def _of_all(runs, what):
    """[(run's name where several have it, else empty, what it has)] of the runs that have any."""
    found = [(name, getattr(run, what)) for name, run in runs.items()]
    found = [(name, one) for name, one in found if one is not None]
    return found if len(found) > 1 else [("", one) for _, one in found]


def _told_apart(run, field, rows):
    """The lines under names that tell the run, as those of scenes do."""
    return [{**row, field: "_".join(filter(None, (row[field], run)))} for row in rows]


def _merged_stress(runs):
    """The cases of all runs, None where no run has any."""
    found = _of_all(runs, "stress")
    rows = [row for run, one in found for row in _told_apart(run, "case", one.rows)]
    return stress_records.made_of(rows) if found else None


def _merged_work_precision(runs):
    """The settings of all runs, None where no run has any."""
    found = _of_all(runs, "work_precision")
    rows, fits, bits = [], [], {}
    for run, one in found:
        rows += _told_apart(run, "name", one.rows)
        fits += _told_apart(run, "name", one.fits)
        bits.update(one.bits)
    untold = sum(one.untold for _, one in found)
    merged = work_precision_records.WorkPrecision(
        tuple(rows), tuple(fits), bits, untold
    )
    return merged if found else None


def _merged_collisions(runs):
    """The collisions of all runs, scenes named as theirs are; None where no run has any."""
    found = [
        dataclasses.replace(one, scene=_scene_name(one.scene, name))
        for name, run in runs.items()
        if run.collisions
        for one in run.collisions.runs
    ]
    return collision_records.made_of(found) if found else None


def _load_members(paths):
    """({name: run}, sentences about those left out)."""
    chains = set()
    for path in paths:
        with _place(path):
            chains |= pendulum_records.chains_in(path)
    runs, notes = {}, []
    for path in paths:
        try:
            with _place(path):
                runs[path.name] = records.load(path, path.name, chains)
        except NothingMeasured:
            notes.append(f"{path.name}: no record; left out.")
    return runs, notes


class _place:
    """Puts the name of a run before the file that a refusal names."""

    def __init__(self, path):
        self._name = path.name

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        if isinstance(error, InvalidInput):
            raise InvalidInput(f"{self._name}/{error}") from error


def _notes(directory, runs):
    """Sentences about what a suite's report does not show."""
    found = [
        f"{name}: functions and kernels are reported apart: report {directory.name}/{name}."
        for name, run in runs.items()
        if run.math or run.kernels
    ]
    for path in sorted(directory.iterdir()):
        if path.is_dir() and not (path / _CONTEXT).exists():
            if any(path.glob(_RECORDS)):
                found.append(f"{path.name}: records without {_CONTEXT}; left out.")
    return found


def load(directory):
    """Read a run directory, or all those of a suite as one run."""
    paths = members(directory)
    if not paths:
        return records.load(directory)
    directory = Path(directory)
    runs, notes = _load_members(paths)
    scenes = _merged_scenes(runs)
    chains = [one for run in runs.values() if run.pendulum for one in run.pendulum.runs]
    stress, work_precision = _merged_stress(runs), _merged_work_precision(runs)
    collisions = _merged_collisions(runs)
    if not (scenes or chains or stress or work_precision or collisions):
        raise NothingMeasured(f"{directory}: no record of a scene in any run")
    return records.Run(
        _merged_context({name: run.context for name, run in runs.items()}),
        [],
        {},
        scenes=scenes,
        pendulum=pendulum_records.Pendulum(tuple(chains)) if chains else None,
        notes=(*notes, *_notes(directory, runs)),
        stress=stress,
        work_precision=work_precision,
        collisions=collisions,
    )
