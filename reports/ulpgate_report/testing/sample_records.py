"""Makes a synthetic run for the tests: deterministic, no measurement; `python3 -m ulpgate_report.testing.sample_records DIR`."""
import hashlib
import json
import math
import sys
from pathlib import Path

# Token, C++ type, total bits, decimal places, exponent bits, significand bits.
TYPES = (
    ("float", "float", 32, 6, 8, 24),
    ("double", "double", 64, 15, 11, 53),
    ("long_double", "long double", 80, 18, 15, 64),
    ("float128", "boost float128", 128, 33, 15, 113),
    ("mpfr62", "boost mpfr_float_backend<62>", None, 62, None, 207),
    ("mpfr150", "boost mpfr_float_backend<150>", None, 150, None, 500),
    ("cpp_bin_float62", "boost cpp_bin_float<62>", None, 62, None, 207),
)
STRATA = ("uniform", "stratified", "binades", "edges", "hard", "worst")
PLAN = "0123456789abcdef"
REAL = (
    "add sub mul div fma sqrt cbrt hypot fmod remainder sin cos tan sinh cosh tanh asin acos atanh atan asinh "
    "acosh atan2 log log10 log2 log1p logb exp exp2 expm1 pow erf erfc tgamma lgamma"
).split()
COMPLEX = (
    "csin csinh ccos ccosh ctan ctanh casin cacos catan cexp clog csqrt cpow".split()
)
SPECIAL = "cyl_bessel_j factorial laguerre spherical_harmonic".split()
EXACT = ("fmod", "logb")
ARITY = {"fma": 3, "sin": 1, "cos": 1, "pow": 2, "hypot": 2, "atan2": 2}
TYPICAL_ULP = {"cpp_bin_float62": 120.0, "mpfr62": 0.5, "mpfr150": 0.5}


def share(*key):
    """A number of [0, 1) that depends on the key alone."""
    digest = hashlib.sha256("/".join(map(str, key)).encode()).digest()
    return int.from_bytes(digest[:6], "big") / 2**48


def functions(names=None):
    """The functions of the context, in display order, all or those named."""
    found = []
    for kind, members in (("real", REAL), ("complex", COMPLEX), ("special", SPECIAL)):
        for name in members:
            if names is None or name in names:
                arity = ARITY.get(name, 2 if kind != "real" else 1)
                parts = ["re", "im"] if kind == "complex" else ["value"]
                entry = {"name": name, "class": kind, "arity": arity, "parts": parts}
                found.append({**entry, "domain": ["ALL"] * arity})
    return found


def context(names=None, types=TYPES, strata=STRATA):
    """A complete context.json."""
    fields = "token cpp_type total_bits decimal_places exponent_bits significand_bits"
    entries = [
        {**dict(zip(fields.split(), row)), "reference_bits": 4 * row[-1]}
        for row in types
    ]
    return {
        "tool": {"name": "ulpgate", "version": "0.1.0"},
        "compiler": "g++ 12.2.0",
        "flags": "-O2 -ffp-contract=off",
        "build_type": "Release",
        "libraries": {"boost": "1.81", "mpfr": "4.2.0"},
        "cpu": "synthetic",
        "seed": 42,
        "plan": PLAN,
        "plan_text": "synthetic",
        "shards": ["0/1"],
        "complete": True,
        "threads": 1,
        "samples": 1000,
        "strata": list(strata),
        "types": entries,
        "functions": functions(names),
    }


def _argument(digits, *key):
    digest = hashlib.sha512("/".join(map(str, key)).encode()).hexdigest()
    exponent = int(share(*key) * 40) - 20
    return f"0x1.{digest[:digits]}p{exponent:+d}"


def _buckets(max_ulp, count):
    """Errors spread evenly below the maximum: each bucket down holds 2^(-1/4) of the one above."""
    top = math.ceil(4 * math.log2(max_ulp))
    left, found = count, {}
    for step in range(40):
        here = left if step == 39 else math.ceil(left * (1 - 2**-0.25))
        if here == 0:
            break
        found[top - step] = here
        left -= here
    return sorted([index, number] for index, number in found.items())


