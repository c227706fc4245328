"""What is wrong in which library, from the records alone, each with the command that shows it."""
from dataclasses import dataclass

from ulpgate_report.libraries import beside
from ulpgate_report.math import reproducer
from ulpgate_report.records.pendulum_records import HALF_STEP, OWN_REFERENCE
from ulpgate_report.values import numbers, outcomes

# Below this an error of a function is no finding: libraries document no less.
LARGE_ULP = 10.0
# Where a paper has all of them.
FILE = "data/findings.csv"
MASS = "mass=yade"
# At most so many of one library, the worst first; the table of all functions has the others.
MOST = 12


@dataclass(frozen=True)
class Finding:
    """One: the library, the function or symbol, in which type, what was seen, and the command that shows it."""

    library: str
    subject: str
    type: str
    says: str
    command: str
    # What it computes: symbols of one function are told together.
    function: str
    # What stands first in its library: real functions before special and complex ones, then the larger.
    order: tuple


# A result that is no number at all is worse than any wrong one that a double can tell.
_CLASSES = ("real", "special", "complex")


def _version(context, name):
    version = context.get("libraries", {}).get(name)
    return f"{name} {version}" if isinstance(version, str) else name


def library_of(context, row, token):
    """Whose code computes a function in a type."""
    wide = token.startswith(("mpfr", "cpp_bin_float"))
    if row.function_class == "special":
        return _version(context, "Boost") + " (Math)"
    if token == "float128":
        return "libquadmath"
    if not wide:
        return _version(context, "glibc")
    if token.startswith("mpfr") and row.function_class == "real":
        return _version(context, "MPFR") + " through Boost.Multiprecision"
    return _version(context, "Boost") + " (Multiprecision)"


def errs(error):
    """What is said of a function with this largest error."""
    if error == numbers.INFINITE:
        return "errs by more ULP than a double can tell"
    return f"errs by {numbers.short_ulp(error)} ULP"


def _word(outcome):
    return outcomes.says(outcome)


def _at(count):
    return f"at {count} argument{'s' * (count != 1)}"


def _seen(cell):
    parts = []
    weight = 0.0
    if cell.max_ulp is not None and numbers.larger(cell.max_ulp, LARGE_ULP):
        parts.append(errs(cell.max_ulp))
        weight = float(min(cell.max_ulp, 1e300))
    for name, count in cell.mismatch.items():
        parts.append(f"{_word(name)} at {count} of {cell.samples} arguments")
        weight = max(weight, 1e6 * count / cell.samples)
    return parts, weight


def of_functions(combined):
    """Findings of a run of functions; a function of another library is called by its symbol there."""
    first, implementations = {}, {}
    for record in combined.records:
        key = (record["function"], record["part"], record["type"])
        implementations[key] = record["implementation"]
        for name, args in record.get("mismatch_first", {}).items():
            if record["mismatch"].get(name):
                first.setdefault((*key, name), tuple(args))
    found = []
    for (row, token), cell in combined.cells.items():
        parts, weight = _seen(cell)
        if not parts:
            continue
        by_error = cell.max_ulp is not None and numbers.larger(cell.max_ulp, LARGE_ULP)
        args = cell.argmax if by_error else ()
        key = (row.function, row.part, token)
        if not args:
            # What happens at most of the arguments.
            most = max(cell.mismatch, key=cell.mismatch.get)
            args = first.get((*key, most), ())
        library, subject = library_of(combined.context, row, token), row.label
        if reproducer.options_of(combined.context, row.function, token):
            library = beside.without_symbol(implementations[key])
            subject = implementations[key].rpartition(" ")[2]
        command = reproducer.command_of(combined.context, row.function, token, args)
        found.append(
            Finding(
                library,
                subject,
                token,
                "; ".join(parts),
                command if args else "",
                row.label,
                (_CLASSES.index(row.function_class), -weight),
            )
        )
    return found


def _first(claim):
    """The arguments of a result of the wrong kind; of those that depend on other lanes only where there is none else."""
    found = sorted(claim["mismatches"], key=lambda m: m["outcome"] == "lane_dependent")
    return next((m["args"] for m in found if m["args"]), claim["args"])


def of_claims(rows):
    """Findings of documented bounds that do not hold."""
    found = []
    for one in rows:
        if one["holds"]:
            continue
        error = numbers.measured(one["largest_ulp"])
        parts = []
        if error is not None and numbers.larger(error, one["claim_ulp"]):
            parts.append(f"{errs(error)} where {one['claim_ulp']:g} is documented")
        parts += [f"{_word(m['outcome'])} {_at(m['count'])}" for m in one["mismatches"]]
        args = one["args"] if parts and parts[0].startswith("errs") else _first(one)
        library = one["implementation"].split()[0] if one["implementation"] else ""
        command = " ".join(["ulpgate at", one["function"], one["type"], *args])
        found.append(
            Finding(
                library.rsplit("/", 1)[-1],
                one["symbol"],
                one["type"],
                "; ".join(parts),
                f"{command} --library {library.rsplit('/', 1)[-1]} --symbol {one['symbol']}",
                one["function"],
                (0, -float(min(error or 0, 1e300))),
            )
        )
    return found


def beyond(found, documented):
    """Findings of functions without those of which a documented bound says the same."""
    told = {(f.library, f.subject, f.type) for f in documented}
    return [f for f in found if (f.library, f.subject, f.type) not in told]


def _durations(pendulum):
    """{(scene, dt, type): (t_s with the exact mass, t_s with that of YADE)} where both were run."""
    found = {}
    for row in pendulum.correlations:
        if row["against"] in (OWN_REFERENCE, HALF_STEP):
            continue
        variant = row.get("variant", "")
        if variant in ("", MASS):
            key = (row["scene"], str(row["dt"]), row["type"])
            found.setdefault(key, {})[variant] = row
    return {key: of for key, of in found.items() if len(of) == 2}


def of_pendulum(pendulum):
    """A constant good to 16 digits in runs of more: they leave the true solution where double's rounding would."""
    found = []
    for (scene, dt, token), of in _durations(pendulum).items():
        exact, contaminated = of[""]["t_s"], of[MASS]["t_s"]
        if contaminated >= exact or of[MASS]["to_the_end"]:
            continue
        found.append(
            Finding(
                "YADE",
                "mass of the pendulum's nodes",
                token,
                f"takes 4/3 and pi in double on the way to the mass, in every type: at a step of {dt} s a run with that mass stays true to the "
                f"same run in 150 digits (t_s) for {contaminated:.2f} s, one with the exact mass for {exact:.2f} s",
                f"ulpgate scene ladder {scene} --types {token} --set {MASS}",
                "mass",
                (0, contaminated - exact),
            )
        )
    return found


def by_library(findings):
    """[(library, [findings of one function, the worst first], how many functions more)]."""
    grouped = {}
    for one in findings:
        of = grouped.setdefault(one.library, {})
        of.setdefault(one.function, []).append(one)
    found = []
    for library, of in grouped.items():
        functions = [sorted(same, key=lambda f: f.order) for same in of.values()]
        functions.sort(key=lambda same: same[0].order)
        found.append((library, functions[:MOST], max(0, len(functions) - MOST)))
    return found
