"""The order of the types where no context gives it."""
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
