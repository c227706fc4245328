"""Says whether records come from the platform that the budgets belong to: its C library and its Boost.

budget_platform.py BUDGETS RECORDS exits 0 without a word where they do, and with 1 and a sentence where not.
"""

import json
import pathlib
import sys


def series(version: str, length: int) -> str:
    """The leading numbers of a version: 1.81.0 is of the series 1.81."""
    return ".".join(version.split(".")[:length])


def difference(budgets: pathlib.Path, records: pathlib.Path) -> str:
    """Why the budgets are not of the records' platform; empty where they are."""
    wanted = dict(
        line.split() for line in (budgets / "platform").read_text().splitlines()
    )
    libraries = json.loads((records / "context.json").read_text())["libraries"]
    found = {
        name: series(libraries[name], len(version.split(".")))
        for name, version in wanted.items()
    }
    if found == wanted:
        return ""
    of_budgets, of_records = (
        " / ".join(f"{name} {version}" for name, version in platform.items())
        for platform in (wanted, found)
    )
    return f"budgets of {of_budgets}, this is {of_records}"


if __name__ == "__main__":
    sentence = difference(*map(pathlib.Path, sys.argv[1:3]))
    if sentence:
        print(sentence)
        sys.exit(1)
