#!/usr/bin/env python3
"""Man pages and completions of an ulpgate: make_manual.py PROGRAM SHARE writes SHARE/man/man1 and those of bash, zsh and fish.

Exit codes: 0 written, 2 bad usage, 4 the program does not run or nothing can be written.  Standard library alone.
"""

import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import completions  # noqa: E402
import help_tree  # noqa: E402
import man_pages  # noqa: E402

LISTS = ("functions", "types", "strata", "kernels", "scenes", "integrators")


def files(program):
    """{path below SHARE: text} of all of it."""
    tree = help_tree.read(program)
    listed = {what: help_tree.names(program, what) for what in LISTS}
    done = subprocess.run([program, "--version"], capture_output=True, text=True)
    version = (done.stdout.split() or ["?"])[-1]
    found = {
        f"man/man1/{man_pages.name_of(words)}.1": man_pages.page(verb, tree, version)
        for words, verb in tree.items()
    }
    found["bash-completion/completions/ulpgate"] = completions.bash(tree, listed)
    found["zsh/site-functions/_ulpgate"] = completions.zsh(tree, listed)
    found["fish/vendor_completions.d/ulpgate.fish"] = completions.fish(tree, listed)
    return found


def main(words):
    if len(words) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    program, share = words[0], pathlib.Path(words[1])
    try:
        for name, text in files(program).items():
            (share / name).parent.mkdir(parents=True, exist_ok=True)
            (share / name).write_text(text, encoding="utf-8")
    except (OSError, subprocess.SubprocessError) as error:
        print(f"make_manual: {error}", file=sys.stderr)
        return 4
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
