"""Mutation run over the numerical rooms: one operator, constant, sign or call changed at a time, and the fast tests asked.

  scripts/mutate --sample 50 --seed 1 --work W                        # goes on where an earlier run of the same log stopped
  scripts/mutate --only 'reference/types/*' --sample 20 --work W
  scripts/mutate --report --work W                                  # what the log holds; runs nothing
  scripts/mutate --list --only 'harness/core/gate/*'                # the mutants themselves

Mutants are taken in an order that the seed decides and edits elsewhere do not change.  They are tried in copies of the
checkout under --work (never in the checkout).  Almost all go into one build, each behind a switch that the environment sets,
and are run against the test cases of scripts/mutation/plan.toml that come by their place, the quick ones first.  Those that
cannot wait for a switch (a constant that a type depends on) are then built one after another and run against all the tests up
to the first that fails.  Outcomes: killed (a test failed, crashed or ran past its limit), not_compiled, same_code (all programs
are the same bytes: the mutant changes nothing), survived.  Survivors that were read and change no result stand in
scripts/mutation/accepted.toml with the reason.

Exit: 0 no survivor but accepted ones, 1 others, 2 bad usage, 3 nothing tried or interrupted, 4 the tests fail without a mutant.
"""

import argparse
import collections
import concurrent.futures
import fnmatch
import hashlib
import json
import pathlib
import queue
import sys
import threading
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from operators import Mutant, find_mutants  # noqa: E402
from together import Together  # noqa: E402
from trial import Plan, Workshop, read_plan  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent


def sources(
    plan: Plan, checkout: pathlib.Path, rooms: list[str], only: list[str]
) -> list[str]:
    found = []
    for room in rooms:
        for file in sorted((checkout / room).rglob("*")):
            name = file.relative_to(checkout).as_posix()
            if not file.is_file() or not name.endswith(tuple(plan.endings)):
                continue
            if any(fnmatch.fnmatch(name, pattern) for pattern in plan.left_out):
                continue
            if not only or any(fnmatch.fnmatch(name, pattern) for pattern in only):
                found.append(name)
    return found


def all_mutants(checkout: pathlib.Path, files: list[str]) -> list[Mutant]:
    return [
        m for name in files for m in find_mutants(name, (checkout / name).read_text())
    ]


def in_order(mutants: list[Mutant], seed: int) -> list[Mutant]:
    return sorted(
        mutants, key=lambda m: hashlib.sha256(f"{seed} {m.key}".encode()).hexdigest()
    )


def read_log(file: pathlib.Path) -> dict[str, dict]:
    """The last word on each mutant; a torn last line is as if it had not been written."""
    entries: dict[str, dict] = {}
    for line in file.read_text().splitlines() if file.is_file() else []:
        try:
            entry = json.loads(line)
        except ValueError:
            continue
        entries[entry["key"]] = entry
    return entries


def append(file: pathlib.Path, entry: dict) -> None:
    """Adds a line, on a line of its own even where a stopped run left a torn one."""
    torn = file.is_file() and file.read_bytes()[-1:] not in {b"", b"\n"}
    with file.open("a") as out:
        out.write(("\n" if torn else "") + json.dumps(entry) + "\n")


def read_accepted(file: pathlib.Path) -> list[dict]:
    accepted = (
        tomllib.loads(file.read_text()).get("accepted", []) if file.is_file() else []
    )
    for entry in accepted:
        if not entry.get("reason", "").strip():
            raise ValueError(
                f"{file}: an accepted mutant of {entry.get('file')} has no reason"
            )
    return accepted


def is_accepted(entry: dict, accepted: list[dict]) -> bool:
    return any(
        all(a[name] == entry[name] for name in ("file", "before", "after"))
        and a.get("nth", entry["nth"]) == entry["nth"]
        for a in accepted
    )


def entry_of(mutant: Mutant) -> dict:
    names = ("key", "file", "line", "column", "operator", "before", "after", "nth")
    return {name: getattr(mutant, name) for name in names}


def report(entries: list[dict], accepted: list[dict]) -> int:
    """Prints counts and open survivors; the number of these."""
    counts = collections.Counter(e["outcome"] for e in entries)
    survivors = [e for e in entries if e["outcome"] == "survived"]
    unread = [e for e in survivors if not is_accepted(e, accepted)]
    for e in unread:
        print(f"survived {e['file']}:{e['line']}:{e['column']} ({e['operator']})")
        print(f"  - {e['before']}\n  + {e['after']}")
    known = len(survivors) - len(unread)
    changing = counts["killed"] + len(unread)
    share = (
        f", {100 * counts['killed'] / changing:.1f} % of those that change a result"
        if changing
        else ""
    )
    print(
        f"{len(entries)} mutants: {counts['killed']} killed{share}; {counts['not_compiled']} did not compile; "
        f"{counts['same_code']} gave the same code; {known} survivors accepted, {len(unread)} not"
    )
    return len(unread)


