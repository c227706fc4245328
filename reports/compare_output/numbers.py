"""Numbers as texts hold them: a double and what the text has beyond it.

A text of more digits than a double has (a run in float128 or MPFR) is kept as high + low, two doubles whose sum is off by
at most 2^-106 of the number.  That tells the error of a double, or of a float, from the wide value.
"""
import re
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

# Texts of up to this many digits that came from a double are that double; longer ones may hold more.
_DIGITS_OF_A_DOUBLE = 17
_DECIMAL = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?$")
_HEX = re.compile(
    r"([+-]?)0[xX]([0-9a-fA-F]+)(?:\.([0-9a-fA-F]*))?(?:[pP]([+-]?\d+))?$"
)
_SPECIAL = {"nan", "inf", "infinity"}


@dataclass
class Numbers:
    """Values of a column: high + low, elementwise; low is 0 where high is not finite."""

    high: np.ndarray
    low: np.ndarray

    @staticmethod
    def of_array(array):
        """An array of binary numbers; what a long double has beyond a double is kept."""
        high = np.asarray(array, dtype=np.float64)
        low = np.zeros_like(high)
        if np.issubdtype(array.dtype, np.longdouble) and array.dtype != np.float64:
            finite = np.isfinite(high)
            low[finite] = (array[finite] - high[finite]).astype(np.float64)
        elif np.issubdtype(array.dtype, np.integer):
            # Integers beyond 2^53.
            large = np.abs(high) > 2.0**53
            low[large] = [
                float(int(a) - int(h)) for a, h in zip(array[large], high[large])
            ]
        return Numbers(high, low)

    def __len__(self):
        return len(self.high)

    def take(self, rows):
        return Numbers(self.high[rows], self.low[rows])

    def minus(self, other):
        """The difference where both are finite, NaN elsewhere."""
        with np.errstate(all="ignore"):
            difference = (self.high - other.high) + (self.low - other.low)
        difference[~(np.isfinite(self.high) & np.isfinite(other.high))] = np.nan
        return difference


def is_number(text):
    text = text.strip()
    return bool(
        _DECIMAL.match(text)
        or _HEX.match(text)
        or text.lstrip("+-").lower() in _SPECIAL
    )


def is_integer(text):
    return text.strip().lstrip("+-").isdigit()


def _exact(text):
    """The number that a finite text holds."""
    hexadecimal = _HEX.match(text)
    if not hexadecimal:
        return Fraction(text.lower().replace("d", "e"))
    sign, whole, rest, power = hexadecimal.groups()
    rest = rest or ""
    value = Fraction(int(whole + rest, 16)) * Fraction(2) ** (
        int(power or 0) - 4 * len(rest)
    )
    return -value if sign == "-" else value


def _parsed(text):
    """(high, low) of one text.  What is nearer to 0 than the least double is 0."""
    text = text.strip()
    if text.lstrip("+-").lower() in _SPECIAL:
        return float(text), 0.0
    if _DECIMAL.match(text):
        high = float(text.lower().replace("d", "e"))
        significant = sum(c.isdigit() for c in re.split("[eEdD]", text)[0])
        if np.isfinite(high) and significant <= _DIGITS_OF_A_DOUBLE:
            return high, 0.0
    exact = _exact(text)
    try:
        high = float(exact)
    except OverflowError:
        raise ValueError(f"{text} is beyond the range of a double")
    return high, float(exact - Fraction(high))


def of_texts(texts):
    """Numbers of a column of texts; ValueError names one that is none."""
    pairs = np.array([_parsed(t) for t in texts], dtype=np.float64).reshape(-1, 2)
    return Numbers(pairs[:, 0].copy(), pairs[:, 1].copy())
