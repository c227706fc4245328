"""Loads what a run directory holds of a pendulum: correlations, series with angles, snapshots, orders of integrators."""
import math
import re
from dataclasses import dataclass, field

from ulpgate_report.records import (
    chain_series,
    csv_columns,
    reading,
    scene_files,
    scene_records,
)
from ulpgate_report.records.errors import InvalidInput
from ulpgate_report.values import type_order

# The published figure has nine instants; more would be too small to read.
MOST_SNAPSHOTS = 9
# What a row of correlation.jsonl is against where it judges the reference itself.
OWN_REFERENCE, HALF_STEP = "RealHP4", "half_step"
_CURVE = ("time_s", "correlation")
_SNAPSHOT = ("shape", "x_m", "y_m", "time_s")
# Of a type without an entry in the context; what has other names needs one.
_KNOWN_BITS = {"float": 24, "double": 53, "long_double": 64, "float128": 113}


@dataclass(frozen=True)
class Condition:
    """What a scene was run with; `dt` and `variant` are texts as they were given."""

    scene: str
    dt: str
    variant: str

    @property
    def text(self):
        """For captions."""
        known = [self.scene, f"time step {self.dt} s" if self.dt else "", self.variant]
        return ", ".join(filter(None, known))


@dataclass(frozen=True)
class PendulumRun:
    """One directory. Curves are by (scene, type, against), series and snapshots by (scene, type).

    A snapshot is (step, columns). `name` is the directory's name in a suite, empty for a run by itself.
    """

    name: str
    records: tuple = ()
    correlations: tuple = ()
    curves: dict = field(default_factory=dict)
    series: dict = field(default_factory=dict)
    snapshots: dict = field(default_factory=dict)
    orders: tuple = ()
    drifts: tuple = ()
    bits: dict = field(default_factory=dict)

    def condition(self, scene, token):
        """What a scene was run with in a type: as its record says, else any of the directory's of this scene."""
        rows = [r for r in (*self.records, *self.correlations) if r["scene"] == scene]
        rows.sort(key=lambda r: r["type"] != token)
        first = rows[0] if rows else {}
        return Condition(scene, str(first.get("dt", "")), first.get("variant", ""))

    def by_condition(self, columns):
        """{Condition: [(type, what `columns` has of it)]}, types in display order."""
        found = {}
        tokens = type_order.ordered(token for _, token in columns)
        for scene in sorted({scene for scene, _ in columns}):
            for token in tokens:
                if (scene, token) in columns:
                    key = self.condition(scene, token)
                    found.setdefault(key, []).append((token, columns[scene, token]))
        return found


def condition_of(record):
    """What a record was run with."""
    return Condition(record["scene"], str(record["dt"]), record.get("variant", ""))


@dataclass(frozen=True)
class Pendulum:
    """All runs of a suite, or the one of a directory by itself."""

    runs: tuple

    @property
    def records(self):
        """Lines of scenes.jsonl of pendulums."""
        return [record for run in self.runs for record in run.records]

    @property
    def correlations(self):
        """All lines of correlation.jsonl."""
        return [row for run in self.runs for row in run.correlations]

    @property
    def orders(self):
        """All lines of orders.jsonl."""
        return [row for run in self.runs for row in run.orders]

    @property
    def drifts(self):
        """All lines of drift.jsonl."""
        return [row for run in self.runs for row in run.drifts]

    @property
    def bits(self):
        """Significand bits by type."""
        found = dict(_KNOWN_BITS)
        for run in self.runs:
            found.update(run.bits)
        return found

    def most_precise(self, tokens):
        """The type of the longest significand, the first of several."""
        bits = self.bits
        # A type that the context does not tell has its decimal digits in its name.
        digits = {t: int(re.sub(r"\D", "", t) or 0) for t in tokens}
        return max(tokens, key=lambda t: bits.get(t, math.log2(10) * digits[t]))

    @property
    def type_tokens(self):
        """All types in display order."""
        rows = (*self.records, *self.correlations, *self.orders, *self.drifts)
        found = [row["type"] for row in rows]
        for run in self.runs:
            found += [token for _, token in (*run.series, *run.snapshots)]
        return type_order.ordered(found)


def _lines(path, schema_name, key_names):
    """The records of a .jsonl file; each key stands once."""
    seen, found = {}, []
    if not path.exists():
        return found
    for where, record in reading.read_lines(path, schema_name):
        key = tuple(str(record.get(name, "")) for name in key_names)
        if key in seen:
            raise InvalidInput(
                f"{where}: {' '.join(filter(None, key))}: second record; first {seen[key]}"
            )
        seen[key] = where
        found.append(record)
    return found


def _correlations(directory):
    key = ("scene", "type", "against", "dt", "variant")
    return _lines(directory / "correlation.jsonl", "correlation", key)


def _series_paths(directory, known):
    series, _, _, _ = scene_files.find(directory, known)
    return {k: p for k, p in series.items() if chain_series.is_chain(p)}


def chains_in(directory):
    """The names of the scenes of a directory that are chains: they have angles or were correlated."""
    rows = _correlations(directory)
    known = [(row["scene"], row["type"]) for row in rows]
    return {scene for scene, _ in known} | {
        scene for scene, _ in _series_paths(directory, known)
    }


def are_in(directory):
    """Whether a directory holds anything of a pendulum's own."""
    names = ("correlation.jsonl", "orders.jsonl", "drift.jsonl")
    return any(reading.has_records(directory / name) for name in names)


def _curves(directory, rows):
    found = {}
    for row in rows:
        key = (row["scene"], row["type"], row["against"])
        path = directory / "correlation" / f"{'_'.join(key)}.csv"
        if path.exists():
            found[key] = csv_columns.read(path, _CURVE)
    return found


def load(name, directory, context, chains, records):
    """Read and validate what belongs to the scenes `chains`; `records` are all of scenes.jsonl."""
    rows = _correlations(directory)
    mine = [record for record in records if record["scene"] in chains]
    known = [(row["scene"], row["type"]) for row in (*records, *rows)]
    series, _, snapshots, _ = scene_files.find(directory, known)
    order_key = ("integrator", "type", "problem", "dt")
    return PendulumRun(
        name=name,
        records=tuple(mine),
        correlations=tuple(rows),
        curves=_curves(directory, rows),
        series={
            key: chain_series.read(path)
            for key, path in series.items()
            if key[0] in chains and chain_series.is_chain(path)
        },
        snapshots={
            key: [
                (step, csv_columns.read(path, _SNAPSHOT, scene_records.WORDS))
                for step, path in scene_records.chosen(found, MOST_SNAPSHOTS)
            ]
            for key, found in snapshots.items()
            if key[0] in chains
        },
        orders=tuple(_lines(directory / "orders.jsonl", "orders", order_key)),
        drifts=tuple(_lines(directory / "drift.jsonl", "drift", order_key)),
        bits={
            entry["token"]: entry["significand_bits"]
            for entry in context.get("types", ())
        },
    )
