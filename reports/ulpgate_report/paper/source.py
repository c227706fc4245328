"""Reads the runs of a paper: one a chapter, with what its kinds of report make of it."""
import json
from dataclasses import dataclass, replace

from ulpgate_report.app import build
from ulpgate_report.history import history_file
from ulpgate_report.libraries import beside
from ulpgate_report.paper.chapters import CHAPTERS
from ulpgate_report.records import records, suite
from ulpgate_report.records.errors import InvalidInput, NothingMeasured

LIBRARIES, HISTORY, PUBLISHED = "libraries", "history", "published"
CLAIMS = "claims.json"


@dataclass(frozen=True)
class Source:
    """A chapter with its run; `parts` are (kind, data)."""

    chapter: object
    path: object
    context: dict
    parts: tuple


def _runs_below(path):
    return [p for p in sorted(path.iterdir()) if (p / "context.json").is_file()]


def _beside(path):
    """The functions of all runs below a directory side by side."""
    places = _runs_below(path)
    if len(places) < 2:
        raise NothingMeasured(f"{path}: fewer than two libraries")
    runs = [records.load(place) for place in places]
    found = beside.of(runs, [place.name for place in places])
    context = {**runs[0].context, "strata": runs[0].context["strata"]}
    return records.Run(context, [], {}, libraries=found)


def _joined(path):
    """The functions of runs that have a type each, as one run."""
    runs = [records.load(place) for place in _runs_below(path)]
    if not runs:
        raise NothingMeasured(f"{path}: no run")
    types = {t["token"]: t for run in runs for t in run.context["types"]}
    complete = all(run.context.get("complete", True) for run in runs)
    context = {**runs[0].context, "types": list(types.values()), "complete": complete}
    rows = [row for run in runs for row in run.math]
    times = {key: time for run in runs for key, time in run.time_ns.items()}
    return records.Run(context, rows, times)


def _of(chapter, path):
    if chapter.run == LIBRARIES:
        run = _beside(path)
    elif chapter.run == PUBLISHED:
        run = _joined(path)
    elif chapter.run == HISTORY:
        run = records.Run({}, [], {}, history=history_file.load(path))
    else:
        run = suite.load(path)
    parts = [one for one in build.parts_of(run) if one[1] is not None]
    return Source(chapter, path, run.context, tuple(parts))


def load(runs, history=None):
    """(sources, sentences about chapters that nothing was run for)."""
    found, left_out = [], []
    for chapter in CHAPTERS:
        path = history if chapter.run == HISTORY else runs / chapter.run
        if path is None or not path.exists():
            left_out.append(f"{chapter.title}: nothing was run ({chapter.run}).")
            continue
        try:
            found.append(_of(chapter, path))
        except NothingMeasured as error:
            left_out.append(f"{chapter.title}: {error}.")
    if not found:
        raise NothingMeasured(f"{runs}: no run of any chapter")
    return found, left_out


def claims(runs):
    """{library: its rows} of the runs of `ulpgate claims`."""
    found = {}
    for path in sorted(runs.glob(f"claims/*/{CLAIMS}")):
        try:
            found[path.parent.name] = json.loads(path.read_text(encoding="utf-8"))
        except ValueError as error:
            raise InvalidInput(f"{path}: {error}") from error
    return found


def renamed(table, name):
    """The table under another name, which no other has."""
    return table if table.name == name else replace(table, name=name)
