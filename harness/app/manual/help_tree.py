"""Verbs, options and arguments of ulpgate as its --help tells them: what man pages and completions are made from."""

import dataclasses
import json
import re
import subprocess

_HEADS = ("Positionals:", "Options:", "Subcommands:")
# "  -h,--help   text", "  --samples UINT:UINT in [1 - 9]=20000": two spaces, names, what it takes.
_ENTRY = re.compile(r"^  (\S.*?)(?:\s{2,}(.*))?$")


@dataclasses.dataclass(frozen=True)
class Entry:
    """An option, an argument or a verb: its names, what it takes ("" of a flag), the words it may be, its text."""

    names: tuple
    takes: str
    choices: tuple
    text: str

    @property
    def valued(self):
        """Whether a word follows it; "Excludes: --overwrite" is none."""
        return bool(re.match(r"(TEXT|U?INT|FLOAT)", self.takes))


@dataclasses.dataclass(frozen=True)
class Verb:
    """`words` is empty of the program itself; `notes` are the lines below all lists."""

    words: tuple
    summary: str
    usage: str
    positionals: tuple
    options: tuple
    verbs: tuple
    notes: str


def _entry(first, text):
    names, _, takes = first.partition(" ")
    takes = takes.strip()
    listed = re.search(r"\{([^}]*)\}", takes)
    choices = tuple(listed[1].split(",")) if listed else ()
    return Entry(tuple(names.split(",")), takes, choices, " ".join(text))


def _entries(lines):
    """The entries of a list; a text goes on in lines that are indented further."""
    found = []
    for line in lines:
        match = _ENTRY.match(line)
        if match and not line.startswith("   "):
            found.append((match[1], [match[2]] if match[2] else []))
        elif found and line.strip():
            found[-1][1].append(line.strip())
    return tuple(_entry(first, text) for first, text in found)


def parse(words, text):
    """The Verb whose --help is `text`."""
    lines = text.splitlines()
    summary, usage = lines[0], ""
    lists, head, notes = {h: [] for h in _HEADS}, None, []
    for line, below in zip(lines[1:], [*lines[2:], ""]):
        if line.startswith("Usage: "):
            usage = line.removeprefix("Usage: ")
        elif line in _HEADS:
            head = line
        elif line.endswith(":") and below.startswith("  -"):
            # Options that belong together stand below a head of their own.
            head = "Options:"
        elif not line.startswith(" ") and line:
            head = None
            notes.append(line)
        elif head is not None:
            lists[head].append(line)
        elif notes:
            notes.append(line)
    positionals, options, verbs = (_entries(lists[h]) for h in _HEADS)
    return Verb(
        words, summary, usage, positionals, options, verbs, "\n".join(notes).strip()
    )


def read(program):
    """{words: Verb} of the program and everything below it."""
    found = {}

    def look(words):
        done = subprocess.run(
            [program, *words, "--help"], capture_output=True, text=True, check=True
        )
        verb = found[words] = parse(words, done.stdout)
        for below in verb.verbs:
            look((*words, below.names[0]))

    look(())
    return found


def names(program, what):
    """What `ulpgate list WHAT` names."""
    words = [program, "list", what, "--json"]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    # The first key of a row is its name; strata tell first what they are of.
    key = {"functions": "function", "types": "token", "strata": "stratum"}
    key |= {"kernels": "kernel", "scenes": "scene", "integrators": "integrator"}
    return tuple(dict.fromkeys(row[key[what]] for row in json.loads(done.stdout)))
