"""Edited records for tests: what a run wrote, changed line by line, with checksums that fit again."""

import functools
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

import program  # noqa: E402

sys.path.insert(0, str(program.ROOT / "reports"))

from ulpgate_report.records.checksums import fnv1a, sealed  # noqa: E402

run = functools.partial(program.run, timeout=120)


def lines_of(file):
    return file.read_text().splitlines()


def seal(directory):
    """Gives an edited directory the checksums of its content, so that only the content can betray it."""
    file = directory / "context.json"
    context = json.loads(file.read_text())
    for name in context.get("records_checksum", ()):
        context["records_checksum"][name] = fnv1a((directory / name).read_text())
    context.pop("checksum", None)
    file.write_text(sealed(json.dumps(context, indent=2, ensure_ascii=False)))


def edit(directory, name, number, change, sealing=True):
    """Changes one line's object, or leaves it out where `change` gives None."""
    file = directory / name
    lines = lines_of(file)
    row = json.loads(lines[number])
    changed = change(row)
    text = [json.dumps(changed, separators=(",", ":"))] if changed else []
    file.write_text("\n".join(lines[:number] + text + lines[number + 1 :]) + "\n")
    if sealing:
        seal(directory)


def put(**values):
    return lambda row: {**row, **values}


def without(key):
    return lambda row: {k: v for k, v in row.items() if k != key}
