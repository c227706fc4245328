"""Errors of arrays of results."""
import ctypes

import numpy as np

from ulpgate._library import LIBRARY, arity, check

_TYPES = {np.dtype(np.float32): b"float", np.dtype(np.float64): b"double"}
if np.dtype(np.longdouble).itemsize > 8:
    _TYPES[np.dtype(np.longdouble)] = b"long double"


def type_of(dtype):
    """The library's name of a NumPy type; TypeError for others than float32, float64 and longdouble."""
    try:
        return _TYPES[np.dtype(dtype)]
    except KeyError:
        raise TypeError(
            f"ulpgate: errors are measured in float32, float64 and longdouble, not in {np.dtype(dtype)}"
        ) from None


def _points(got, function, args):
    """(results, arguments side by side): contiguous, of the type of the results, of one shape."""
    got = np.asarray(got)
    if got.dtype not in _TYPES:
        type_of(got.dtype)
    wanted = arity(function)
    if len(args) != wanted:
        raise TypeError(
            f"ulpgate: {function} takes {wanted} argument{'s' if wanted > 1 else ''}, found {len(args)}"
        )
    exact = [np.asarray(a) for a in args]
    columns = [a.astype(got.dtype) for a in exact]
    for given, column in zip(exact, columns):
        # A rounded argument would be another question.
        same = (column == given) | ((column != column) & (given != given))
        if not np.all(same):
            raise ValueError(
                f"ulpgate: an argument is no number of {got.dtype}: give arguments of the type of the results"
            )
    columns = np.broadcast_arrays(got, *columns)
    table = np.stack([np.ravel(c) for c in columns[1:]], axis=1)
    return np.ascontiguousarray(np.ravel(columns[0])), np.ascontiguousarray(table)


def ulp_errors(got, function, *args):
    """The error in ULP of each result of `function` at `args`; inf where a result is of another kind than the exact value.

    Of the shape that `got` and `args` have together. Results and arguments are float32, float64 or longdouble.
    """
    results, table = _points(got, function, args)
    errors = np.empty(results.size)
    check(
        LIBRARY.ulpgate_ulp_errors(
            str(function).encode(),
            type_of(results.dtype),
            table.ctypes.data,
            results.ctypes.data,
            results.size,
            errors.ctypes.data,
            None,
        )
    )
    return errors.reshape(np.broadcast_shapes(np.shape(got), *map(np.shape, args)))


def assert_max_ulp(got, function, *args):
    """assert_max_ulp(got, "sin", x, limit): AssertionError where a result errs by more than `limit` ULP.

    The text has the worst point: both values, the exact one, the condition number and its index.
    """
    *args, limit = args
    results, table = _points(got, function, args)
    errors = np.ravel(ulp_errors(got, function, *args))
    if errors.size == 0:
        raise AssertionError("ulpgate: there are no results to judge")
    beyond = ~(errors <= limit)
    if not beyond.any():
        return
    worst = int(np.argmax(np.where(np.isnan(errors), np.inf, errors)))
    text = ctypes.create_string_buffer(4096)
    point = np.ascontiguousarray(table[worst])
    value = np.ascontiguousarray(results[worst : worst + 1])
    check(
        LIBRARY.ulpgate_describe_call(
            type_of(results.dtype),
            value.ctypes.data,
            str(function).encode(),
            point.ctypes.data,
            float(limit),
            None,
            text,
            len(text),
        )
    )
    raise AssertionError(
        f"{function}: {int(beyond.sum())} of {errors.size} results err by more than {limit:g} ULP, the worst at index {worst}: "
        + text.value.decode()
    )