def record(entry, part, type_row, stratum, samples=1000):
    """One math record."""
    name, token, bits = entry["name"], type_row[0], type_row[-1]
    key = (name, part, token, stratum)
    widest = TYPICAL_ULP.get(token, 0.6 + 2 * share(name, part))
    widest *= 10 ** (4 * max(0.0, share(name, token) - 0.7)) if widest > 0.5 else 1
    exact = name in EXACT
    max_ulp = 0 if exact else round(widest * (0.6 + 0.4 * share(*key)), 6)
    digits = math.ceil((bits - 1) / 4)
    where = [_argument(digits, *key, i) for i in range(entry["arity"])]
    mismatch = dict.fromkeys(
        "nan not_nan inf zero_sign overflow_spurious overflow_missed underflow_spurious "
        "nonzero_for_zero exception".split(),
        0,
    )
    first = {}
    if stratum == "edges" and share(name, token) > 0.85:
        mismatch["zero_sign"], first["zero_sign"] = 3, ["-0x0p+0"] * entry["arity"]
    judged = samples - sum(mismatch.values())
    buckets = [] if exact else _buckets(max_ulp, judged)
    return {
        "function": name,
        "part": part,
        "type": token,
        "class": entry["class"],
        "implementation": "glibc 2.36",
        "stratum": stratum,
        "samples": samples,
        "planned": samples,
        "seed": 42,
        "max_ulp": max_ulp,
        "argmax": where,
        "argmax_index": int(share(*key) * samples),
        "got": "0x1p+0",
        "exact": "1.00000000000000000001",
        "max_float_distance": math.floor(max_ulp + 0.5),
        "mean_ulp": max_ulp / 3,
        "p50_ulp": max_ulp / 3,
        "p99_ulp": max_ulp * 0.99,
        "ulp_sum": str(max_ulp / 3 * judged),
        "correctly_rounded": int(judged * min(1.0, 0.5 / (max_ulp + 0.01))),
        "judged": judged,
        "histogram": {"exact": judged if exact else 0, "buckets": buckets},
        "mismatch": mismatch,
        "mismatch_first": first,
        "max_ulp_over_condition": max_ulp / (1 + 5 * share("condition", *key)),
        "oracle": {
            "compared": samples // 10,
            "disagreed": 0,
            "max_difference_ulp": 0,
            "argmax": where,
        },
        "reference": "full",
        "reference_bits": 4 * bits,
        "plan": PLAN,
    }


def math_records(run_context, types=TYPES):
    """All records of a context, sorted as `ulpgate math` writes them."""
    found = [
        record(entry, part, type_row, stratum)
        for entry in run_context["functions"]
        for part in entry["parts"]
        for type_row in types
        for stratum in run_context["strata"]
    ]
    keys = ("function", "part", "type", "stratum")
    return sorted(found, key=lambda one: tuple(one[key] for key in keys))


def timing_records(run_context, types=TYPES):
    """A time for each function and type."""
    found = []
    for entry in run_context["functions"]:
        for token, *_, bits in types:
            slow = 1 if bits < 64 else 3 if bits == 64 else bits
            time_ns = round(2 * slow * (1 + 9 * share("time", entry["name"])), 3)
            one = {"what": entry["name"], "type": token, "ns_per_eval": time_ns}
            found.append({**one, "repeats": 5, "batch": 1000})
    return found


def write(directory, run_context, math_lines, timing_lines=()):
    """Write the files of a run; None for the timing leaves that file out."""
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "context.json").write_text(json.dumps(run_context) + "\n", "utf-8")
    files = {"math.jsonl": math_lines, "timing.jsonl": timing_lines}
    for name, lines in files.items():
        if lines is not None:
            text = "".join(json.dumps(line) + "\n" for line in lines)
            (directory / name).write_text(text, "utf-8")
    return directory


def write_sample(directory, names=None):
    """A whole synthetic run."""
    made = context(names)
    return write(directory, made, math_records(made), timing_records(made))


if __name__ == "__main__":
    write_sample(sys.argv[1])
