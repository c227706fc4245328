"""What of the gate the files changed since a revision can affect, from the build's own dependency files.

    scripts/merge/changed_since.py REV [--build DIR]

Prints one line: `all`, `nothing`, or types and parts, such as `types=float,double parts=math,stress`, and on stderr why.  A
file that no object of the program depends on, and that no test or budget is, affects nothing; whatever is not known for
certain to affect less affects all.  Exit codes: 0, 2 bad usage or no build to ask, 4 git or ninja cannot be run.
"""

import argparse
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Objects of one type -> the parts of the gate whose results they compute.
TYPED = {
    "function_table": {"math"},
    "function_subjects": {"math"},
    "search": {"math"},
    "kernel_subjects": {"kernels"},
    "dem_engine": {"kernels", "scenes", "stress"},
    "formula_engine": {"stress"},
    "stability_engine": {"stress"},
    "trajectory_engine": {"stress", "scenes"},
    "order_engine": {"scenes", "stress"},
    # Several of these in one translation unit.
    "unity_function_of": {"math"},
    "unity_stress_of": {"stress"},
    "unity_integrating_of": {"scenes", "stress"},
}
PARTS = ("math", "kernels", "scenes", "stress")
# What the program does not read while it measures.
HARMLESS = re.compile(
    r"(\.md$|^reports/|_test\.(cpp|py)$|^docs/|^LICENSE$|^\.gitignore$|^\.github/|^\.gitlab-ci\.yml$|^Dockerfile$|/testing/)"
)


class Failure(Exception):
    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


def output_of(*words):
    try:
        done = subprocess.run(words, capture_output=True, text=True, cwd=ROOT)
    except OSError as e:
        raise Failure(4, f"{words[0]} cannot be run: {e}")
    if done.returncode != 0:
        raise Failure(
            2,
            f"`{' '.join(map(str, words))}` ended with {done.returncode}: {done.stderr.strip()}",
        )
    return done.stdout


def changed_files(revision):
    """Files that differ between REV and the tree as it is now, with those that git does not know yet."""
    return sorted(
        set(output_of("git", "diff", "--name-only", revision, "--").splitlines())
        | set(
            output_of("git", "ls-files", "--others", "--exclude-standard").splitlines()
        )
    )


def dependents(build):
    """{file below the root: objects that were compiled from it}, of `ninja -t deps`."""
    found = {}
    obj = None
    for line in output_of("ninja", "-C", str(build), "-t", "deps").splitlines():
        if line.startswith(" "):
            file = (build / line.strip()).resolve()
            if file.is_relative_to(ROOT):
                found.setdefault(str(file.relative_to(ROOT)), set()).add(obj)
        elif ":" in line:
            obj = line.split(":")[0]
    if not found:
        raise Failure(2, f"{build} has no dependencies to read; build first")
    return found


def part_of(obj, types):
    """(type, parts) of an object that computes results of one type; None of any other."""
    name = pathlib.PurePath(obj).name
    for stem, parts in TYPED.items():
        found = re.fullmatch(rf"{stem}_(.+?)(_x[14]\.cpp|\.cpp|_cxx\.cxx)\.o", name)
        if found and found[1] in types:
            return found[1], parts
    return None


def is_of_program(obj):
    return (
        "/tests/" not in obj
        and "_test.dir" not in obj
        and "bench" not in obj
        and not obj.endswith("_test.cpp.o")
    )


def affected(changed, depends, types):
    """('all' or 'nothing' or (types, parts), reasons)."""
    hit_types, hit_parts, reasons = set(), set(), []
    for file in changed:
        if HARMLESS.search(file):
            continue
        objects = [o for o in depends.get(file, ()) if is_of_program(o)]
        if not objects:
            if file in depends:
                continue  # of tests or benchmarks alone
            return "all", [f"{file} is of no object: what it affects is not known"]
        for obj in objects:
            typed = part_of(obj, types)
            if typed is None:
                return "all", [
                    f"{file} goes into {pathlib.PurePath(obj).name[:-2]}, which every part uses"
                ]
            hit_types.add(typed[0])
            hit_parts |= typed[1]
        reasons.append(f"{file} goes into {len(objects)} objects of one type each")
    if not hit_parts:
        return "nothing", reasons or ["no changed file is part of what is measured"]
    # A reference of a type is computed by objects of its name as well: no type is left out that could differ.
    return (hit_types, hit_parts), reasons


def main(words):
    p = argparse.ArgumentParser(
        prog="scripts/merge/changed_since.py",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    p.add_argument("revision", metavar="REV")
    p.add_argument("--build", default=str(ROOT / "build/release"), metavar="DIR")
    options = p.parse_args(words)
    build = pathlib.Path(options.build).resolve()
    if not (build / "build.ninja").exists():
        raise Failure(
            2,
            f"{build} is no build; cmake --preset release && cmake --build --preset release",
        )
    output_of(
        "git", "rev-parse", "--verify", "--quiet", f"{options.revision}^{{commit}}"
    )
    types = built_types(build)
    what, reasons = affected(changed_files(options.revision), dependents(build), types)
    for reason in reasons[:10]:
        print(f"changed since {options.revision}: {reason}", file=sys.stderr)
    if isinstance(what, str):
        print(what)
    else:
        order = [t for t in types if t in what[0]]
        print(
            f"types={','.join(order)} parts={','.join(part for part in PARTS if part in what[1])}"
        )
    return 0


def built_types(build):
    """The types of the build, from the objects that each has."""
    names = []
    for line in output_of(
        "ninja", "-C", str(build), "-t", "targets", "all"
    ).splitlines():
        found = re.search(r"/function_subjects_(\w+)\.cpp\.o:", line)
        if found and found[1] not in names:
            names.append(found[1])
    return names


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except Failure as failure:
        print(f"changed_since: {failure}", file=sys.stderr)
        sys.exit(failure.code)