def say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def try_all(untried: list, trials: list, log: pathlib.Path) -> None:
    """Tries each of `untried` by one of `trials`, as many at once; `untried` holds (mutant, what a trial is called with)."""
    free: queue.Queue = queue.Queue()
    for trial in trials:
        free.put(trial)
    lock = threading.Lock()
    done = 0

    def one(mutant: Mutant, what) -> None:
        nonlocal done
        trial = free.get()
        try:
            entry = entry_of(mutant) | trial(what)
        finally:
            free.put(trial)
        with lock:
            append(log, entry)
            done += 1
            say(
                f"[{done}/{len(untried)}] {entry['outcome']:12} {entry['seconds']:6.1f} s  {mutant.file}:{mutant.line}"
                f"  {entry['by']}"
            )

    with concurrent.futures.ThreadPoolExecutor(len(trials)) as pool:
        running = [pool.submit(one, *item) for item in untried]
        try:
            for future in concurrent.futures.as_completed(running):
                future.result()
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise


def try_together(
    untried: list[Mutant],
    chosen: list[Mutant],
    plan: Plan,
    options: argparse.Namespace,
    work: pathlib.Path,
    log: pathlib.Path,
) -> list[Mutant]:
    """Tries in one build, of all that are chosen, what can be; the others."""
    together = Together(plan, options.checkout, work / "together", options.jobs)
    together.prepare(chosen, say)
    wanted = {m.key for m in untried}
    ready = [w for w in together.ready() if w.mutant.key in wanted]
    others = wanted - {w.mutant.key for w in ready}
    say(f"{len(ready)} mutants in one build, {len(others)} need one of their own")
    try_all([(w.mutant, w) for w in ready], [together.attempt] * options.jobs, log)
    return [m for m in untried if m.key in others]


def try_alone(
    untried: list[Mutant],
    plan: Plan,
    options: argparse.Namespace,
    work: pathlib.Path,
    log: pathlib.Path,
) -> None:
    shops = [
        Workshop(plan, options.checkout, work / str(i))
        for i in range(min(options.jobs, len(untried)))
    ]
    for shop in shops:
        shop.prepare()
    try_all([(m, m) for m in untried], [shop.attempt for shop in shops], log)


def positive(text: str) -> int:
    value = int(text)
    if value < 1:
        raise ValueError
    return value


def arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="scripts/mutate",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--sample",
        type=positive,
        default=30,
        help="mutants to be tried in all, those of the log included (30)",
    )
    parser.add_argument("--seed", type=int, default=1, help="decides the order (1)")
    parser.add_argument("--rooms", help="comma-separated folders instead of the plan's")
    parser.add_argument(
        "--only",
        action="append",
        default=[],
        metavar="GLOB",
        help="only sources whose path matches; repeatable",
    )
    parser.add_argument(
        "--jobs",
        type=positive,
        default=1,
        help="mutants tried at once (1); those that need a build of their own have as many trees",
    )
    parser.add_argument(
        "--alone",
        action="store_true",
        help="builds each mutant on its own, whether it needs that or not",
    )
    parser.add_argument(
        "--work",
        type=pathlib.Path,
        help="folder of the copies, builds and the log (build/mutation)",
    )
    parser.add_argument(
        "--again",
        action="store_true",
        help="tries survivors of the log again: after new tests",
    )
    parser.add_argument(
        "--list", action="store_true", help="prints the mutants in their order and ends"
    )
    parser.add_argument(
        "--report",
        action="store_true",
        help="prints what the log holds of mutants that still exist and ends",
    )
    parser.add_argument(
        "--checkout", type=pathlib.Path, default=HERE.parents[1], help=argparse.SUPPRESS
    )
    parser.add_argument(
        "--plan", type=pathlib.Path, default=HERE / "plan.toml", help=argparse.SUPPRESS
    )
    parser.add_argument(
        "--accepted",
        type=pathlib.Path,
        default=HERE / "accepted.toml",
        help=argparse.SUPPRESS,
    )
    return parser


def main() -> int:
    parser = arguments()
    options = parser.parse_args()
    plan = read_plan(options.plan)
    accepted = read_accepted(options.accepted)
    rooms = options.rooms.split(",") if options.rooms else plan.rooms
    files = sources(plan, options.checkout, rooms, options.only)
    if not files:
        parser.error("no source matches --rooms and --only")
    work = options.work or options.checkout / "build" / "mutation"
    log = work / "log.jsonl"
    known = read_log(log)
    ordered = in_order(all_mutants(options.checkout, files), options.seed)
    if options.list:
        for m in ordered:
            print(
                f"{m.file}:{m.line}:{m.column} ({m.operator})\n  - {m.before}\n  + {m.after}"
            )
        return 0
    if options.report:
        chosen = [m for m in ordered if m.key in known]
    else:
        chosen = ordered[: options.sample]
        again = {
            k for k, e in known.items() if options.again and e["outcome"] == "survived"
        }
        untried = [m for m in chosen if m.key not in known or m.key in again]
        if untried:
            work.mkdir(parents=True, exist_ok=True)
            try:
                if not options.alone:
                    untried = try_together(untried, chosen, plan, options, work, log)
                if untried:
                    try_alone(untried, plan, options, work, log)
            except RuntimeError as reason:
                print(f"scripts/mutate: {reason}", file=sys.stderr)
                return 4
            except KeyboardInterrupt:
                print(
                    "interrupted: the same command goes on from here", file=sys.stderr
                )
                return 3
        known = read_log(log)
    if not chosen:
        print("scripts/mutate: nothing was tried", file=sys.stderr)
        return 3
    # The lines may have moved since.
    return 1 if report([known[m.key] | entry_of(m) for m in chosen], accepted) else 0


if __name__ == "__main__":
    sys.exit(main())
