"""Runs the command of every finding again: it has to show what the finding says."""
import csv
import json
import shlex
import subprocess

from ulpgate_report.paper import findings
from ulpgate_report.records.errors import InvalidInput
from ulpgate_report.values import numbers, outcomes

_AT = ["ulpgate", "at"]
# The program ends by itself before, with an error that says so.
_SECONDS = 300


def _listed(value):
    return value if isinstance(value, list) else [value]


def _is_told(says, point):
    """Whether a finding says what one of the parts of `ulpgate at --json` shows."""
    for outcome, error in zip(_listed(point["outcome"]), _listed(point["ulp_error"])):
        if outcome != "finite" and outcomes.says(outcome) in says:
            return True
        if error is not None and findings.errs(numbers.measured(error)) in says:
            return True
    return False


def _shown(program, words, runs):
    """What the program prints of a point; a sentence where it prints none."""
    command = [str(program), *words[1:], "--json"]
    try:
        done = subprocess.run(
            command, cwd=runs, capture_output=True, text=True, timeout=_SECONDS
        )
        return json.loads(done.stdout)
    except subprocess.TimeoutExpired:
        return f"no end in {_SECONDS} s"
    except OSError as error:
        raise InvalidInput(f"{program}: {error.strerror}") from error
    except ValueError:
        return done.stderr.strip() or f"exit code {done.returncode}"


def run(program, out, runs):
    """(how many commands `ulpgate at` of OUT's findings were run in RUNS, a sentence for each that shows something else)."""
    wrong, count = [], 0
    with open(out / findings.FILE, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        words = shlex.split(row["command"])
        if words[: len(_AT)] != _AT:
            continue
        count += 1
        shown = _shown(program, words, runs)
        if isinstance(shown, str):
            wrong.append(f"{row['command']}: {shown}")
        elif not _is_told(row["says"], shown):
            wrong.append(
                f"{row['command']}: shows {shown['outcome']}, {shown['ulp_error']} ULP, not: {row['says']}"
            )
    return count, wrong
