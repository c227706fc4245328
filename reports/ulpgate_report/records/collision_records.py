"""Loads collisions.jsonl: the collisions of each run of a scene, and their totals."""
from dataclasses import dataclass

from ulpgate_report.records import reading
from ulpgate_report.records.errors import InvalidInput
from ulpgate_report.values import numbers, type_order

FILE = "collisions.jsonl"
# What tells the runs of one directory apart.
_RUN = ("scene", "type", "integrator", "dt", "variant", "plan")
_WHICH = ("first", "second", "begin_step")
_BOUNDS = ("rounding_bound_J", "step_bound_J", "law_bound_J")


@dataclass(frozen=True, slots=True)
class Collision:
    """One that ended, or one that the run left open: then only what is of its begin is there.

    `speed` is that of the approach, m/s; `part_of_bound` the gained energy over what may be gained, inf where nothing may.
    """

    place: tuple
    is_open: bool
    steps: int
    duration_s: object
    speed: object
    restitution: object
    gained_J: object
    bound_J: object
    beyond: bool

    @property
    def part_of_bound(self):
        """The gained energy as a part of what may be gained; None of an open one."""
        if self.gained_J is None or self.bound_J is None:
            return None
        if not self.gained_J > 0:
            return numbers.INFINITE if self.beyond else 0.0
        return self.gained_J / self.bound_J if self.bound_J > 0 else numbers.INFINITE


@dataclass(frozen=True)
class CollisionRun:
    """A run of a scene in one type: its totals as recorded, and its collisions, at most the first 20 000.

    `steps` are those of the whole run, None where its record does not say; `place` is the line of the totals.
    """

    scene: str
    type: str
    integrator: str
    dt: str
    variant: str
    steps: object
    totals: dict
    collisions: tuple

    @property
    def ended(self):
        """The listed collisions that ended."""
        return [one for one in self.collisions if not one.is_open]

    def at(self, place):
        """The listed collision of [first body, second body, first step]; None where it is none or not listed."""
        wanted = tuple(place or ())
        return next((one for one in self.collisions if one.place == wanted), None)


@dataclass(frozen=True)
class Collisions:
    """The runs, those of a scene side by side, types in display order."""

    runs: tuple

    @property
    def type_tokens(self):
        """All types in display order."""
        return type_order.ordered(run.type for run in self.runs)

    @property
    def scenes(self):
        """The scenes in the order of the file."""
        return list(dict.fromkeys(run.scene for run in self.runs))

    def of_scene(self, scene):
        """The runs of a scene."""
        return [run for run in self.runs if run.scene == scene]


def are_in(directory):
    """Whether a directory has a line of a collision or of totals."""
    return reading.has_records(directory / FILE)


def _collision(row):
    speed = numbers.signed(row["normal_velocity_before"])
    bounds = [numbers.signed(row[name]) for name in _BOUNDS]
    return Collision(
        tuple(row[name] for name in _WHICH),
        row["open"],
        row["steps_inside"],
        numbers.signed(row["duration_s"]),
        None if speed is None else -speed,
        numbers.signed(row["restitution"]),
        numbers.signed(row["energy_gained_J"]),
        None if None in bounds else sum(bounds),
        row["beyond_condition"],
    )


def _key(record):
    return tuple(str(record.get(name, "")) for name in _RUN)


def _read(path):
    """{key of a run: ({place: collision}, [(where, totals)])} in the order of the file."""
    found, seen = {}, {}
    for where, row in reading.read_many_lines(path, "collisions"):
        key = _key(row)
        listed, totals = found.setdefault(key, ({}, []))
        which = (
            tuple(row[name] for name in _WHICH) if row["what"] == "collision" else ()
        )
        if (key, which) in seen:
            shown = " ".join((row["scene"], row["type"], *map(str, which)))
            first = seen[key, which]
            raise InvalidInput(f"{where}: {shown}: second record; first {first}")
        seen[key, which] = where
        if which:
            listed[which] = _collision(row)
        else:
            totals.append((where, row))
    return found


def made_of(runs):
    """The runs in display order."""
    scenes = list(dict.fromkeys(run.scene for run in runs))
    tokens = type_order.ordered(run.type for run in runs)
    return Collisions(
        tuple(sorted(runs, key=lambda r: (scenes.index(r.scene), tokens.index(r.type))))
    )


def load(directory, scene_records=()):
    """Read and validate; each run has its totals, which count the collisions that are listed."""
    steps = {_key(record): record.get("steps") for record in scene_records}
    runs = []
    for key, (listed, totals) in _read(directory / FILE).items():
        if not totals:
            shown = " ".join(key[:2])
            raise InvalidInput(f"{FILE}: {shown}: its line of totals is missing")
        where, row = totals[0]
        if row["rows"] != len(listed):
            said = f"{row['rows']} collisions, and {len(listed)} are there"
            raise InvalidInput(f"{where}: rows: it says {said}")
        collisions = tuple(listed.values())
        runs.append(CollisionRun(*key[:5], steps.get(key), row, collisions))
    return made_of(runs)
