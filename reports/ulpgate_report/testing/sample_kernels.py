"""Makes synthetic records of kernels for the tests; `python3 -m ulpgate_report.testing.sample_kernels DIR`."""
import json
import sys
from pathlib import Path

from ulpgate_report.testing import sample_records
from ulpgate_report.testing.sample_records import PLAN, TYPES, share

STRATA = ("typical", "touching", "ratio")
# Kernel, inputs, outputs; each with its number of components.
KERNELS = (
    (
        "sphere_sphere",
        {"x1": 3, "r1": 1, "x2": 3, "r2": 1},
        {"overlap": 1, "normal": 3},
    ),
    ("body_energy", {"mass": 1, "velocity": 3}, {"kinetic": 1}),
)


def _listed(quantities):
    return [{"name": n, "components": c} for n, c in quantities.items()]


def context(types=TYPES):
    """A complete context.json of kernels."""
    found = sample_records.context(types=types, strata=STRATA)
    del found["functions"]
    found["kernels"] = [
        {"name": name, "inputs": _listed(inputs), "outputs": _listed(outputs)}
        for name, inputs, outputs in KERNELS
    ]
    return found


def record(kernel, quantity, inputs, type_row, stratum):
    """One line: the overlap of touching spheres is ill-conditioned, a float's energy unstable at extreme ratios."""
    token, bits = type_row[0], type_row[-1]
    key = (kernel, quantity, token, stratum)
    over = 0.6 + share(*key)
    condition = 1.0 + share("condition", *key)
    if quantity == "overlap" and stratum == "touching":
        condition = 2.0**bits
    unstable = key == ("body_energy", "kinetic", "float", "ratio")
    over = 6.1e4 if unstable else over
    base = sample_records.record(
        {"name": kernel, "arity": sum(inputs.values()), "class": "kernel"},
        quantity,
        type_row,
        stratum,
        samples=200,
    )
    del base["oracle"], base["max_ulp_over_condition"]
    ulp = over * condition * (300 if quantity == "normal" else 1)
    return {
        **base,
        "implementation": "ulpgate",
        "max_ulp": ulp,
        "max_float_distance": float(int(ulp + 0.5)),
        "max_normwise": over * condition,
        "normwise_argmax": base["argmax"][::-1],
        "normwise_index": 3,
        "condition": condition,
        "max_normwise_over_condition": over,
        "verdict": "unstable" if unstable else "stable",
        "plan": PLAN,
    }


def records(types=TYPES):
    """All lines, sorted as the program writes them."""
    found = [
        record(kernel, quantity, inputs, type_row, stratum)
        for kernel, inputs, outputs in KERNELS
        for quantity in outputs
        for type_row in types
        for stratum in STRATA
    ]
    keys = ("function", "part", "type", "stratum")
    return sorted(found, key=lambda one: tuple(one[key] for key in keys))


def write(directory, lines, run_context=None):
    """Write the files of a run."""
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    text = json.dumps(run_context or context()) + "\n"
    (directory / "context.json").write_text(text, "utf-8")
    text = "".join(json.dumps(line) + "\n" for line in lines)
    (directory / "kernels.jsonl").write_text(text, "utf-8")
    return directory


if __name__ == "__main__":
    write(sys.argv[1], records())
