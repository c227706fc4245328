"""Loads error against what it costs: work_precision.jsonl, and beside it the times and the fits of the same run."""
from dataclasses import dataclass

from ulpgate_report.records import reading
from ulpgate_report.records.errors import InvalidInput

FILE = "work_precision.jsonl"
TIMING_FILE = "work_precision_timing.jsonl"
FITS_FILE = "work_precision_fits.jsonl"
# One schema has a branch for each of the files.
_SCHEMA = "work_precision"
_CURVE = ("subject", "name", "type", "integrator", "end")
_SETTING = (*_CURVE, "steps", "dt_text")
_FIT = (*_CURVE, "planned", "error")
_TIMES = ("seconds", "median_s", "spread_s", "repeats", "noise_floor", "on_front")


@dataclass(frozen=True)
class WorkPrecision:
    """`rows` are the measured settings, each with its times where it was timed; `untold` counts times of no setting.

    What was run to several ends is told apart by its name; `case` keeps the name that the program knows.
    """

    rows: tuple
    fits: tuple
    bits: dict
    untold: int


def _keyed(path, what, names):
    """{key: record} of a file, none where it is not there; each key stands once."""
    seen, found = {}, {}
    if path.exists():
        for where, record in reading.read_lines(path, _SCHEMA):
            if record["what"] != what:
                raise InvalidInput(f"{where}: what: '{record['what']}' is no '{what}'")
            key = tuple(record.get(name) for name in names)
            if key in seen:
                shown = " ".join(str(part) for part in key if part is not None)
                raise InvalidInput(
                    f"{where}: {shown}: second record; first {seen[key]}"
                )
            seen[key] = where
            found[key] = record
    return found


def _with_ends(records, several):
    """The records, those of what was run to several ends with the end in the name."""
    return tuple(
        {**record, "name": f"{record['name']}_{record['end']}"}
        if (record["subject"], record["name"]) in several
        else record
        for record in records
    )


def _of_several_ends(rows):
    ends = {}
    for row in rows:
        ends.setdefault((row["subject"], row["name"]), set()).add(row.get("end"))
    return {key for key, found in ends.items() if len(found) > 1}


def are_in(directory):
    """Whether a directory has a line of a setting."""
    return reading.has_records(directory / FILE)


def load(directory, context):
    """Read and validate; each setting stands once, timed or not."""
    measured = _keyed(directory / FILE, "work_precision", _SETTING)
    timed = _keyed(directory / TIMING_FILE, "work_precision_timing", _SETTING)
    fits = _keyed(directory / FITS_FILE, "work_precision_fit", _FIT)
    rows = [
        {**row, "case": row["name"], **{n: timed.get(key, {}).get(n) for n in _TIMES}}
        for key, row in measured.items()
    ]
    several = _of_several_ends(rows)
    bits = {
        entry["token"]: entry["significand_bits"] for entry in context.get("types", ())
    }
    untold = len(set(timed) - set(measured))
    return WorkPrecision(
        _with_ends(rows, several), _with_ends(fits.values(), several), bits, untold
    )
