"""What the names of outcomes that no number of ULP describes mean, in words."""

_WORDS = {
    "nan": "gives NaN where there is a value",
    "not_nan": "gives a value where there is none",
    "inf": "gives a wrong infinity",
    "zero_sign": "gives a zero with the wrong sign",
    "overflow_spurious": "gives infinity where the result is in range",
    "overflow_missed": "gives a number where the result is out of range",
    "underflow_spurious": "gives zero where the result is in range",
    "nonzero_for_zero": "gives a number where the result is zero",
    "exception": "throws an exception",
    "crash": "crashes",
    "hang": "does not end",
    "not_a_function": "gives another result on another call",
    "lane_dependent": "gives another result beside other lanes",
    "environment": "leaves a changed floating-point environment",
}


def says(outcome):
    """What a function with this outcome does."""
    return _WORDS.get(outcome, "gives " + outcome.replace("_", " "))


def explained(names):
    """A sentence that explains these names in a caption, each once; nothing without names."""
    told = ", ".join(f"{name} ({says(name)})" for name in dict.fromkeys(names))
    return f" Kinds: {told}." if told else ""
