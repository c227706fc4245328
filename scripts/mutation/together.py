"""Trials of many mutants in one build: which test cases come by each, and what these make of it."""

import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import tempfile
import time
from dataclasses import dataclass, field

from operators import Mutant
from trial import Plan, Test, Workshop, first_failure, run
from weave import HEADER, SWITCH_SOURCE, Form, Woven, place, weave

ERROR = re.compile(r"^([^\s:][^:\n]*):(\d+):(?:\d+:)? (?:fatal )?error:", re.MULTILINE)
MENTION = re.compile(r"(?:^|from |at )([^\s:][^:\n]*):(\d+)[:,]", re.MULTILINE)
ROUNDS = 12
# Cases that together take no longer than this are tried first, in one process.
QUICK = 3.0


@dataclass
class Case:
    test: Test
    name: str  # empty where a program's cases cannot be told apart
    seconds: float = 0.0
    reached: set[int] = field(default_factory=set)


@dataclass
class Together:
    """A tree in which all mutants are woven, its build and its test cases."""

    plan: Plan
    checkout: pathlib.Path
    folder: pathlib.Path
    jobs: int = 1
    woven: dict[str, list[Woven]] = field(default_factory=dict)
    cases: list[Case] = field(default_factory=list)
    count: int = 0  # the greatest number
    shop: Workshop | None = None

    def prepare(self, mutants: list[Mutant], say) -> None:
        """Weaves, builds and finds who reaches what; RuntimeError where that cannot be, or tests fail with no mutant on."""
        self.folder.mkdir(parents=True, exist_ok=True)
        known = self._read_known()
        # A mutant keeps its number and form in later runs, so that what was built stays.
        highest = max((number for number, _ in known.values()), default=0)
        by_file: dict[str, list[tuple[int, Mutant]]] = {}
        for m in mutants:
            if m.key not in known:
                highest += 1
            number, _ = known.get(m.key, (highest, None))
            by_file.setdefault(m.file, []).append((number, m))
        for name, some in by_file.items():
            self.woven[name] = place((self.checkout / name).read_text(), some)
            for w in self.woven[name]:
                w.form = Form(known.get(w.mutant.key, (0, w.form))[1])
        self.count = highest
        self._keep_known()
        header, source, switch = (
            self.folder / name
            for name in ("mutation.hpp", "mutation.cpp", "mutation.o")
        )
        if not header.is_file() or header.read_text() != HEADER:
            header.write_text(HEADER)
        source.write_text(SWITCH_SOURCE % (self.count + 1))
        compiler = os.environ.get("CXX", "c++")
        subprocess.run([compiler, "-O2", "-c", source, "-o", switch], check=True)
        self.shop = Workshop(
            self.plan,
            self.checkout,
            self.folder,
            flags=f"-include {header}",
            link=str(switch),
        )
        self._build(self.shop, say)
        self._find_cases(say)

    def _build(self, shop: Workshop, say) -> None:
        for round_ in range(ROUNDS):
            shop.synchronise(self._woven_text)
            shop.configure()
            outputs = [shop.make(t, None, self.plan.keep_going) for t in shop.targets()]
            failed = "\n".join(output for status, output in outputs if status != 0)
            if not failed:
                # a switch of another size
                shop.relink()
                return
            changed = self._give_way(failed, shop)
            self._keep_known()
            say(
                f"round {round_ + 1} of the build: {changed} mutants do not compile in their form"
            )
            if not changed:
                (self.folder / "failed_build.txt").write_text(failed)
                raise RuntimeError(f"the woven sources do not build:\n{failed[-3000:]}")
        raise RuntimeError(f"the woven sources do not build in {ROUNDS} rounds")

    def _keep_known(self) -> None:
        known = {
            w.mutant.key: (w.number, w.form)
            for some in self.woven.values()
            for w in some
        }
        (self.folder / "known.json").write_text(json.dumps(self._read_known() | known))

    def _read_known(self) -> dict[str, tuple[int, int]]:
        file = self.folder / "known.json"
        return json.loads(file.read_text()) if file.is_file() else {}

    def _woven_text(self, name: str, content: bytes) -> bytes:
        if name not in self.woven:
            return content
        return weave(content.decode(), self.woven[name]).encode()

    def _give_way(self, output: str, shop: Workshop) -> int:
        """Gives the mutants at the places of errors their next form; how many."""
        for pattern in (ERROR, MENTION):
            changed = 0
            for file, line in {(m[1], int(m[2])) for m in pattern.finditer(output)}:
                for w in self._at(file, shop):
                    if w.form < Form.ALONE and w.first_line <= line <= w.last_line:
                        w.form = Form(w.form + 1)
                        changed += 1
            if changed:
                return changed
        # The place of the error is not the mutant's: a constant that uses it, for one.
        files = {m[1] for m in ERROR.finditer(output)}
        for form in (Form.OFF_IN_CONSTANTS, Form.ALONE):
            some = {
                w.number: w
                for file in files
                for w in self._at(file, shop)
                if w.form < form
            }
            for w in some.values():
                w.form = form
            if some:
                return len(some)
        return 0

    def _at(self, file: str, shop: Workshop) -> list[Woven]:
        path = (shop.build_folder / file).resolve()
        if path.is_relative_to(shop.tree.resolve()):
            return self.woven.get(path.relative_to(shop.tree.resolve()).as_posix(), [])
        # a source that CMake made
        return [
            w for name, some in self.woven.items() if name.endswith(".in") for w in some
        ]

    def _find_cases(self, say) -> None:
        for test in self.plan.tests:
            names = [""]
            if any(a.startswith("--gtest") for a in test.arguments):
                listed = subprocess.run(
                    [*self.shop.command(test), "--gtest_list_tests"],
                    capture_output=True,
                    text=True,
                    check=True,
                ).stdout
                names = case_names(listed)
            self.cases += [Case(test, name) for name in names]
        reached = self.folder / "reached"
        reached.mkdir(exist_ok=True)

        def one(number: int, case: Case) -> None:
            file = reached / str(number)
            file.write_bytes(bytes(self.count + 1))
            started = time.monotonic()
            status, output = self._run([case], 0, case.test.limit, file)
            case.seconds = time.monotonic() - started
            if status != 0:
                name = f"{case.test.name} {case.name}".strip()
                raise RuntimeError(
                    f"{name} fails without a mutant ({status}):\n{output[-2000:]}"
                )
            case.reached = {n for n, byte in enumerate(file.read_bytes()) if byte}
            file.unlink()

        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            list(pool.map(one, range(len(self.cases)), self.cases))
        total = sum(c.seconds for c in self.cases)
        say(
            f"{len(self.cases)} test cases, {total:.0f} s one after another without a mutant"
        )

    def _run(self, cases: list[Case], mutant: int, limit: float, reached=None):
        """Runs cases of one program with a mutant on; exit status (None: too long) and output."""
        test = cases[0].test
        command = self.shop.command(test)
        if cases[0].name:
            command = [c for c in command if not c.startswith("--gtest_filter")]
            command.append("--gtest_filter=" + ":".join(c.name for c in cases))
        with tempfile.TemporaryDirectory(prefix="mutant.") as place_:
            environment = dict(os.environ, ULPGATE_MUTANT=str(mutant), TMPDIR=place_)
            if reached:
                environment["ULPGATE_MUTANTS_REACHED"] = str(reached)
            return run(command, limit, environment, place_)

    def attempt(self, w: Woven) -> dict:
        """What became of a woven mutant: killed (by which test) or survived."""
        started = time.monotonic()
        reaching = sorted(
            (c for c in self.cases if w.number in c.reached), key=lambda c: c.seconds
        )
        outcome = {"outcome": "survived", "by": "" if reaching else "no test comes by"}
        quick, spent = [], 0.0
        for case in reaching:
            spent += case.seconds
            if spent > QUICK and quick:
                break
            quick.append(case)
        for some in (quick, reaching[len(quick) :]):
            by_test: dict[str, list[Case]] = {}
            for case in some:
                by_test.setdefault(case.test.name, []).append(case)
            for together in sorted(
                by_test.values(), key=lambda cs: sum(c.seconds for c in cs)
            ):
                usual = sum(c.seconds for c in together)
                status, output = self._run(together, w.number, 10 + 5 * usual)
                name = together[0].test.name
                if status != 0:
                    why = (
                        "(time limit)"
                        if status is None
                        else first_failure(output, status)
                    )
                    outcome = {"outcome": "killed", "by": f"{name} {why}"}
                    break
            if outcome["outcome"] == "killed":
                break
        return outcome | {
            "seconds": round(time.monotonic() - started, 1),
            "way": "together",
        }

    def ready(self) -> list[Woven]:
        """The mutants that can be tried here."""
        reached = set().union(*(c.reached for c in self.cases))
        return [
            w
            for some in self.woven.values()
            for w in some
            if w.form is not Form.ALONE
            and (w.form is not Form.OFF_IN_CONSTANTS or w.number in reached)
        ]


def case_names(listed: str) -> list[str]:
    """Suite.Case of each test that --gtest_list_tests prints."""
    names, suite = [], ""
    for line in listed.splitlines():
        word = line.split("#")[0].rstrip()
        if not word or not re.match(r"\s*[\w/.]+$", word):
            continue
        if word.startswith("  "):
            names.append(suite + word.strip())
        elif word.endswith("."):
            suite = word
    return names
