"""Finds a Python that has the needed packages, or names the missing package; imports the standard library alone."""
import importlib.util
import os
import subprocess
import sys

EXIT_IO_FAILURE = 4
# Import name -> Debian package that brings it.
REQUIRED_PACKAGES = {
    "jinja2": "python3-jinja2",
    "jsonschema": "python3-jsonschema",
    "matplotlib": "python3-matplotlib",
    "numpy": "python3-numpy",
}
# Set for the second interpreter, so that two incomplete ones cannot start each other for ever.
RESTARTED = "ULPGATE_REPORT_RESTARTED"


def missing_packages(packages=None):
    """Import names that this interpreter cannot find, sorted."""
    names = REQUIRED_PACKAGES if packages is None else packages
    return sorted(name for name in names if importlib.util.find_spec(name) is None)


def missing_message(missing):
    """What is missing and what installs it, one line a package."""
    lines = [
        "report: Python package '%s' is missing; install the Debian package %s"
        % (name, REQUIRED_PACKAGES.get(name, "python3-" + name))
        for name in missing
    ]
    return "\n".join(lines)


def _has_packages(python):
    program = "import importlib.util as u, sys; sys.exit(any(u.find_spec(n) is None for n in sys.argv[1:]))"
    command = [python, "-c", program, *sorted(REQUIRED_PACKAGES)]
    try:
        done = subprocess.run(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
    except OSError:
        return False
    return done.returncode == 0


def _other_interpreters():
    for folder in os.environ.get("PATH", os.defpath).split(os.pathsep):
        python = os.path.join(folder, "python3")
        if os.access(python, os.X_OK):
            yield python


def ensure_packages():
    """Return if all packages are here; else restart under a python3 of PATH that has them, or exit with 4.

    The first python3 on PATH is often one without Debian's packages, while a later one has them.
    """
    missing = missing_packages()
    if not missing:
        return
    if RESTARTED not in os.environ:
        for python in _other_interpreters():
            if _has_packages(python):
                os.environ[RESTARTED] = "1"
                os.execv(python, [python, *sys.argv])
    print(missing_message(missing), file=sys.stderr)
    sys.exit(EXIT_IO_FAILURE)
