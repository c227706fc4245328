"""Exact values."""
import ctypes
import fractions

from ulpgate._library import LIBRARY, check


def _text(x):
    """A number as text that names it exactly: text as it stands, floats in hexadecimal, mpmath's by their significand."""
    if isinstance(x, str):
        return x
    if isinstance(x, int):
        return str(x)
    if hasattr(x, "_mpf_"):  # mpmath
        sign, significand, exponent, _ = x._mpf_
        if significand == 0 and exponent != 0:
            return str(x).strip("+")  # inf and nan
        return f"{'-' if sign else ''}0x{int(significand):x}p{exponent}"
    if isinstance(x, fractions.Fraction):
        if x.denominator & (x.denominator - 1):
            raise ValueError(
                f"ulpgate: {x} is no binary number; give it as text with the digits wanted"
            )
        return f"{'-' if x < 0 else ''}0x{abs(x.numerator):x}p{1 - x.denominator.bit_length()}"
    if (
        hasattr(x, "dtype") and x.dtype.itemsize > 8
    ):  # longdouble: the sum of two doubles
        high = float(x)
        return _text(
            fractions.Fraction(high) + fractions.Fraction(float(x - x.dtype.type(high)))
        )
    return float(x).hex()


def exact(function, *args):
    """exact("tgamma", x, digits): the value as text of so many digits; an mpmath number where an argument is one.

    Arguments are text ("0.1" is a tenth), int, float, NumPy's or mpmath's numbers.
    """
    *args, digits = args
    words = [_text(x).encode() for x in args]
    text = ctypes.create_string_buffer(int(digits) + 64)
    array = (ctypes.c_char_p * len(words))(*words)
    check(
        LIBRARY.ulpgate_exact(
            str(function).encode(), array, len(words), int(digits), text, len(text)
        )
    )
    value = text.value.decode()
    for x in args:
        if hasattr(x, "_mpf_"):
            with x.context.workdps(int(digits)):
                return x.context.mpf(value)
    return value
