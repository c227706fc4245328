#!/usr/bin/env python3
"""Checks that includes run one way: reference <- kernels <- harness/core <- harness/app, and files stay small."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# A room may include itself and what stands before it.
ROOMS = ["reference", "kernels", "harness/core", "harness/app"]
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')
LONGEST_FILE = 400


def room_of(path: str) -> int | None:
    for index, room in enumerate(ROOMS):
        if path.startswith(room + "/"):
            return index
    return None


def broken_laws(root: pathlib.Path) -> list[str]:
    broken = []
    for top in ROOMS:
        for file in sorted((root / top).rglob("*")):
            if file.suffix not in {".hpp", ".cpp", ".def", ".in"} or not file.is_file():
                continue
            name = file.relative_to(root).as_posix()
            here = room_of(name)
            lines = file.read_text().splitlines()
            if len(lines) > LONGEST_FILE:
                broken.append(f"{name}: {len(lines)} lines, at most {LONGEST_FILE}")
            if not lines or not lines[0].startswith("//"):
                if file.suffix != ".in" and file.name != "CMakeLists.txt":
                    broken.append(
                        f"{name}:1: the first line says what the file is responsible for"
                    )
            for number, line in enumerate(lines, 1):
                found = INCLUDE.match(line)
                there = room_of(found.group(1)) if found else None
                if here is not None and there is not None and there > here:
                    broken.append(
                        f"{name}:{number}: {ROOMS[here]} must not include {found.group(1)}"
                    )
    return broken


def main() -> int:
    broken = broken_laws(
        pathlib.Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else ROOT
    )
    for law in broken:
        print(law, file=sys.stderr)
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
