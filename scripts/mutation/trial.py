"""Trials: a copy of the sources, its build, and what the tests make of one mutant in it."""

import hashlib
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import time
import tomllib
from dataclasses import dataclass, field

from operators import Mutant


@dataclass
class Test:
    name: str
    target: str
    program: str
    arguments: list[str]
    limit: float


@dataclass
class Plan:
    rooms: list[str]
    endings: list[str]
    left_out: list[str]
    configure: list[str]
    build: list[str]
    build_limit: float
    keep_going: list[str]  # what the build takes so that it shows all errors
    tests: list[Test]


def read_plan(file: pathlib.Path) -> Plan:
    data = tomllib.loads(file.read_text())
    tests = [Test(**test) for test in data.pop("tests")]
    return Plan(**data, tests=tests)


# A test that neither computes nor ends is stopped after this many times its limit; other work may slow it down.
PATIENCE = 10


def run(
    command: list[str],
    limit: float,
    environment: dict[str, str] | None = None,
    directory: pathlib.Path | str | None = None,
) -> tuple[int | None, str]:
    """Exit status and output; None where a process computed for longer than `limit` seconds, or nothing came to an end."""

    def limited() -> None:
        resource.setrlimit(resource.RLIMIT_CPU, (int(limit), int(limit) + 1))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        env=environment,
        cwd=directory,
        start_new_session=True,
        preexec_fn=limited,
    ) as process:
        try:
            output, _ = process.communicate(timeout=PATIENCE * limit)
            return (
                None if process.returncode == -signal.SIGXCPU else process.returncode,
                output,
            )
        except BaseException as reason:
            os.killpg(process.pid, signal.SIGKILL)
            output, _ = process.communicate()
            if isinstance(reason, subprocess.TimeoutExpired):
                return None, output
            raise


@dataclass
class Workshop:
    """A tree of its own, so that the checkout is never dirty, with an incremental build."""

    plan: Plan
    checkout: pathlib.Path
    folder: pathlib.Path
    flags: str = ""  # of the compiler
    link: str = ""  # what every program is linked with besides
    digests: dict[str, str] = field(
        default_factory=dict
    )  # of the programs without a mutant

    @property
    def tree(self) -> pathlib.Path:
        return self.folder / "tree"

    @property
    def build_folder(self) -> pathlib.Path:
        return self.folder / "build"

    def fill(self, text: str, target: str = "") -> str:
        return text.format(
            tree=self.tree,
            build=self.build_folder,
            target=target,
            flags=self.flags,
            link=self.link,
        )

    def targets(self) -> list[Test]:
        """A test of each program."""
        return list({test.target: test for test in self.plan.tests}.values())

    def command(self, test: Test) -> list[str]:
        return [self.fill(test.program), *(self.fill(a) for a in test.arguments)]

    def synchronise(self, changed=lambda name, content: content) -> None:
        """Makes the tree the checkout's present state, as `changed` has it; files that are the same keep their times."""
        listed = subprocess.run(
            ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
            cwd=self.checkout,
            capture_output=True,
            check=True,
        ).stdout
        names = {n for n in listed.decode().split("\0") if n}
        names = {n for n in names if (self.checkout / n).is_file()}
        for name in sorted(names):
            source, copy = self.checkout / name, self.tree / name
            content = changed(name, source.read_bytes())
            if copy.is_file() and copy.read_bytes() == content:
                continue
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(content)
            copy.chmod(source.stat().st_mode & 0o777)
        for room in self.plan.rooms:
            for file in (self.tree / room).rglob("*"):
                if (
                    file.is_file()
                    and file.relative_to(self.tree).as_posix() not in names
                ):
                    file.unlink()

    def prepare(self) -> None:
        """Builds everything without a mutant and sees that all tests pass; RuntimeError where they do not."""
        self.synchronise()
        self.configure()
        passed_file = self.folder / "passed.json"
        passed = json.loads(passed_file.read_text()) if passed_file.is_file() else {}
        for test in self.plan.tests:
            status, output = self.make(test, None)
            if status != 0:
                raise RuntimeError(
                    f"{test.target} without a mutant does not build:\n{output[-2000:]}"
                )
            self.digests[test.program] = self.digest(test)
            # The same program has passed with the same arguments before.
            way = f"{self.digests[test.program]} {test.arguments}"
            if passed.get(test.name) == way:
                continue
            status, output = self.execute(test)
            if status != 0:
                raise RuntimeError(
                    f"{test.name} fails without a mutant ({first_failure(output, status)}):\n{output[-1000:]}"
                )
            passed[test.name] = way
            passed_file.write_text(json.dumps(passed))

    def configure(self) -> None:
        if (self.build_folder / "CMakeCache.txt").is_file() or not self.plan.configure:
            return
        status, output = run([self.fill(a) for a in self.plan.configure], 600)
        if status != 0:
            raise RuntimeError(f"configuring failed:\n{output[-2000:]}")

    def make(
        self, test: Test, limit: float | None, more: list[str] | None = None
    ) -> tuple[int | None, str]:
        command = [*self.plan.build, *(more or [])]
        return run([self.fill(a, test.target) for a in command], limit or 7200)

    def relink(self) -> None:
        """Links all programs again: what they are linked with besides has changed."""
        for test in self.targets():
            pathlib.Path(self.fill(test.program)).unlink()
            status, output = self.make(test, None)
            if status != 0:
                raise RuntimeError(f"{test.target} does not link:\n{output[-2000:]}")

    def execute(self, test: Test) -> tuple[int | None, str]:
        return run(self.command(test), test.limit)

    def digest(self, test: Test) -> str:
        return hashlib.sha256(
            pathlib.Path(self.fill(test.program)).read_bytes()
        ).hexdigest()

    def attempt(self, mutant: Mutant) -> dict:
        """What became of the mutant: killed (by which test), survived, same_code or not_compiled."""
        file = self.tree / mutant.file
        text = file.read_text()
        started = time.monotonic()
        file.write_text(mutant.apply(text))
        try:
            outcome = self.judge()
        finally:
            file.write_text(text)
        return outcome | {"seconds": round(time.monotonic() - started, 1)}

    def judge(self) -> dict:
        changed = False
        built: set[str] = set()
        for test in self.plan.tests:
            if test.target not in built:
                status, output = self.make(test, self.plan.build_limit)
                if status is None:
                    return {"outcome": "killed", "by": "build time limit"}
                if status != 0:
                    error = re.search(r"[^\n]*error[^\n]*", output)
                    return {
                        "outcome": "not_compiled",
                        "by": error.group() if error else output[-200:],
                    }
                built.add(test.target)
            if self.digest(test) == self.digests[test.program]:
                continue
            changed = True
            status, output = self.execute(test)
            if status is None:
                return {"outcome": "killed", "by": f"{test.name} (time limit)"}
            if status != 0:
                return {
                    "outcome": "killed",
                    "by": f"{test.name} {first_failure(output, status)}",
                }
        return {"outcome": "survived" if changed else "same_code", "by": ""}


def first_failure(output: str, status: int | None) -> str:
    failed = re.search(r"\[  FAILED  \] ([^\s,]+)", output)
    return failed.group(1) if failed else f"(status {status})"
