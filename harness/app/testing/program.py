"""The program in tests: where it is, runs of it to the end and in the background, what they keep and what a terminal shows."""

import contextlib
import os
import pathlib
import pty
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))


def command(*words):
    return [ULPGATE, *map(str, words)]


def run(*words, program=ULPGATE, timeout=None, env=None):
    """Exit code, stdout and stderr."""
    done = subprocess.run(
        [program, *map(str, words)],
        capture_output=True,
        text=True,
        cwd=ROOT,
        timeout=timeout,
        env=env,
    )
    return done.returncode, done.stdout, done.stderr


@contextlib.contextmanager
def started(*words):
    """A run in the background, which does not outlive the test."""
    process = subprocess.Popen(
        command(*words),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
    )
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


def log_lines(out):
    """Of what a run keeps under `out`: a line for the plan, then one for each finished piece."""
    log = out / "units/log.txt"
    return log.read_bytes().splitlines(keepends=True) if log.exists() else []


def move_to_another_machine(out):
    """Makes what is kept under `out` that of a machine with another C library, by a header with a checksum that fits."""
    log = out / "units/log.txt"
    header, _, rest = log.read_text().partition("\n")
    payload = header[17:].replace('"glibc":"', '"glibc":"9')
    checksum = 0xCBF29CE484222325
    for byte in payload.encode():
        checksum = (checksum ^ byte) * 0x100000001B3 % 2**64
    log.write_text(f"{checksum:016x} {payload}\n{rest}")


def wait_for_pieces(out, count, process=None):
    """Until so many pieces are kept under `out`, or the process, where one is given, has ended."""
    for _ in range(30000):
        ended = process is not None and process.poll() is not None
        if ended or len(log_lines(out)) > count:
            return
        time.sleep(0.002)
    raise AssertionError(f"{out} never held {count} pieces")


def all_of(terminal):
    """What was written to a terminal until its other end was closed."""
    shown = b""
    try:
        while chunk := os.read(terminal, 4096):
            shown += chunk
    except OSError:
        pass  # how Linux says that the other end is closed
    os.close(terminal)
    return shown


def shown_on_terminal(*words):
    """What a run that ends well shows on stderr where that is a terminal."""
    terminal, end = pty.openpty()
    process = subprocess.Popen(
        command(*words), stdout=subprocess.DEVNULL, stderr=end, cwd=ROOT
    )
    os.close(end)
    shown = all_of(terminal)
    assert process.wait() == 0
    return shown
