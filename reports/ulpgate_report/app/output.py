"""Writes files whole or not at all, and turns the system's refusals into a clear failure."""
import os
from pathlib import Path

from ulpgate_report.records.errors import OutputFailure


def write_bytes(path, data):
    """Write `data` to `path`; the old file stays in place if that fails."""
    path = Path(path)
    partial = path.with_name(path.name + ".part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            with open(partial, "wb") as file:
                file.write(data)
            os.replace(partial, path)
        except OSError:
            partial.unlink(missing_ok=True)
            raise
    except OSError as error:
        raise OutputFailure(f"cannot write {path}: {error.strerror}") from error


def write_text(path, text):
    """Write `text` as UTF-8 with the line ends as they are."""
    write_bytes(path, text.encode("utf-8"))


def remove(path):
    """Remove what an earlier report left, if it is there."""
    try:
        Path(path).unlink(missing_ok=True)
    except OSError as error:
        raise OutputFailure(f"cannot remove {path}: {error.strerror}") from error
