#!/usr/bin/env python3
"""Entry point of the paper: finds an interpreter with the needed packages, then hands over to the package."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
# Nothing is left behind in the source tree that it was started from.
sys.dont_write_bytecode = True

from ulpgate_report.app import interpreter  # noqa: E402  (the path has to be set first)

if __name__ == "__main__":
    interpreter.ensure_packages()
    from ulpgate_report.paper import cli

    sys.exit(cli.main(sys.argv[1:]))
