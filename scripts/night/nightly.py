"""The night: everything at full size, the most important first, in one directory that survives being killed.

    ci/nightly                                   # into out/nightly/<day>, until all is done
    ci/nightly --hours 6 --out DIR               # what matters most in six hours; says what was left out
    ci/nightly --hours 6 --out DIR --resume      # goes on: after a kill, a reboot, a full disk, or with another six hours

The seed is the day the night began (YYYYMMDD), so two machines draw the same arguments that day and others tomorrow.
DIR/status.json and DIR/status.txt say what is done, running and left, and when it should end; DIR/records.sha256 holds the
checksums of all records; DIR/worst_cases.patch adds arguments found that night to ci/worst_cases (`git apply`).

Exit codes: 0 all is done and passed, 1 a row or a verdict did not pass, 2 bad usage or input, 3 stopped or out of time
with jobs left (the same command with --resume goes on), 4 a job crashed twice, or no room on the disk.
"""

import os
import pathlib
import signal

from job_run import JobRun
from jobs import jobs_of, types_of
from night_common import ENVIRONMENT, PASS, Failure, lock, main_of
from plan import options_of, plan_of, write_patch


class Night(JobRun):
    """Jobs of a night, and the arguments that its searches found."""

    name = "nightly"

    @property
    def command(self):
        """Goes on with this night."""
        return f"ci/nightly --out {self.out} --resume"

    def add(self):
        """Writes the patch of the worst cases."""
        added = write_patch(self.out)
        if added:
            self.say(
                f"{added} lines for ci/worst_cases: git apply {self.out / 'worst_cases.patch'}"
            )


def run(words):
    options = options_of(words, __doc__)
    if options.history is not None:
        options.history = os.path.abspath(options.history)
    out = pathlib.Path(os.path.abspath(options.out))
    if options.list:
        seed = options.seed or 0
        for job in jobs_of(
            options.ulpgate,
            options.size,
            types_of(options.ulpgate, options.types),
            seed,
            "DIR/worst_cases",
        ):
            print(f"{job.name}\tulpgate {' '.join(job.words)}")
        return PASS
    out.mkdir(parents=True, exist_ok=True)
    held = lock(out / "lock")
    if held is None:
        raise Failure(ENVIRONMENT, f"{out}: another night is at work there")
    plan = plan_of(options, out)
    types = types_of(options.ulpgate, plan["types"])
    worst = out / "worst_cases"
    jobs = jobs_of(options.ulpgate, plan["size"], types, plan["seed"], worst)
    night = Night(options, out, plan, types, jobs)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, night.stop)
    return night.run()


if __name__ == "__main__":
    main_of(run)
