"""What a caption says of the run that its numbers come from: samples, seed, strata, machine, libraries, command."""
import json
import re

from ulpgate_report.records.errors import InvalidInput

COMMANDS = "commands.json"
# Of a run of several commands the runner notes the first, how many more there are, and where.
_MORE = re.compile(r"(.*?)(?:( and \d+ more in )(\S+))?", re.DOTALL)
_SHARING = {"uniform", "stratified"}
_OF_FUNCTIONS = _SHARING | {"binades", "narrow", "edges", "hard", "worst", "exhaustive"}
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


def _words_of(run, command):
    """What the name of a figure says where it is of this run: the end of the run's name, and what a scene was set to."""
    words = command.split()
    settings = [b for a, b in zip(words, words[1:]) if a == "--set"]
    return [run.partition("/")[2], *(s.replace("=", "-") for s in settings)]


def command_of(commands, run, name):
    """The command that makes the figure or table `name` of a chapter: of several runs that whose words the name has, and
    the longest of them; else what the runner noted of all of them; "" where it noted nothing.
    """
    found = {}
    for one, command in commands.items():
        if one.startswith(run + "/"):
            for word in _words_of(one, command):
                # order_table is of the run `orders`.
                if word and word.removesuffix("s") in name:
                    found[word] = command
    return found[max(found, key=len)] if found else commands.get(run, "")


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


def _drawn(samples, strata):
    """How many samples a stratum has; of functions the two published ones share them, and others have as many as one."""
    shared = isinstance(strata, list) and _SHARING <= set(strata) <= _OF_FUNCTIONS
    if shared:
        return f"{samples // 2} samples in each drawn stratum (uniform and stratified are {samples} together)"
    return f"{samples} samples in each drawn stratum"


def arguments(context):
    """Samples, seed and strata, of what has them."""
    found = []
    samples = context.get("samples")
    if isinstance(samples, int):
        found.append(_drawn(samples, context.get("strata")))
    if "seed" in context:
        found.append(f"seed {_said(context['seed'])}")
    strata = context.get("strata")
    if isinstance(strata, list):
        found.append(f"strata {', '.join(strata)}")
    return ", ".join(found)


def in_code(command):
    """A command as captions mark it; how many more there are is no part of it."""
    first, more, file = _MORE.fullmatch(command).groups()
    return f"`{first}`" + (f"{more}`{file}`" if more else "")


def sentence(context, command):
    """All of it, for the end of a caption."""
    parts = [arguments(context), machine(context)]
    said = "; ".join(filter(None, parts))
    return (f" Made with: {said}." if said else "") + (
        f" Command: {in_code(command)}." if command else ""
    )
