"""Makes synthetic lines of stress.jsonl for the tests; `python3 -m ulpgate_report.testing.sample_stress DIR`."""
import json
import math
import sys
from pathlib import Path

from ulpgate_report.testing.sample_records import TYPES, share
from ulpgate_report.testing.sample_scenes import context

# Kind, name, forms, condition.
CASES = (
    ("formula", "rump_1988", ("naive",), 3.8e37),
    ("formula", "one_minus_cos_over_x2", ("naive", "stable"), 1.0),
    ("formula", "quadratic_smaller_root", ("naive", "stable"), 1.0),
    ("formula", "variance_far_from_zero", ("one_pass", "two_pass", "welford"), 2e17),
    ("formula", "wilkinson_root_14", ("horner",), 5.4e13),
    ("trajectory", "robertson", ("radau_iia_3", "radau_iia_5", "rk4"), 12.0),
    ("trajectory", "henon_heiles_chaotic", ("leapfrog", "yoshida6"), 1e22),
    ("trajectory", "kepler", ("leapfrog", "pefrl", "gauss_6"), 140.0),
    ("state", "coincident_centres", ("",), 1.0),
    ("state", "exactly_on_the_friction_cone", ("",), 1e9),
    ("scene", "far_from_the_origin", ("",), 1e6),
    ("metamorphic", "deposition_turned_by_90_degrees", ("",), 1.0),
    ("step_limit", "elastic_pendulum_stiffness_1e12", ("leapfrog",), 1.0),
)
_REFUSED = ("rk4", "coincident_centres")
_WRONG = ("exactly_on_the_friction_cone",)


def _verdict(name, form, condition, unit):
    if form in _REFUSED or name in _REFUSED:
        return "refused"
    if name in _WRONG and unit > 1e-12:
        return "wrong_outcome"
    if form in ("naive", "one_pass") or name == "far_from_the_origin":
        return "unstable"
    if condition * unit > 1:
        return "ill_conditioned" if name != "henon_heiles_chaotic" else "diverged"
    return "ill_conditioned" if condition * unit > math.sqrt(unit) else "stable"


def line(kind, name, form, token, bits, condition=1.0, **changes):
    """One line of stress.jsonl."""
    unit = 2.0**-bits
    verdict = _verdict(name, form, condition, unit)
    known = verdict in ("stable", "ill_conditioned") or form in ("naive", "rk4")
    error = condition * unit * (0.2 + share(name, form, token))
    error *= 1e6 if verdict == "unstable" else 1
    none = verdict == "refused"
    path = "/".join(filter(None, (kind, name, form)))
    found = {
        "what": "stress",
        "kind": kind,
        "case": name,
        "form": form,
        "title": f"{name.replace('_', ' ')}, a case of the tests",
        "type": token,
        "verdict": verdict,
        "expected": verdict if known and not verdict.startswith("ill") else "stable",
        "as_known": known,
        "cause": "cancellation: a property of the formula" if form == "naive" else "",
        "error": None if none else "inf" if verdict == "diverged" else error,
        "stepping_error": 1e-8 if kind == "trajectory" and not none else None,
        "condition": None if none else condition,
        "correct_digits": None if none else max(0.0, -math.log10(min(1.0, error))),
        "roundoff": unit,
        "first_wrong": "step 12, t = 0.5 s" if verdict == "wrong_outcome" else "",
        "why": "centres coincide: no normal" if none else "",
        "figures": {"steps": 1000, "largest_z": 1.99} if kind == "step_limit" else {},
        "reproducer": f"ulpgate stress --cases {path} --types {token}",
    }
    return {**found, **changes}


def lines(types=TYPES, cases=CASES):
    """Lines of every case, form and type."""
    return [
        line(kind, name, form, row[0], row[-1], condition)
        for kind, name, forms, condition in cases
        for form in forms
        for row in types
    ]


def many(count):
    """So many cases of names as long as real ones."""
    kinds = [case[0] for case in CASES]
    return tuple(
        (
            kinds[i % len(kinds)],
            f"{CASES[i % len(CASES)][1]}_{i}",
            CASES[i % len(CASES)][2],
            CASES[i % len(CASES)][3],
        )
        for i in range(count)
    )


def write(directory, rows):
    """Write the files of a run."""
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "context.json").write_text(json.dumps(context()) + "\n", "utf-8")
    text = "".join(json.dumps(row) + "\n" for row in rows)
    (directory / "stress.jsonl").write_text(text, "utf-8")
    return directory


if __name__ == "__main__":
    write(sys.argv[1], lines(cases=many(100)))
