#!/usr/bin/env python3
"""Checks that each room includes only what scripts/rooms.toml lets it, and that files and rooms stay small."""

import pathlib
import re
import sys
import tomllib
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).resolve().parent.parent
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')
SOURCES = {".hpp", ".cpp", ".def", ".in", ".inc"}
TEST_FOLDERS = {"testing", "compile_fail"}
NO_SUBJECT = {"README.md", "CMakeLists.txt"}


@dataclass
class Law:
    floors: list[str]
    most_files: int
    longest_file: int
    # Room -> the names it may include, what these may include among them.
    rooms: dict[str, set[str]]


def read_law(file: pathlib.Path) -> tuple[Law, list[str]]:
    """The law, and what is wrong with it: a room that includes what does not stand before it."""
    data = tomllib.loads(file.read_text())
    rooms: dict[str, set[str]] = {}
    broken = []
    for room, names in data["rooms"].items():
        allowed = set()
        for name in names:
            found = [r for r in rooms if within(r, name)]
            if not found:
                broken.append(
                    f"{file.name}: {room} includes {name}, which does not stand before it"
                )
            for other in found:
                allowed |= {other} | rooms[other]
        rooms[room] = allowed
    law = Law(data["floors"], data["most_files"], data["longest_file"], rooms)
    return law, broken


def within(path: str, name: str) -> bool:
    return path == name or path.startswith(name + "/")


def floor_of(law: Law, path: str) -> str | None:
    return next((f for f in law.floors if within(path, f)), None)


def folder_of(path: str) -> str:
    return path.rpartition("/")[0]


def is_test(path: str) -> bool:
    inside = set(path.split("/")[:-1])
    return path.rpartition(".")[0].endswith("_test") or bool(inside & TEST_FOLDERS)


def may_include(law: Law, file: str, included: str) -> bool:
    here, there = folder_of(file), folder_of(included)
    if here == there or there not in law.rooms and not is_test(included):
        return here == there
    if is_test(file):
        highest = law.floors.index(floor_of(law, file))
        return law.floors.index(floor_of(law, included)) <= highest
    return not is_test(included) and there in law.rooms.get(here, set())


def broken_laws(root: pathlib.Path, law_file: pathlib.Path | None = None) -> list[str]:
    law, broken = read_law(law_file or ROOT / "scripts" / "rooms.toml")
    for floor in law.floors:
        files = sorted(f for f in (root / floor).rglob("*") if f.is_file())
        names = [f.relative_to(root).as_posix() for f in files]
        broken += broken_rooms(law, names)
        for file, name in zip(files, names):
            if file.suffix in SOURCES:
                broken += broken_file(law, name, file.read_text().splitlines())
    return list(dict.fromkeys(broken))


def broken_rooms(law: Law, names: list[str]) -> list[str]:
    """Rooms that the law does not know, that hold too much or that do not say what they are."""
    broken = []
    folders = {folder_of(name) for name in names}
    for folder in sorted(folders):
        content = [n for n in names if folder_of(n) == folder]
        subject = [n for n in content if n.rpartition("/")[2] not in NO_SUBJECT]
        if len(subject) > law.most_files:
            broken.append(f"{folder}: {len(subject)} files, at most {law.most_files}")
        last = folder.rpartition("/")[2]
        if last in TEST_FOLDERS or not subject:
            continue
        if folder not in law.rooms:
            if folder not in law.floors:
                broken.append(f"{folder}: scripts/rooms.toml does not name this room")
        elif f"{folder}/README.md" not in content:
            broken.append(f"{folder}: a README.md says what lives here")
    return broken


def broken_file(law: Law, name: str, lines: list[str]) -> list[str]:
    broken = []
    if len(lines) > law.longest_file:
        broken.append(f"{name}: {len(lines)} lines, at most {law.longest_file}")
    if (not lines or not lines[0].startswith("//")) and not name.endswith(".in"):
        broken.append(f"{name}:1: the first line says what the file is responsible for")
    for number, line in enumerate(lines, 1):
        found = INCLUDE.match(line)
        included = found.group(1) if found else None
        # Other libraries' headers stand on no floor.
        if included is None or floor_of(law, included) is None:
            continue
        if not may_include(law, name, included):
            broken.append(
                f"{name}:{number}: {folder_of(name)} must not include {included}"
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
