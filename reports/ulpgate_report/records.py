"""Loads the records of a run and validates each against its schema; a refusal names file and line."""
import json
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import jsonschema

from ulpgate_report.errors import InvalidInput, NothingMeasured

SCHEMA_FOLDER = Path(__file__).resolve().parent.parent / "schema"


@dataclass(frozen=True)
class Run:
    """One run as read: the context, the math records and the time of (function, type) in ns."""

    context: dict
    math: list
    time_ns: dict


@lru_cache(maxsize=None)
def validator(name):
    """The validator of `schema/NAME.schema.json`."""
    schema = json.loads((SCHEMA_FOLDER / f"{name}.schema.json").read_text("utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def _refuse_constant(text):
    # Python would take NaN and Infinity; JSON has neither, and other readers would stop here.
    raise ValueError(f"{text} is not JSON")


def _parse(text, where, schema_name):
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


def _read(path):
    try:
        return path.read_text("utf-8")
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        raise InvalidInput(f"{path.name}:{line}: not UTF-8 text") from error
    except OSError as error:
        raise InvalidInput(f"{path}: cannot read: {error.strerror}") from error


def _read_lines(path, schema_name):
    """Yield (place, record) for each line of a .jsonl file; empty lines are passed over."""
    for number, line in enumerate(_read(path).split("\n"), start=1):
        if line.strip():
            where = f"{path.name}:{number}"
            yield where, _parse(line, where, schema_name)


def _check_against_context(record, where, context, parts_of, seen):
    function, part = record["function"], record["part"]
    type_tokens = {entry["token"] for entry in context["types"]}
    if part not in parts_of.get(function, ()):
        raise InvalidInput(f"{where}: {function} {part}: not among context's functions")
    if record["type"] not in type_tokens:
        raise InvalidInput(f"{where}: {record['type']}: not among context's types")
    if record["stratum"] not in context["strata"]:
        raise InvalidInput(f"{where}: {record['stratum']}: not among context's strata")
    if record["plan"] != context["plan"]:
        raise InvalidInput(
            f"{where}: plan {record['plan']} is not the plan {context['plan']} of context.json"
        )
    key = (function, part, record["type"], record["stratum"])
    if key in seen:
        raise InvalidInput(
            f"{where}: {' '.join(key)}: second record; first {seen[key]}"
        )
    seen[key] = where


def _load_math(path, context):
    parts_of = {entry["name"]: entry["parts"] for entry in context["functions"]}
    seen = {}
    found = []
    for where, record in _read_lines(path, "math"):
        _check_against_context(record, where, context, parts_of, seen)
        found.append(record)
    return found


def _load_time_ns(path):
    """Times by (what, type); what is timed but not a function of this run is left for other reports."""
    if not path.exists():
        return {}
    seen = {}
    for where, record in _read_lines(path, "timing"):
        key = (record["what"], record["type"])
        if key in seen:
            raise InvalidInput(f"{where}: {' '.join(key)}: second record")
        seen[key] = float(record["ns_per_eval"])
    return seen


def load(directory):
    """Read and validate DIR's context.json, math.jsonl and, if present, timing.jsonl."""
    directory = Path(directory)
    if not directory.is_dir():
        raise InvalidInput(f"{directory}: not a directory")
    math_path = directory / "math.jsonl"
    if not math_path.exists() or not _read(math_path).strip():
        raise NothingMeasured(f"{directory}: no record in math.jsonl")
    context_path = directory / "context.json"
    context = _parse(_read(context_path), context_path.name, "context")
    math = _load_math(math_path, context)
    if all(record["samples"] == 0 for record in math):
        raise NothingMeasured(f"{directory}: every record of math.jsonl has 0 samples")
    return Run(context, math, _load_time_ns(directory / "timing.jsonl"))
