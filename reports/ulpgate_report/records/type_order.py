"""The order and the colours of the types where no context gives them."""
from ulpgate_report.figures import figure_style

KNOWN = (
    "float",
    "double",
    "long_double",
    "float128",
    "mpfr62",
    "mpfr150",
    "cpp_bin_float62",
)


def ordered(tokens):
    """Each token once: the known ones first, in their order, the others by name."""
    found = set(tokens)
    return [t for t in KNOWN if t in found] + sorted(found - set(KNOWN))


def _place(token, tokens):
    others = [t for t in tokens if t not in KNOWN]
    return KNOWN.index(token) if token in KNOWN else len(KNOWN) + others.index(token)


def line_style(token, tokens):
    """(colour, marker) of a type; a known one has the same in every figure."""
    place = _place(token, tokens)
    return figure_style.colour(place), figure_style.marker(place)
