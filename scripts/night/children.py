"""Runs the commands of jobs as children that end when the night ends, however it ends."""

import ctypes
import os
import signal
import subprocess
import time

from night_common import ENVIRONMENT

PR_SET_PDEATHSIG = 1
# A command that was told to end keeps what is in hand; one that does not end by then is killed.
PATIENCE_S = 120


def end_with_parent():
    """In the child: SIGTERM when the night dies, of kill -9 too, so that no command works on in its directory."""
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)


class Child:
    """A running job."""

    def __init__(self, job, program, out, threads):
        self.job = job
        self.threads = threads
        directory = out / "logs" / job.name
        directory.mkdir(parents=True, exist_ok=True)
        self.place = out / job.name
        self.place.parent.mkdir(parents=True, exist_ok=True)
        self.log = directory / "log.txt"
        words = job.command(program, self.place, threads)
        with open(self.log, "w") as log, open(directory / "output.txt", "w") as output:
            self.process = subprocess.Popen(
                words,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=log,
                start_new_session=True,  # Ctrl-C comes through us, not twice.
                preexec_fn=end_with_parent,
            )
        self.told = False
        self.told_at = 0.0
        self.since = time.time()

    def code(self):
        """Its exit code; None while it runs."""
        code = self.process.poll()
        if code is None:
            return None
        # Killed by a signal: a crash.
        return code if 0 <= code <= ENVIRONMENT else ENVIRONMENT

    def tell_to_end(self):
        if not self.told and self.process.poll() is None:
            self.told = True
            self.told_at = time.time()
            os.killpg(self.process.pid, signal.SIGTERM)

    def kill(self):
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()

    def last_words(self):
        """The last line of its log, which says what was wrong."""
        try:
            lines = self.log.read_text(errors="replace").splitlines()
        except OSError as e:
            return str(e)
        return lines[-1] if lines else "no message"
