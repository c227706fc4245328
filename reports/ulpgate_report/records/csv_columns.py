"""Reads a CSV file of numbers into columns; a refusal names file and line."""
import decimal
import math

from ulpgate_report.records import reading
from ulpgate_report.records.errors import InvalidInput


def _refuse(fields, names, readers, where):
    """Name the field that its reader does not take."""
    for name, field, read_field in zip(names, fields, readers):
        try:
            read_field(field)
        except (ValueError, decimal.InvalidOperation):
            raise InvalidInput(
                f"{where}: {name}: {field[:40]!r} is no number"
            ) from None


def _header(line, where, required):
    names = line.split(",")
    if len(set(names)) != len(names):
        raise InvalidInput(f"{where}: a column stands twice in the header")
    for name in required:
        if name not in names:
            raise InvalidInput(f"{where}: the column {name} is missing")
    return names


def read(path, required, readers=None, other=float):
    """{column: list}, in the order of the file; `readers` says how a column is read where not by `other`.

    A file that does not end with a line end was cut off, and its last number with it.
    """
    place = f"{path.parent.name}/{path.name}"
    text = reading.read(path)
    lines = text.split("\n")
    if lines[-1]:
        raise InvalidInput(f"{place}:{len(lines)}: the file ends within a line")
    if len(lines) < 2:
        raise InvalidInput(f"{place}:1: the header is missing")
    names = _header(lines[0], f"{place}:1", required)
    columns = [[] for _ in names]
    read_fields = [(readers or {}).get(name, other) for name in names]
    for number, line in enumerate(lines[1:-1], start=2):
        fields = line.split(",")
        if len(fields) != len(names):
            raise InvalidInput(
                f"{place}:{number}: {len(fields)} fields where the header has {len(names)}"
            )
        try:
            for column, field, read_field in zip(columns, fields, read_fields):
                column.append(read_field(field))
        except (ValueError, decimal.InvalidOperation):
            _refuse(fields, names, read_fields, f"{place}:{number}")
    return dict(zip(names, columns))


def finite_pairs(xs, ys, least=-math.inf):
    """The points whose two numbers are finite and above `least`, as two lists."""
    kept = [
        (x, y)
        for x, y in zip(xs, ys)
        if math.isfinite(x) and math.isfinite(y) and x > least and y > least
    ]
    return [x for x, _ in kept], [y for _, y in kept]
