"""Holds the rooms to their law: imports that run one way, folders of a size to survey, a README in each."""
import ast
import sys
import tomllib

PACKAGE = "ulpgate_report"
DATA = "rooms.toml"
_NOT_COUNTED = ("README.md", "__init__.py")


def load(root):
    """The law of a package, from its rooms.toml."""
    return tomllib.loads((root / DATA).read_text("utf-8"))


def _is_test(path):
    return path.name.endswith("_test.py")


def imported(tree):
    """Yield (line, dotted name) of each import; `from a import b` is `a.b`, a relative one starts with a dot."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            module = "." * node.level + (node.module or "")
            yield from ((node.lineno, f"{module}.{a.name}") for a in node.names)


def _refusal(name, room, is_test, law):
    """What is wrong with importing a dotted name, None where nothing is."""
    first, *rest = name.split(".")
    if not first:
        return f"{name} is relative; name the room"
    if first != PACKAGE:
        allowed = [*law["packages"][room], *(law["test_packages"] if is_test else ())]
        if first in sys.stdlib_module_names or first in allowed:
            return None
        return f"{room} may not import the package {first}"
    if len(rest) < 2:
        return f"{name}: import modules of a room, by its name"
    other, module = rest[:2]
    if module.endswith("_test"):
        return f"{name} is a test; what tests share stands in testing"
    allowed = [room, *law["rooms"][room]]
    allowed += law["tests_may_import"] if is_test else ()
    return None if other in allowed else f"{room} may not import {other}"


def _import_breaks(root, room, law, used):
    for path in sorted((root / room).glob("*.py")):
        tree = ast.parse(path.read_text("utf-8"))
        for line, name in imported(tree):
            refusal = _refusal(name, room, _is_test(path), law)
            if refusal:
                yield f"{room}/{path.name}:{line}: {refusal}"
            elif not _is_test(path):
                used.add((room, name.split(".")[name.startswith(f"{PACKAGE}.")]))


def _folder_breaks(root, room, law):
    readme = root / room / "README.md"
    if not readme.is_file():
        yield f"{room}: no README.md"
    elif len(readme.read_text("utf-8").splitlines()) > law["most_readme_lines"]:
        yield f"{room}/README.md: more than {law['most_readme_lines']} lines"
    if not (root / room / "__init__.py").is_file():
        yield f"{room}: no __init__.py"
    folders = [p for p in (root / room).rglob("*") if p.is_dir()]
    for folder in (root / room, *folders):
        if folder.name == "__pycache__":
            continue
        files = [p for p in folder.iterdir() if p.is_file()]
        count = sum(path.name not in _NOT_COUNTED for path in files)
        if count > law["most_files"]:
            where = folder.relative_to(root)
            yield f"{where}: {count} files, more than {law['most_files']}"
        if folder != root / room and any(path.suffix == ".py" for path in files):
            yield f"{folder.relative_to(root)}: modules in a folder that is no room"


def _law_breaks(root, law):
    rooms = list(law["rooms"])
    for index, (room, others) in enumerate(law["rooms"].items()):
        for other in others:
            if other not in rooms[:index]:
                yield f"{DATA}: {room} may import {other}, which is not above it"
    there = {path.parent.name for path in root.glob("*/*.py")}
    for room in sorted(there ^ set(rooms)):
        yield f"{room}: " + ("not in " + DATA if room in there else "no such folder")
    for path in sorted(root.glob("*.py")):
        if path.name not in _NOT_COUNTED:
            yield f"{path.name}: a module in no room"


def _unused(law, used):
    """What the law allows and no file needs: it would let the next one in unseen."""
    for table in ("rooms", "packages"):
        for room, names in law[table].items():
            for name in names:
                if (room, name) not in used:
                    yield f"{DATA}: {room} does not import {name}"


def breaks(root, law):
    """A sentence for each break of the law in the package at `root`."""
    found, used = list(_law_breaks(root, law)), set()
    for room in law["rooms"]:
        if (root / room).is_dir():
            found += _folder_breaks(root, room, law)
            found += _import_breaks(root, room, law, used)
    return found + list(_unused(law, used))
