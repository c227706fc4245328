"""What a caption says of the run that its numbers come from: samples, seed, strata, machine, libraries, command."""
import json

from ulpgate_report.records.errors import InvalidInput

COMMANDS = "commands.json"
# Of all that a context names, what decides the last bits of a result.
_NAMED = ("glibc", "Boost", "MPFR", "GMP", "MPC", "Eigen")


def commands_of(runs):
    """{run: command line} as the runner noted them; {} where it noted none."""
    path = runs / COMMANDS
    if not path.exists():
        return {}
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise InvalidInput(f"{path}: {error}") from error
    if not isinstance(found, dict):
        raise InvalidInput(f"{path}: an object of commands by run is wanted")
    return found


def _said(value, shown=str):
    """Of a suite the different values of its runs."""
    if isinstance(value, dict):
        return " and ".join(dict.fromkeys(shown(one) for one in value.values()))
    return shown(value)


def _libraries(found):
    if any(isinstance(one, dict) for one in found.values()):
        return " and ".join(dict.fromkeys(map(_libraries, found.values())))
    return ", ".join(f"{name} {found[name]}" for name in _NAMED if name in found)


def machine(context):
    """Processor, compiler and libraries."""
    parts = [_said(context.get(key, "")) for key in ("cpu", "compiler")]
    return ", ".join(filter(None, [*parts, _libraries(context.get("libraries", {}))]))


def arguments(context):
    """Samples, seed and strata, of what has them."""
    found = []
    samples = context.get("samples")
    if isinstance(samples, int):
        found.append(f"{samples} samples in each drawn stratum")
    if "seed" in context:
        found.append(f"seed {_said(context['seed'])}")
    strata = context.get("strata")
    if isinstance(strata, list):
        found.append(f"strata {', '.join(strata)}")
    return ", ".join(found)


def sentence(context, command):
    """All of it, for the end of a caption."""
    parts = [arguments(context), machine(context)]
    said = "; ".join(filter(None, parts))
    return (f" Made with: {said}." if said else "") + (
        f" Command: `{command}`." if command else ""
    )
