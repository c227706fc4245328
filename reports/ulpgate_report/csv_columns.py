"""Reads a CSV file of numbers into columns; a refusal names file and line."""
import math

from ulpgate_report import reading
from ulpgate_report.errors import InvalidInput


def _number(text, where, name):
    try:
        return float(text)
    except ValueError:
        raise InvalidInput(f"{where}: {name}: {text[:40]!r} is no number") from None


def _header(line, where, required):
    names = line.split(",")
    if len(set(names)) != len(names):
        raise InvalidInput(f"{where}: a column stands twice in the header")
    for name in required:
        if name not in names:
            raise InvalidInput(f"{where}: the column {name} is missing")
    return names


def read(path, required, text_columns=()):
    """{column: list of float}, in the order of the file; `text_columns` stay text.

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
    is_text = [name in text_columns for name in names]
    for number, line in enumerate(lines[1:-1], start=2):
        fields = line.split(",")
        if len(fields) != len(names):
            raise InvalidInput(
                f"{place}:{number}: {len(fields)} fields where the header has {len(names)}"
            )
        try:
            for column, field, plain in zip(columns, fields, is_text):
                column.append(field if plain else float(field))
        except ValueError:
            for name, field, plain in zip(names, fields, is_text):
                plain or _number(field, f"{place}:{number}", name)
    return dict(zip(names, columns))


def finite_pairs(xs, ys, least=-math.inf):
    """The points whose two numbers are finite and above `least`, as two lists."""
    kept = [
        (x, y)
        for x, y in zip(xs, ys)
        if math.isfinite(x) and math.isfinite(y) and x > least and y > least
    ]
    return [x for x, _ in kept], [y for _, y in kept]
