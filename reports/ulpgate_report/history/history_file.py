"""The SQLite file of a history: its runs, the rows that stepped with their values, and the steps."""
import json
import sqlite3
from dataclasses import dataclass
from pathlib import Path

from ulpgate_report.records.errors import InvalidInput, NothingMeasured

# "ulpg", as the program writes it.
APPLICATION = 0x756C7067
FORMAT = 1


@dataclass(frozen=True)
class HistoryRun:
    """One run; `platform` has processor, libraries and compiler by their names."""

    commit: str
    time_s: int
    platform: dict
    verb: str
    rows: int


@dataclass(frozen=True)
class Series:
    """A row that stepped; `values` are (place of the run, its error), `times` (place of the run, seconds of repeats)."""

    kind: str
    name: str
    part: str
    type: str
    setting: str
    values: tuple
    times: tuple

    @property
    def title(self):
        """The row in one line."""
        part = f".{self.part}" if self.part not in ("", "value") else ""
        setting = f", {self.setting}" if self.setting else ""
        return f"{self.name}{part} {self.type}{setting}"


@dataclass(frozen=True)
class Step:
    """A step of `series`, by places: of the row, of the first run with the new level and of the last before it."""

    series: int
    run: int
    before: int
    what: str
    change: str
    text: str
    platform: str


@dataclass(frozen=True)
class History:
    """Runs by time, the rows that stepped, and the steps by run."""

    runs: tuple
    series: tuple
    steps: tuple


def _check(connection, path):
    owner = connection.execute("PRAGMA application_id").fetchone()[0]
    version = connection.execute("PRAGMA user_version").fetchone()[0]
    if owner != APPLICATION:
        raise InvalidInput(f"{path}: no history of ulpgate")
    if version > FORMAT:
        raise InvalidInput(
            f"{path}: written by a newer ulpgate (format {version}, this one knows {FORMAT})"
        )


def _runs(connection):
    """({id: place}, runs)."""
    query = """SELECT runs.id, commit_id, time_s, facts, verb,
        (SELECT count(*) FROM measurements WHERE run = runs.id)
        FROM runs JOIN platforms ON platforms.id = platform ORDER BY time_s, runs.id"""
    found = connection.execute(query).fetchall()
    places = {row[0]: place for place, row in enumerate(found)}
    runs = [HistoryRun(r[1], r[2], json.loads(r[3]), r[4], r[5]) for r in found]
    return places, tuple(runs)


def _one_series(connection, number, places):
    query = "SELECT kind, name, part, type, setting FROM series WHERE id = ?"
    key = connection.execute(query, (number,)).fetchone()
    query = "SELECT run, error FROM measurements JOIN results ON results.id = result WHERE series = ?"
    values = connection.execute(query, (number,)).fetchall()
    query = "SELECT run, seconds FROM times WHERE series = ?"
    times = connection.execute(query, (number,)).fetchall()
    return Series(
        *key,
        tuple(sorted((places[run], error) for run, error in values)),
        tuple(sorted((places[run], tuple(json.loads(s))) for run, s in times)),
    )


def load(path):
    """Read a history; InvalidInput where the file is none, NothingMeasured where no run is in it."""
    path = Path(path)
    if not path.is_file():
        raise InvalidInput(f"{path}: no file")
    try:
        # As a URI: a file that is not there must not be made, and one that is there not be changed.
        connection = sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro", uri=True)
        with connection:
            _check(connection, path)
            places, runs = _runs(connection)
            query = "SELECT series, run, before, what, change, text, platform FROM steps ORDER BY id"
            found = connection.execute(query).fetchall()
            numbers = list(dict.fromkeys(row[0] for row in found))
            series = tuple(_one_series(connection, n, places) for n in numbers)
        connection.close()
    except (sqlite3.Error, json.JSONDecodeError, KeyError) as error:
        raise InvalidInput(f"{path}: {error}") from error
    if not runs:
        raise NothingMeasured(f"{path}: no run is in it")
    steps = [
        Step(numbers.index(row[0]), places[row[1]], places[row[2]], *row[3:])
        for row in found
    ]
    return History(runs, series, tuple(steps))
