"""Reads the records' numbers (number, "inf" or null) and prints them short for people."""
import math
import re

INFINITE = math.inf
_HEXFLOAT = re.compile(r"^([+-]?0[xX][0-9a-fA-F]*\.?[0-9a-fA-F]*)([pP@].*)?$")


def measured(value):
    """A record's number: int, float, inf for "inf", None for null."""
    return INFINITE if value == "inf" else value


def as_record(value):
    """The way back: what JSON can hold."""
    return "inf" if value == INFINITE else value


def larger(left, right):
    """True when `left` is a larger error than `right`; null is below everything."""
    if left is None:
        return False
    return right is None or left > right


def log10(value):
    """log10 that also takes integers beyond a double's range, 0 (-inf) and inf."""
    if value == 0:
        return -INFINITE
    return math.log10(value)


def _scientific(value, digits):
    exponent = math.floor(log10(value))
    if isinstance(value, int) and exponent > 300:
        mantissa = value / 10**exponent
        text = f"{mantissa:.{digits - 1}f}"
        if float(text) >= 10:
            text, exponent = f"{1:.{digits - 1}f}", exponent + 1
        return f"{text}e{exponent}"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def short_ulp(value):
    """An error in ULP in at most seven characters: 0.554, 12.3, 5.34e4, inf, - for null."""
    if value is None:
        return "-"
    if value == INFINITE:
        return "inf"
    if value == 0:
        return "0"
    # Limits are on the printed value: 0.9996 must not become a four-digit 1.000 beside 1.00.
    for upper, decimals in ((0.9995, 3), (9.995, 2), (99.95, 1), (9999.5, 0)):
        if value < upper:
            if value < 0.001:
                break
            return f"{value:.{decimals}f}"
    return _scientific(value, 3)


def short_distance(value):
    """An integer distance: whole up to 99999, then three digits and an exponent."""
    if value is None:
        return "-"
    if value == INFINITE:
        return "inf"
    if value < 100000:
        return f"{int(value)}" if value == int(value) else f"{value:.3g}"
    return _scientific(value, 3)


def exact_text(value):
    """A number with all its digits, for CSV; empty for null."""
    if value is None:
        return ""
    if value == INFINITE:
        return "inf"
    return repr(value)


def signed(value):
    """A number of a scene's record: as `measured`, but "-inf" and "nan" may occur too."""
    return float(value) if isinstance(value, str) else value


def short_real(value):
    """A number of either sign with six digits: -0.345608, 2.69160, 4.133e-9."""
    if value is None:
        return "-"
    if not math.isfinite(value):
        return str(float(value))
    if value == int(value) and abs(value) < 1e6:
        return str(int(value))
    if 1e-4 <= abs(value) < 1e6:
        return f"{value:.6g}"
    mantissa, exponent = f"{value:.5e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def rough(value):
    """A number that another run would not give: three digits."""
    if value is None or not math.isfinite(value):
        return short_real(value)
    if 1e-4 <= abs(value) < 1e6:
        return short_real(float(f"{value:.3g}"))
    return _scientific(value, 3) if value else "0"


def cell_of_map(value):
    """An error in ULP as short as in a cell of a heat map: of large and tiny ones a digit or two."""
    if value is None or value in (0, INFINITE) or 0.001 <= value < 9999.5:
        return short_ulp(value)
    return _scientific(value, 2 if 1 < value < 1e5 else 1)


def short_hexfloat(text, digits):
    """A hexfloat with its mantissa cut to `digits` characters after the prefix, `...` where it was cut."""
    found = _HEXFLOAT.match(text)
    if not found:
        return text if len(text) <= digits + 12 else text[: digits + 9] + "..."
    mantissa, exponent = found.group(1), found.group(2) or ""
    sign = len(mantissa) - len(mantissa.lstrip("+-"))
    keep = sign + len("0x1.") + digits
    if len(mantissa) <= keep + len("..."):
        return mantissa + exponent
    return mantissa[:keep] + "..." + exponent


def short_arguments(arguments, digits=10):
    """Several hexfloats, each cut the shorter the more there are."""
    each = max(4, digits // max(1, len(arguments)))
    return ", ".join(short_hexfloat(text, each) for text in arguments)
