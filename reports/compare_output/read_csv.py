"""Text in columns: commas, semicolons, tabs or spaces; a line of names first, or none."""
import csv
import io

from compare_output import numbers
from compare_output.problem import BAD_INPUT, Problem
from compare_output.tables import Column, Table


def _delimiter(line):
    counts = {d: line.count(d) for d in ",;\t"}
    best = max(counts, key=counts.get)
    return best if counts[best] else None


def _cells(line, delimiter):
    if delimiter is None:
        return line.split()
    return [c.strip() for c in next(csv.reader(io.StringIO(line), delimiter=delimiter))]


def _column(name, texts):
    if not all(numbers.is_number(t) for t in texts):
        return Column(name, None, texts)
    whole = all(numbers.is_integer(t) for t in texts)
    return Column(name, numbers.of_texts(texts), whole=whole)


def read(path):
    """{'': Table} of a file; '#' begins a comment, but names may stand in one that is the first line."""
    try:
        text = path.read_bytes().decode("utf-8")
    except UnicodeDecodeError as e:
        raise Problem(
            BAD_INPUT, f"{path}: byte {e.start} is not UTF-8: neither CSV nor VTK"
        )
    names, rows, lines, delimiter = None, [], [], None
    first_comment = None
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip():
            continue
        if line.lstrip().startswith("#"):
            if names is None and not rows:
                first_comment = line.lstrip()[1:].strip()
            continue
        if names is None:
            delimiter = _delimiter(line)
            cells = _cells(line, delimiter)
            if not all(numbers.is_number(c) for c in cells):
                names = cells
                continue
            header = _cells(first_comment, delimiter) if first_comment else []
            names = (
                header
                if len(header) == len(cells)
                else [f"column_{i + 1}" for i in range(len(cells))]
            )
        cells = _cells(line, delimiter)
        if len(cells) != len(names):
            raise Problem(
                BAD_INPUT,
                f"{path}:{number}: {len(cells)} values, but {len(names)} fields have names",
            )
        rows.append(cells)
        lines.append(number)
    table = Table(str(path), lines=lines)
    for i, name in enumerate(names or []):
        try:
            table.add(_column(name, [row[i] for row in rows]))
        except ValueError as e:
            raise Problem(BAD_INPUT, f"{path}: field '{name}': {e}")
    return {"": table}
