"""Functions held over strata."""
import ctypes
import json
from dataclasses import dataclass

import numpy as np

from ulpgate._arrays import type_of
from ulpgate._library import BATCH, LIBRARY, arity, check


@dataclass(frozen=True)
class Found:
    """What was found of a function: `rows` has a dict for each stratum, as the C interface describes it."""

    rows: tuple

    @property
    def worst(self):
        """The row of the largest error; None where nothing could be judged."""
        judged = [row for row in self.rows if row["max_ulp"] is not None]
        return max(judged, key=lambda row: row["max_ulp"], default=None)

    @property
    def max_ulp(self):
        """The largest error in ULP; inf where a result is of another kind than the exact value."""
        if self.mismatches:
            return float("inf")
        return self.worst["max_ulp"] if self.worst else float("nan")

    @property
    def at(self):
        """The arguments of the largest error, hexadecimal."""
        return tuple(self.worst["argmax"]) if self.worst else ()

    @property
    def mismatches(self):
        """Results of another kind, by kind."""
        found = {}
        for row in self.rows:
            for kind, count in row["mismatch"].items():
                found[kind] = found.get(kind, 0) + count
        return found

    def __str__(self):
        lines = [
            f"{row['stratum']:<11} {row['samples']:>8} samples, largest error {row['max_ulp']} ULP at {' '.join(row['argmax'])}"
            + "".join(f", {count} {kind}" for kind, count in row["mismatch"].items())
            for row in self.rows
        ]
        return "\n".join(lines)


def test(function, as_, dtype=np.float64, samples=20000, seed=1):
    """Hold `function`, which takes arrays of `dtype` and gives one, to the function named `as_`, over the strata of ulpgate.

    The same seed gives the same arguments and, of the same code, the same rows.
    """
    dtype = np.dtype(dtype)
    count_of_arguments = arity(as_)
    raised = []

    def evaluate(_, args, results, count):
        try:
            size = count * count_of_arguments * dtype.itemsize
            table = np.frombuffer((ctypes.c_char * size).from_address(args), dtype)
            columns = np.ascontiguousarray(table.reshape(count, count_of_arguments).T)
            with np.errstate(all="ignore"):
                values = np.asarray(function(*columns))
            if values.shape != (count,) or values.dtype != dtype:
                raise TypeError(
                    f"ulpgate: {as_}: the function gives {values.dtype} of shape {values.shape}, "
                    f"not {dtype} of shape {(count,)}"
                )
            values = np.ascontiguousarray(values)
            ctypes.memmove(results, values.ctypes.data, values.nbytes)
            return 0
        except (
            BaseException
        ) as error:  # noqa: BLE001  (it goes on behind the library's call)
            raised.append(error)
            return 1

    text = ctypes.c_void_p()
    code = LIBRARY.ulpgate_test_function(
        str(as_).encode(),
        type_of(dtype),
        BATCH(evaluate),
        None,
        samples,
        seed,
        ctypes.byref(text),
    )
    if raised:
        raise raised[0]
    check(code)
    try:
        rows = json.loads(ctypes.string_at(text.value))
    finally:
        LIBRARY.ulpgate_free(text)
    return Found(tuple(rows))


# pytest would take it for a test of its own.
test.__test__ = False
