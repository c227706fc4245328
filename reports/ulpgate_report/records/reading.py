"""Reads JSON and JSON lines and holds each to its schema; a refusal names file and line."""
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


def _refuse_constant(text):
    # Python would take NaN and Infinity; JSON has neither, and other readers would stop here.
    raise ValueError(f"{text} is not JSON")


def parse(text, where, schema_name):
    """The value of a JSON text that its schema accepts."""
    try:
        value = json.loads(text, parse_constant=_refuse_constant)
    except json.JSONDecodeError as error:
        line = where if ":" in where else f"{where}:{error.lineno}"
        raise InvalidInput(f"{line}: not JSON: {error.msg}") from error
    except (ValueError, RecursionError) as error:
        raise InvalidInput(f"{where}: not JSON: {error}") from error
    problem = jsonschema.exceptions.best_match(
        validator(schema_name).iter_errors(value)
    )
    if problem is not None:
        place = "/".join(str(part) for part in problem.absolute_path) or "record"
        raise InvalidInput(f"{where}: {place}: {problem.message[:300]}")
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


def read_lines(path, schema_name):
    """Yield (place, record) for each line of a .jsonl file; empty lines are passed over."""
    for number, line in enumerate(read(path).split("\n"), start=1):
        if line.strip():
            where = f"{path.name}:{number}"
            yield where, parse(line, where, schema_name)
