"""Loads stress.jsonl: stiff and extreme cases, each with a verdict in each type."""
import re
from dataclasses import dataclass

from ulpgate_report.records import reading
from ulpgate_report.records.errors import InvalidInput
from ulpgate_report.values import type_order

FILE = "stress.jsonl"
# From one operation to whole scenes.
KINDS = ("formula", "trajectory", "state", "scene", "metamorphic", "step_limit")


def key_of(row):
    """What a case is called: formula/rump_1988/naive."""
    return "/".join(filter(None, (row["kind"], row["case"], row["form"])))


@dataclass(frozen=True)
class Stress:
    """The lines by kind, name, form and type, whatever their order in the file was."""

    rows: tuple

    @property
    def kinds(self):
        """The kinds that were run, in display order."""
        return [kind for kind in KINDS if any(row["kind"] == kind for row in self.rows)]

    @property
    def type_tokens(self):
        """All types in display order."""
        return type_order.ordered(row["type"] for row in self.rows)

    def of_kind(self, kind):
        """{key of a case: {type: its line}} of a kind, or of all where it is None."""
        found = {}
        for row in self.rows:
            if kind in (None, row["kind"]):
                found.setdefault(key_of(row), {})[row["type"]] = row
        return found


def _natural(text):
    """What sorts 1e2 before 1e10: the runs of digits as numbers."""
    parts = re.split(r"(\d+)", text)
    return [(int(p), "") if p.isdecimal() else (-1, p) for p in parts], text


def made_of(rows):
    """The lines in display order."""
    tokens = type_order.ordered(row["type"] for row in rows)
    order = sorted(
        rows,
        key=lambda row: (
            KINDS.index(row["kind"]),
            _natural(row["case"]),
            _natural(row["form"]),
            tokens.index(row["type"]),
        ),
    )
    return Stress(tuple(order))


def are_in(directory):
    """Whether a directory has a line of a case."""
    return reading.has_records(directory / FILE)


def load(directory):
    """Read and validate; each case stands once in each type."""
    seen, rows = {}, []
    for where, row in reading.read_lines(directory / FILE, "stress"):
        key = (key_of(row), row["type"])
        if key in seen:
            raise InvalidInput(
                f"{where}: {' '.join(key)}: second record; first {seen[key]}"
            )
        seen[key] = where
        rows.append(row)
    return made_of(rows)
