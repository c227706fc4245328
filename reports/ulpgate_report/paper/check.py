"""Traces every number of a paper to its record, or says which has none."""
import csv
import hashlib
import io
import json
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

from ulpgate_report.app import output
from ulpgate_report.figures import plotted
from ulpgate_report.paper import chapters, published, write
from ulpgate_report.records.errors import InvalidInput

TRACE = "trace.csv"
_HOW = ("record", "computed", "published")
_COLUMNS = ("fragment", "line", "column", "number", "how", "where")
# A decimal number with its exponent, or a hexadecimal one; not the digits inside of a word such as float128 or 3a.
_NUMBER = re.compile(
    r"(?<![\w.])-?(?:0x[0-9a-f.]+p[+-]?\d+|\d+(?:\.\d+)?(?:e[+-]?\d+)?)(?![\w])", re.I
)
_DIGITS = re.compile(r"\d+(?:\.\d+)?")
# In captions: 2^40 and its like, without the sign.
_RAISED = re.compile(r"\\mathrm\{(\d+)\}\^\{-?(\d+)\}")
_EXPONENT = re.compile(r"(?:\de|10\^\{?)[-+]?(\d+)")
_RECORD_SUFFIXES = {".jsonl", ".json", ".csv"}
# Of a run's directory what holds no results.
_NO_RECORDS = {"context.json", "status.json", "estimates.json", "plan.json"}


def numbers_in(text):
    """The numbers of a text as values; thousands may be grouped."""
    plain = re.sub(r"(?<=\d),(?=\d{3}\b)", "", text)
    found = []
    for word in _NUMBER.findall(plain):
        try:
            found.append(float.fromhex(word) if "0x" in word.lower() else float(word))
        except (ValueError, OverflowError):
            continue
    return found


def _leaves(value, path=""):
    """(path, number) of everything inside of a JSON value."""
    if isinstance(value, dict):
        for key, one in value.items():
            yield from _leaves(one, f"{path}.{key}" if path else key)
    elif isinstance(value, list):
        for index, one in enumerate(value):
            yield from _leaves(one, f"{path}[{index}]")
    elif isinstance(value, bool) or value is None:
        return
    elif isinstance(value, (int, float)):
        yield path, float(value)
    else:
        for number in numbers_in(value):
            yield path, number


# Fewer digits than these stand in any run by chance.
LEAST_DIGITS = 3


def _digits(value):
    """Significant decimal digits of the shortest text of a number."""
    mantissa = repr(abs(value)).split("e")[0].replace(".", "").strip("0")
    return len(mantissa)


def _key_of(record):
    """What a line of records is of: (function, kernel or scene; type), None where it tells none."""
    names = (record.get(k) for k in ("function", "kernel", "what", "scene"))
    name = next((n for n in names if isinstance(n, str)), None)
    token = record.get("type")
    return (name, token) if name and isinstance(token, str) else None


class Index:
    """Where a number stands in the records of a run: in those of its row, or of all."""

    def __init__(self, path):
        self.places = {None: {}}
        files = [path] if path.is_file() else sorted(path.rglob("*"))
        for file in files:
            if file.suffix in _RECORD_SUFFIXES and file.name not in _NO_RECORDS:
                self._read(file, file.relative_to(path.parent))

    def _read(self, file, name):
        text = file.read_text(encoding="utf-8", errors="replace")
        if file.suffix == ".csv":
            for number, row in enumerate(csv.reader(io.StringIO(text)), 1):
                for column, cell in enumerate(row, 1):
                    for value in numbers_in(cell):
                        self._add(None, value, f"{name}:{number}:{column}")
            return
        lines = text.splitlines() if file.suffix == ".jsonl" else [text]
        for number, line in enumerate(lines, 1):
            try:
                record = json.loads(line)
            except ValueError:
                continue
            rows = record if isinstance(record, list) else [record]
            for row in rows:
                key = _key_of(row) if isinstance(row, dict) else None
                for path, value in _leaves(row):
                    self._add(key, value, f"{name}:{number}:{path}")

    def _add(self, key, value, place):
        self.places[None].setdefault(value, place)
        if key is not None:
            self.places.setdefault(key, {}).setdefault(value, place)

    def find(self, value, key):
        """The record that holds the very number: of the row's own where there are such, else any, if chance would not."""
        if key in self.places and key is not None:
            return self.places[key].get(value)
        if _digits(value) < LEAST_DIGITS:
            return None
        return self.places[None].get(value)


def _sealed(out, manifest):
    """Files that are no longer what was written."""
    wrong = []
    for name, digest in manifest["files"].items():
        try:
            content = (out / name).read_bytes()
        except OSError as error:
            wrong.append(f"{name}: {error.strerror}")
            continue
        if hashlib.sha256(content).hexdigest() != digest:
            wrong.append(f"{name}: not what was written")
    return wrong


def _made_again(runs, out, history, manifest):
    """Files that the records do not give again, byte for byte."""
    with tempfile.TemporaryDirectory(prefix="ulpgate-paper-") as place:
        again = Path(place) / "paper"
        write.write(runs, again, history)
        other = json.loads((again / write.MANIFEST).read_text(encoding="utf-8"))
        names = sorted(set(manifest["files"]) | set(other["files"]))
        return [
            f"{name}: the records give another"
            for name in names
            if manifest["files"].get(name) != other["files"].get(name)
        ]


def _tokens(text):
    """Runs of digits with their point, as they are printed."""
    return set(_DIGITS.findall(text))


