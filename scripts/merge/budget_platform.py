"""Says whether records come from a platform that has budgets: the base's C library and Boost, or one with rows of its own.

budget_platform.py BUDGETS RECORDS exits 0 without a word where they do, and with 1 and a sentence where not.  BUDGETS/platform
names the base, BUDGETS/platforms/<key>/ holds what is other on another (harness/app/budgets/platform_budgets.hpp).
"""

import json
import pathlib
import sys


def series(version: str) -> str:
    """The leading numbers of a version: 1.81.0 is of the series 1.81."""
    return ".".join(version.split(".")[:2])


def key(platform: dict[str, str]) -> str:
    """The name of a platform's directory."""
    parts = [f"glibc-{platform['glibc']}", f"boost-{platform['Boost']}"]
    if "instructions" in platform:
        parts.append(platform["instructions"])
    return "_".join(parts)


def words(platform: dict[str, str]) -> str:
    """For people."""
    return " / ".join(f"{name} {value}" for name, value in platform.items())


def platform_of(context: dict) -> dict[str, str]:
    """What records were measured with: without a fused multiply-add the C library has other results."""
    libraries = context["libraries"]
    platform = {name: series(libraries[name]) for name in ("glibc", "Boost")}
    sets = context.get("instruction_sets", "").split()
    if sets and "FMA" not in sets:
        platform["instructions"] = "no-fma"
    return platform


def difference(budgets: pathlib.Path, records: pathlib.Path) -> str:
    """Why the budgets are not of the records' platform; empty where they are."""
    base = dict(
        line.split() for line in (budgets / "platform").read_text().splitlines()
    )
    found = platform_of(json.loads((records / "context.json").read_text()))
    if found == base or (budgets / "platforms" / key(found) / "platform").is_file():
        return ""
    return f"budgets of {words(base)}, this is {words(found)}"


if __name__ == "__main__":
    sentence = difference(*map(pathlib.Path, sys.argv[1:3]))
    if sentence:
        print(sentence)
        sys.exit(1)
