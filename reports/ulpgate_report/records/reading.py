"""Reads JSON and JSON lines and holds each to its schema; a refusal names file and line."""
import bisect
import json
from functools import lru_cache
from pathlib import Path

import jsonschema

from ulpgate_report.records.errors import InvalidInput

SCHEMA_FOLDER = Path(__file__).resolve().parents[2] / "schema"


@lru_cache(maxsize=None)
def validator(name):
    """The validator of `schema/NAME.schema.json`."""
    schema = json.loads((SCHEMA_FOLDER / f"{name}.schema.json").read_text("utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


# By these a schema tells numbers apart; what it compares with lies in one list.
_BOUNDS = (
    "minimum",
    "maximum",
    "exclusiveMinimum",
    "exclusiveMaximum",
    "const",
    "enum",
)
# These look at more of a number or of a list than a shape keeps.
NO_SHAPES = ("multipleOf", "uniqueItems")


def _numbers_of(schema):
    """Every number that a schema compares with."""
    if isinstance(schema, list):
        return [n for one in schema for n in _numbers_of(one)]
    if not isinstance(schema, dict):
        return []
    found = []
    for name, value in schema.items():
        values = value if isinstance(value, list) else [value]
        if name in _BOUNDS:
            found += [one for one in values if isinstance(one, (int, float))]
        found += _numbers_of(value)
    return found


def shape_of(value, bounds):
    """What a schema with these bounds, ascending, can see of a JSON value: values of one shape pass it alike."""
    kind = type(value)
    if kind is dict:
        return tuple([(name, shape_of(one, bounds)) for name, one in value.items()])
    if kind is list:
        return (kind, *[shape_of(one, bounds) for one in value])
    if kind is int or kind is float:
        is_whole = kind is int or value.is_integer()
        sides = (bisect.bisect_left(bounds, value), bisect.bisect_right(bounds, value))
        return (is_whole, *sides)
    return (kind, value)


def _refuse_constant(text):
    # Python would take NaN and Infinity; JSON has neither, and other readers would stop here.
    raise ValueError(f"{text} is not JSON")


def _value_of(text, where):
    """The value of a JSON text."""
    try:
        return json.loads(text, parse_constant=_refuse_constant)
    except json.JSONDecodeError as error:
        line = where if ":" in where else f"{where}:{error.lineno}"
        raise InvalidInput(f"{line}: not JSON: {error.msg}") from error
    except (ValueError, RecursionError) as error:
        raise InvalidInput(f"{where}: not JSON: {error}") from error


def _hold(value, where, schema_name):
    """Refuse a value that its schema does not accept."""
    found = list(validator(schema_name).iter_errors(value))
    # Beside a field that is wrong all others of its branch would be called unknown.
    said = [one for one in found if one.validator != "unevaluatedProperties"]
    problem = jsonschema.exceptions.best_match(said or found)
    if problem is not None:
        place = "/".join(str(part) for part in problem.absolute_path) or "record"
        raise InvalidInput(f"{where}: {place}: {problem.message[:300]}")


def parse(text, where, schema_name):
    """The value of a JSON text that its schema accepts."""
    value = _value_of(text, where)
    _hold(value, where, schema_name)
    return value


def read(path):
    """The whole text of a file."""
    try:
        return path.read_text("utf-8")
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        raise InvalidInput(f"{path.name}:{line}: not UTF-8 text") from error
    except OSError as error:
        raise InvalidInput(f"{path}: cannot read: {error.strerror}") from error


def first_line(path):
    """The first line of a file, without its end."""
    try:
        with open(path, encoding="utf-8") as file:
            return file.readline().rstrip("\n")
    except UnicodeDecodeError as error:
        raise InvalidInput(f"{path.name}:1: not UTF-8 text") from error
    except OSError as error:
        raise InvalidInput(f"{path}: cannot read: {error.strerror}") from error


def has_records(path):
    """Whether a .jsonl file is there and holds anything."""
    return path.exists() and bool(read(path).strip())


def _numbered(path):
    """Yield (place, line) of the lines that are not empty."""
    for number, line in enumerate(read(path).split("\n"), start=1):
        if line.strip():
            yield f"{path.name}:{number}", line


def read_lines(path, schema_name):
    """Yield (place, record) for each line of a .jsonl file; empty lines are passed over."""
    for where, line in _numbered(path):
        yield where, parse(line, where, schema_name)


def read_many_lines(path, schema_name):
    """The same for files of many lines of few shapes: of each shape the first is held to the schema, which is slow."""
    bounds = sorted(set(_numbers_of(validator(schema_name).schema)))
    accepted = set()
    for where, line in _numbered(path):
        value = _value_of(line, where)
        shape = shape_of(value, bounds)
        if shape not in accepted:
            _hold(value, where, schema_name)
            accepted.add(shape)
        yield where, value