def _printed_as(token):
    """How LaTeX may set a number: its digits in groups of three, on either side of the point."""
    whole, _, part = token.partition(".")
    groups = [whole[: len(whole) % 3]] if len(whole) % 3 else []
    groups += [whole[i : i + 3] for i in range(len(whole) % 3, len(whole), 3)]
    parts = [part[i : i + 3] for i in range(0, len(part), 3)]
    joined = f"{groups[-1]}.{parts[0]}" if groups and parts else ""
    return {token, whole, part, joined, *groups, *parts} - {""}


def _powers(text):
    """Powers as pdftotext gives them: the exponent behind its base, without a gap."""
    raised = {base + power for base, power in _RAISED.findall(text)}
    return raised | {"10" + exponent for exponent in _EXPONENT.findall(text)}


def _broken(text):
    """What a command leaves at the ends of lines when it is broken, which fragments.tex_command allows."""
    plain = text.replace(r"\allowbreak{}", "\0")
    pieces = plain.split("\0")
    found = set()
    for left, right in zip(pieces, pieces[1:]):
        found |= _tokens(left[-8:]) | _tokens(right[:8])
    for place in range(len(pieces)):
        found |= _tokens("".join(pieces[:place])) | _tokens("".join(pieces[place:]))
    return found


def _known_tokens(out, names):
    """Everything that the fragments and figures print."""
    known, powers = set(), set()
    for name in names:
        if name.endswith(".tex"):
            text = (out / name).read_text(encoding="utf-8")
            for line in text.splitlines():
                if r"\allowbreak" in line:
                    known |= _broken(line)
                powers |= _powers(line)
                known |= _tokens(line.replace(r"\allowbreak{}", ""))
        elif name.startswith("data/") and name.endswith(".csv"):
            # Words in figures are the last but four of the columns of what is plotted.
            with open(out / name, encoding="utf-8", newline="") as file:
                for row in csv.reader(file):
                    if len(row) == len(plotted.COLUMNS):
                        known |= _tokens(row[0]) | _tokens(row[2])
                        powers |= _powers(row[2])
    return {form for token in known for form in _printed_as(token)} | powers


def of_pdf(out, names):
    """Numbers that paper.pdf prints and nothing it was made of has; None where there is no PDF or no pdftotext."""
    pdf = out / "paper.pdf"
    if not pdf.exists() or shutil.which("pdftotext") is None:
        return None
    done = subprocess.run(
        ["pdftotext", "-layout", str(pdf), "-"], capture_output=True, text=True
    )
    if done.returncode != 0:
        raise InvalidInput(f"{pdf}: {done.stderr.strip()}")
    pages = done.stdout.count("\f")
    # Numbers of pages, sections, tables and figures.
    counted = {str(n) for n in range(pages + len(names))} | {"10"}
    printed = _tokens(done.stdout)
    return sorted(printed - _known_tokens(out, names) - counted)


def _run_of(name, runs):
    """The directory whose records a data file was made from."""
    for chapter in chapters.CHAPTERS:
        if chapter.run != "math" and name.startswith(chapter.run):
            return runs / chapter.run
    return runs / "claims" if name.startswith("claims_") else runs / "math"


def _row_key(head, row):
    """(function, type) that a row of a table names, None where it names none."""
    of = dict(zip(head, row))
    name = of.get("function") or of.get("scene") or ""
    token = of.get("type")
    # A part of a complex function stands behind its name.
    return (name.split(" ")[0], token) if name and token else None


def _how(index, column, value, key, place):
    """(how, where) of one number."""
    if column == "published":
        return "published", published.CITATION
    found = index.find(value, key)
    return ("record", found) if found else ("computed", place)


def _trace(runs, out, manifest):
    """Rows of the trace: of each number of each data file where it stands, or from which records it was computed."""
    indices, rows = {}, []
    for name in sorted(n for n in manifest["files"] if n.startswith("data/")):
        place = _run_of(Path(name).stem, runs)
        if place not in indices:
            indices[place] = Index(place)
        with open(out / name, encoding="utf-8", newline="") as file:
            reader = csv.reader(file)
            head = next(reader, [])
            for line, row in enumerate(reader, 2):
                key = _row_key(head, row)
                for column, cell in zip(head, row):
                    for value in numbers_in(cell):
                        run = str(place.relative_to(runs))
                        how = _how(indices[place], column, value, key, run)
                        rows.append((name, line, column, repr(value), *how))
    return rows


def check(runs, out, history=None):
    """(what was found in a sentence, sentences about what has no record)."""
    try:
        manifest = json.loads((out / write.MANIFEST).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InvalidInput(f"{out / write.MANIFEST}: {error}") from error
    wrong = _sealed(out, manifest) or _made_again(runs, out, history, manifest)
    strange = of_pdf(out, manifest["files"])
    wrong += [f"paper.pdf: {one} is in nothing it was made of" for one in strange or ()]
    rows = _trace(runs, out, manifest)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_COLUMNS)
    writer.writerows(rows)
    output.write_text(out / TRACE, text.getvalue())
    counts = {how: sum(row[4] == how for row in rows) for how in _HOW}
    files = len(manifest["files"])
    verdict = ", not all of them" if wrong else " are"
    said = (
        f"{files} files{verdict} what the records give; of {len(rows)} numbers in data/ {counts['record']} stand in a record, "
        f"{counts['computed']} were computed from records, {counts['published']} are published ones ({TRACE} says which); "
        + (
            "paper.pdf was not looked at"
            if strange is None
            else "paper.pdf prints no other"
        )
    )
    return said, wrong
