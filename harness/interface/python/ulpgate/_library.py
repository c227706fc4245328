"""libulpgate: found, loaded, and its calls with their types."""
import ctypes
import ctypes.util
import os
from pathlib import Path

_NAME = "libulpgate.so.0.1"


class UlpgateError(Exception):
    """A call that libulpgate refused, with what it said."""


def _candidates():
    named = os.environ.get("ULPGATE_LIBRARY")
    if named:
        yield named
        return
    # PREFIX/lib/python3/dist-packages/ulpgate -> PREFIX/lib
    for parent in Path(__file__).resolve().parents:
        for folder in (parent, parent / "lib"):
            if (folder / _NAME).exists():
                yield str(folder / _NAME)
    yield _NAME


def _load():
    said = []
    for candidate in _candidates():
        try:
            return ctypes.CDLL(candidate)
        except OSError as error:
            said.append(str(error))
    raise ImportError(
        f"ulpgate: {_NAME} is not found ($ULPGATE_LIBRARY names it): {'; '.join(said)}"
    )


LIBRARY = _load()
BATCH = ctypes.CFUNCTYPE(
    ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t
)
_TEXT, _ADDRESS, _SIZE = ctypes.c_char_p, ctypes.c_void_p, ctypes.c_size_t
_CALLS = {
    "ulpgate_version": (_TEXT, []),
    "ulpgate_last_error": (_TEXT, []),
    "ulpgate_outcome_name": (_TEXT, [ctypes.c_int]),
    "ulpgate_arity": (ctypes.c_int, [_TEXT]),
    "ulpgate_ulp_errors": (
        ctypes.c_int,
        [_TEXT, _TEXT, _ADDRESS, _ADDRESS, _SIZE, _ADDRESS, _ADDRESS],
    ),
    "ulpgate_describe_call": (
        ctypes.c_int,
        [
            _TEXT,
            _ADDRESS,
            _TEXT,
            _ADDRESS,
            ctypes.c_double,
            _ADDRESS,
            ctypes.c_char_p,
            _SIZE,
        ],
    ),
    "ulpgate_exact": (
        ctypes.c_int,
        [_TEXT, ctypes.POINTER(_TEXT), _SIZE, ctypes.c_int, ctypes.c_char_p, _SIZE],
    ),
    "ulpgate_test_function": (
        ctypes.c_int,
        [
            _TEXT,
            _TEXT,
            BATCH,
            _ADDRESS,
            ctypes.c_uint64,
            ctypes.c_uint64,
            ctypes.POINTER(ctypes.c_void_p),
        ],
    ),
    "ulpgate_free": (None, [_ADDRESS]),
}
for _name, (_result, _arguments) in _CALLS.items():
    _call = getattr(LIBRARY, _name)
    _call.restype, _call.argtypes = _result, _arguments


def check(code):
    """Raise what the last call of this thread says, unless it succeeded."""
    if code == 0:
        return
    said = LIBRARY.ulpgate_last_error().decode()
    raise (ValueError if code == 2 else UlpgateError)(f"ulpgate: {said}")


def version():
    """Version of the library."""
    return LIBRARY.ulpgate_version().decode()


def arity(function):
    """How many arguments a function takes; ValueError where there is none of that name."""
    found = LIBRARY.ulpgate_arity(str(function).encode())
    if found == 0:
        raise ValueError(f"ulpgate: '{function}' is no function of one real result")
    return found
