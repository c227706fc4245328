"""Errors in ULP from Python: of arrays, of functions, and exact values; over libulpgate by ctypes, without a compiled part.

    import numpy as np, ulpgate

    x = np.linspace(-10, 10, 1001)
    ulpgate.assert_max_ulp(np.sin(x), "sin", x, 4.0)
    found = ulpgate.test(np.exp, as_="exp", dtype=np.float32)
    found.max_ulp, found.at, found.rows
    ulpgate.exact("tgamma", "0.1", 50)

The library is $ULPGATE_LIBRARY, or the libulpgate that the loader finds, or one beside this module's installation.
"""
from ulpgate._arrays import assert_max_ulp, ulp_errors
from ulpgate._exact import exact
from ulpgate._functions import Found, test
from ulpgate._library import UlpgateError, version

__all__ = [
    "Found",
    "UlpgateError",
    "assert_max_ulp",
    "exact",
    "test",
    "ulp_errors",
    "version",
]
__version__ = version()
