#!/usr/bin/env python3
"""Entry point of `ulpgate compare-output`."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
# Nothing is left behind in the source tree that it was started from.
sys.dont_write_bytecode = True

if __name__ == "__main__":
    try:
        from compare_output import cli
    except ImportError as e:
        print(f"compare-output: {e} (in Debian: python3-numpy)", file=sys.stderr)
        sys.exit(4)
    sys.exit(cli.main(sys.argv[1:]))
