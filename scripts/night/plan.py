"""Options of a night, its plan and the worst cases that it adds to."""

import argparse
import difflib
import json
import os
import platform
import shutil
import time

from jobs import SIZES
from night_common import BAD_INPUT, ROOT, Failure, whole, write_aside
from status import stamp


def hours(text):
    try:
        value = float(text)
    except ValueError:
        value = -1
    if not 0 < value <= 10000:
        raise argparse.ArgumentTypeError(
            f"'{text}': a number of hours above 0 is wanted"
        )
    return value


def options_of(words, doc):
    p = argparse.ArgumentParser(
        prog="ci/nightly",
        description=doc,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    today = time.strftime("%Y-%m-%d", time.gmtime())
    p.add_argument(
        "--out",
        default=str(ROOT / "out/nightly" / today),
        metavar="DIR",
        help="default out/nightly/<day>",
    )
    p.add_argument(
        "--hours",
        type=hours,
        metavar="H",
        help="ends after that time (default: when all is done)",
    )
    p.add_argument("--resume", action="store_true", help="go on with the night in DIR")
    p.add_argument(
        "--size",
        choices=sorted(SIZES),
        default="night",
        help="small: less than a minute, to try it",
    )
    p.add_argument(
        "--types", default="all", metavar="LIST", help="default all that were built"
    )
    p.add_argument("--seed", type=int, metavar="N", help="default: the day as YYYYMMDD")
    p.add_argument(
        "--threads",
        type=whole(1),
        default=os.cpu_count() or 1,
        metavar="N",
        help="default: one a core",
    )
    p.add_argument(
        "--history",
        metavar="FILE",
        help="puts every finished job's records into this SQLite file (`ulpgate history`)",
    )
    p.add_argument(
        "--list", action="store_true", help="print the jobs in their order, and end"
    )
    program = ROOT / "build/release/harness/app/ulpgate"
    p.add_argument(
        "--ulpgate",
        default=str(program),
        metavar="PROGRAM",
        help="default build/release/harness/app/ulpgate",
    )
    options = p.parse_args(words)
    if options.seed is not None and not 0 <= options.seed < 1 << 63:
        raise Failure(
            BAD_INPUT, f"--seed {options.seed}: a number from 0 to 2^63 - 1 is wanted"
        )
    found = shutil.which(options.ulpgate)
    if found is None:
        raise Failure(
            BAD_INPUT,
            f"no program {options.ulpgate}; build first: cmake --preset release && cmake --build --preset release",
        )
    options.ulpgate = os.path.abspath(found)
    return options


def machine():
    """What an estimate holds for."""
    return f"{platform.node()} {platform.machine()} {os.cpu_count()} cores"


def plan_of(options, out):
    """The night's plan: read where it is gone on with, else made and written."""
    file = out / "night.json"
    if options.resume and file.exists():
        try:
            plan = json.loads(file.read_text())
            plan = {
                key: plan[key] for key in ("seed", "size", "types", "machine", "began")
            }
        except (ValueError, KeyError, TypeError) as e:
            raise Failure(BAD_INPUT, f"{file}: not the plan of a night: {e!r}")
        given = {
            "seed": options.seed,
            "size": options.size if options.size != "night" else None,
        }
        given["types"] = None if options.types == "all" else options.types
        for key, value in given.items():
            if value is not None and value != plan[key]:
                raise Failure(
                    BAD_INPUT,
                    f"--{key} {value}: the night in {out} has {plan[key]}; go on without it",
                )
        if not (out / "known_cases").is_dir():
            raise Failure(
                BAD_INPUT,
                f"{out}: known_cases is gone, which its records rest on; begin another night",
            )
        return plan
    if file.exists():
        raise Failure(
            BAD_INPUT,
            f"{out} holds a night; give --resume to go on with it, or another --out",
        )
    plan = {
        "seed": int(time.strftime("%Y%m%d", time.gmtime()))
        if options.seed is None
        else options.seed,
        "size": options.size,
        "types": options.types,
        "machine": machine(),
        "began": stamp(time.time()),
    }
    out.mkdir(parents=True, exist_ok=True)
    copy_worst_cases(out / "known_cases")
    copy_worst_cases(out / "worst_cases")
    write_aside(file, json.dumps(plan, indent=1) + "\n")
    return plan


def copy_worst_cases(place):
    place.mkdir(exist_ok=True)
    for file in sorted((ROOT / "ci/worst_cases").glob("*.txt")):
        write_aside(place / file.name, file.read_text())


def write_patch(out):
    """What the searches of the night add to ci/worst_cases, for `git apply`; returns how many lines."""
    lines = []
    for file in sorted((out / "worst_cases").glob("*.txt")):
        before = ROOT / "ci/worst_cases" / file.name
        name = f"ci/worst_cases/{file.name}"
        old = before.read_text().splitlines(keepends=True) if before.exists() else []
        new = file.read_text().splitlines(keepends=True)
        lines += difflib.unified_diff(
            old, new, f"a/{name}" if old else "/dev/null", f"b/{name}"
        )
    write_aside(out / "worst_cases.patch", "".join(lines))
    return sum(line.startswith("+") and not line.startswith("+++") for line in lines)
