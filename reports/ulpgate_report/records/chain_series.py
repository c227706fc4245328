"""Reads the series of a chain of bodies: its first angle, the parts of its energy and how far their sum is off."""
from dataclasses import dataclass

import numpy

from ulpgate_report.records import csv_columns, energy_account, reading

ANGLE = "angle_1_rad"
AVERAGED, RAW = "energy_error_J", "raw_energy_error_J"
_REQUIRED = ("step", "time_s")
# No figure shows more; a run of 16 s has 160 000 instants.
_MOST_POINTS = 2000
MOST_ERRORS = 500


@dataclass(frozen=True)
class ChainSeries:
    """Columns as arrays; what a file does not have is None or left out.

    `angle` (rad) is at even times `angle_times` (s). `parts` (J) are some instants of each part that is ever other than
    0. `errors` has (times, the largest |error| in J of each stretch) of AVERAGED and RAW.
    """

    angle_times: object
    angle: object
    part_times: object
    parts: dict
    errors: dict


def is_chain(path):
    """Whether a series has a column that only chains have."""
    names = reading.first_line(path).split(",")
    return any(name in names for name in (ANGLE, AVERAGED, RAW))


def _even_rows(steps):
    """The rows on the grid of the recording: the first step and the last may stand beside it."""
    if len(steps) < 3:
        return numpy.ones(len(steps), dtype=bool)
    gaps = numpy.diff(steps)
    gaps = gaps[gaps > 0]
    stride = numpy.median(gaps) if len(gaps) else 1
    return steps % stride == 0


def largest_of_stretches(times, values, most=MOST_ERRORS):
    """(times, largest |value|) of at most `most` stretches; what is not finite is passed over."""
    values = numpy.abs(values)
    kept = numpy.isfinite(values) & numpy.isfinite(times)
    times, values = times[kept], values[kept]
    size = max(1, -(-len(times) // most))
    starts = numpy.arange(0, len(times), size)
    places = [int(s + numpy.argmax(values[s : s + size])) for s in starts]
    return times[places], values[places]


def _parts(columns):
    account = energy_account.parts(columns)
    return {name: values for name, values in account.items() if numpy.any(values)}


def read(path):
    """The series of a file; a refusal names file and line."""
    lists = csv_columns.read(path, _REQUIRED)
    columns = {name: numpy.array(values, float) for name, values in lists.items()}
    times, even = columns["time_s"], _even_rows(columns["step"])
    # Before the first step there is no account: its velocities are those of a step's two halves.
    begun = columns["step"] > 0
    shown = numpy.flatnonzero(begun)
    if len(shown) > _MOST_POINTS:
        # Evenly, the first and the last among them.
        shown = shown[numpy.linspace(0, len(shown) - 1, _MOST_POINTS).astype(int)]
    parts = _parts(columns)
    return ChainSeries(
        angle_times=times[even] if ANGLE in columns else None,
        angle=columns[ANGLE][even] if ANGLE in columns else None,
        part_times=times[shown],
        parts={name: values[shown] for name, values in parts.items()},
        errors={
            name: largest_of_stretches(times[begun], columns[name][begun])
            for name in (AVERAGED, RAW)
            if name in columns
        },
    )
