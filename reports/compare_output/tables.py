"""Tables: what a reader makes of a file, and the rows of several of them that belong together."""
from dataclasses import dataclass, field

import numpy as np

from compare_output.numbers import Numbers
from compare_output.problem import BAD_INPUT, Problem

# Columns that name a row, where a file has one; particles are written in any order.
KEYS = (
    *("id", "body", "particle", "atom", "node", "element", "cell", "index"),
    *("key", "name", "label", "tag", "step", "iteration", "record", "row"),
)


@dataclass
class Column:
    """A field: numbers, or texts where not all of it is numbers."""

    name: str
    numbers: Numbers | None
    texts: list | None = None
    whole: bool = False  # integers: compared exactly unless told otherwise

    def __len__(self):
        return len(self.numbers if self.numbers is not None else self.texts)

    def values(self):
        """What identifies a row by this column."""
        if self.texts is not None:
            return list(self.texts)
        return list(
            zip(self.numbers.high.tolist(), self.numbers.low.tolist(), strict=True)
        )

    def shown(self, row):
        if self.texts is not None:
            return self.texts[row]
        value = self.numbers.high[row]
        return str(int(value)) if self.whole else repr(float(value))


@dataclass
class Table:
    """Columns of the same length; `where` says of a row which line of which file it is."""

    file: str
    columns: dict = field(default_factory=dict)
    lines: list | None = None
    rows: int = 0

    def add(self, column):
        if column.name in self.columns:
            raise Problem(
                BAD_INPUT, f"{self.file}: two fields are called '{column.name}'"
            )
        if self.columns and len(column) != self.rows:
            raise Problem(
                BAD_INPUT,
                f"{self.file}: field '{column.name}' has {len(column)} rows, others {self.rows}",
            )
        self.rows = len(column)
        self.columns[column.name] = column

    def add_array(self, name, array):
        """Rows of numbers, a column for each component: name_0, name_1 ..., or x, y, z of vectors."""
        array = np.asarray(array)
        whole = bool(np.issubdtype(array.dtype, np.integer))
        if array.ndim == 1:
            self.add(Column(name, Numbers.of_array(array), whole=whole))
            return
        array = array.reshape(len(array), -1)
        suffixes = "xyz" if array.shape[1] == 3 else range(array.shape[1])
        for part, suffix in zip(array.T, suffixes, strict=True):
            numbers = Numbers.of_array(np.ascontiguousarray(part))
            self.add(Column(f"{name}_{suffix}", numbers, whole=whole))

    def where(self, row):
        return f"{self.file}:{self.lines[row]}" if self.lines else self.file


def _unique(table, names):
    rows = list(zip(*(table.columns[n].values() for n in names), strict=True))
    return len(set(rows)) == len(rows)


def key_of(tables, wanted):
    """Names of the columns that tell the rows of the first table apart; [] where rows go by their place."""
    if wanted:
        for table in tables:
            for name in wanted:
                if name not in table.columns:
                    raise Problem(
                        BAD_INPUT,
                        f"{table.file}: no field '{name}' to tell rows by; there are {', '.join(table.columns)}",
                    )
        return wanted
    common = [
        name
        for key in KEYS
        for name in tables[0].columns
        if name.lower() == key and all(name in t.columns for t in tables)
    ]
    choices = [[name] for name in common]
    choices += [[a, b] for i, a in enumerate(common) for b in common[i + 1 :]]
    for names in choices:
        if _unique(tables[0], names):
            return names
    return []


@dataclass
class Matched:
    """Rows of several tables that belong together: rows[t][i] is the row of table t; in the order of the first."""

    key: list
    rows: list
    # By table: keys that it has alone or lacks, as text.
    only_in: list


def match(tables, wanted):
    key = key_of(tables, wanted)
    if not key:
        least = min(t.rows for t in tables)
        only = [
            [f"row {i + 1}" for i in range(least, min(t.rows, least + 3))]
            + ([f"... {t.rows - least} in all"] if t.rows > least + 3 else [])
            for t in tables
        ]
        return Matched([], [np.arange(least)] * len(tables), only)
    indices = []
    for t in tables:
        places = {}
        rows = zip(*(t.columns[n].values() for n in key), strict=True)
        for row, value in enumerate(rows):
            if value in places:
                raise Problem(
                    BAD_INPUT,
                    f"{t.where(row)}: the same {', '.join(key)} as {t.where(places[value])}: {name_of(t, key, row)}",
                )
            places[value] = row
        indices.append(places)
    common = [v for v in indices[0] if all(v in places for places in indices[1:])]
    shared = set(common)
    only = [
        [name_of(t, key, places[v]) for v in places if v not in shared]
        for t, places in zip(tables, indices, strict=True)
    ]
    rows = [np.array([places[v] for v in common], dtype=np.int64) for places in indices]
    return Matched(key, rows, only)


def name_of(table, key, row):
    """'body 3' or 'row 4'."""
    if not key:
        return f"row {row + 1}"
    return " ".join(f"{name} {table.columns[name].shown(row)}" for name in key)
