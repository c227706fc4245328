"""Loads what a run of scenes left: its records, times, series and the snapshots that are drawn."""
import decimal
from dataclasses import dataclass

from ulpgate_report.records import (
    chain_series,
    csv_columns,
    energy_account,
    reading,
    scene_files,
)
from ulpgate_report.records.errors import InvalidInput
from ulpgate_report.values import type_order

# More panels than these would be too small to read.
MOST_SNAPSHOTS = 4
_SERIES = ("step", "time_s")
_DIVERGENCE = ("step", "time_s", "max_position_error_m", "max_position_ulp")
# The energies stay exact: of a long type their sum is constant far below a double's last digit.
_INSTANT = {"step": float, "time_s": float}
WORDS = {"body": str, "shape": str}
_SNAPSHOT = ("shape", "x_m", "y_m", "z_m", "radius_m", "kinetic_J", "time_s")


@dataclass(frozen=True)
class Scenes:
    """Everything of a run of scenes; the tables of numbers are {column: list} by (scene, type).

    `snapshots` has a list of (step, columns) instead. `unknown` are files whose names tell no scene and type,
    `not_missed` families of figures that another kind of report has or that the scenes are not run for.
    """

    records: tuple
    timings: tuple
    series: dict
    divergences: dict
    snapshots: dict
    unknown: tuple = ()
    not_missed: frozenset = frozenset()

    @property
    def type_tokens(self):
        """All types that anything is there of, in display order."""
        found = [r["type"] for r in (*self.records, *self.timings)]
        for columns in (self.series, self.divergences, self.snapshots):
            found += [token for _, token in columns]
        return type_order.ordered(found)

    @property
    def names(self):
        """The scenes, those of the records first."""
        found = [r["scene"] for r in (*self.records, *self.timings)]
        for columns in (self.series, self.divergences, self.snapshots):
            found += sorted(scene for scene, _ in columns)
        return list(dict.fromkeys(found))

    def of(self, columns, scene):
        """[(type, what `columns` has of it)] of one scene, in display order."""
        return [
            (t, columns[scene, t]) for t in self.type_tokens if (scene, t) in columns
        ]


def are_in(directory):
    """Whether a run directory holds anything of a scene, its times apart."""
    return reading.has_records(directory / "scenes.jsonl") or any(
        any((directory / folder).glob("*.csv")) for folder in ("series", "snapshots")
    )


def _load_records(path):
    seen, found = {}, []
    if not path.exists():
        return found
    names = ("scene", "type", "integrator", "dt", "variant", "plan")
    for where, record in reading.read_lines(path, "scenes"):
        key = tuple(str(record.get(name, "")) for name in names)
        if key in seen:
            raise InvalidInput(
                f"{where}: {record['scene']} {record['type']}: second record; first {seen[key]}"
            )
        seen[key] = where
        found.append(record)
    place = {t: i for i, t in enumerate(type_order.ordered(r["type"] for r in found))}
    scenes = list(dict.fromkeys(record["scene"] for record in found))
    return sorted(found, key=lambda r: (scenes.index(r["scene"]), place[r["type"]]))


def chosen(found, most=MOST_SNAPSHOTS):
    """At most `most` of a list, the first, the last and evenly between."""
    if len(found) <= most:
        return found
    return [found[i * (len(found) - 1) // (most - 1)] for i in range(most)]


def _series_columns(path):
    """What a series must have: its kinetic energy under the name that says the instant of the velocities."""
    there = reading.first_line(path).split(",")
    kinetic = [name for name in energy_account.KINETIC if name in there]
    return (*_SERIES, *(kinetic or energy_account.KINETIC[:1]))


def _without(files, drop):
    return {key: found for key, found in files.items() if not drop(key, found)}


def load(directory, timings, chains=()):
    """Read and validate; of the snapshots those that are drawn.

    Snapshots of the scenes `chains`, and series with columns that only those have, are of the pendulum's report.
    """
    records = _load_records(directory / "scenes.jsonl")
    known = [(record["scene"], record["type"]) for record in (*records, *timings)]
    series, divergences, snapshots, unknown = scene_files.find(directory, known)
    plain_series = _without(series, lambda key, path: chain_series.is_chain(path))
    plain_snapshots = _without(snapshots, lambda key, _: key[0] in chains)
    only_chains = bool(chains) and {scene for scene, _ in known} <= set(chains)
    not_missed = [
        ("energy", len(plain_series) < len(series)),
        ("snapshots", only_chains or len(plain_snapshots) < len(snapshots)),
        ("divergence", only_chains),
        ("benchmark", only_chains),
    ]
    return Scenes(
        records=tuple(records),
        timings=tuple(timings),
        series={
            k: csv_columns.read(p, _series_columns(p), _INSTANT, decimal.Decimal)
            for k, p in plain_series.items()
        },
        divergences={
            k: csv_columns.read(p, _DIVERGENCE) for k, p in divergences.items()
        },
        snapshots={
            key: [
                (step, csv_columns.read(path, _SNAPSHOT, WORDS))
                for step, path in chosen(found)
            ]
            for key, found in plain_snapshots.items()
        },
        unknown=tuple(unknown),
        not_missed=frozenset(family for family, is_so in not_missed if is_so),
    )
