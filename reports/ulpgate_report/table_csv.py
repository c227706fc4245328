"""Writes a table as CSV with all digits; a marked column becomes two, the value and its mismatches."""
import csv
import io

from ulpgate_report import numbers
from ulpgate_report.tables import Marked


def _is_matrix(table):
    # A cell without a record is None, so one marked cell anywhere tells.
    return any(isinstance(value, Marked) for row in table.rows for value in row)


def _plain(value, kind):
    if value is None:
        return ""
    if kind == "arguments":
        return " ".join(value)
    if kind in ("ulp", "distance"):
        return numbers.exact_text(value)
    return str(value)


def render(table):
    """The whole file."""
    split = _is_matrix(table)
    header = []
    for index, column in enumerate(table.columns):
        header.append(column.name)
        if split and index > 0:
            header.append(f"{column.name}_mismatches")
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(header)
    for row in table.rows:
        line = []
        for index, (value, column) in enumerate(zip(row, table.columns)):
            if split and index > 0:
                marked = value or Marked(None, "")
                line += [_plain(marked.value, column.kind), str(marked.mismatches)]
            else:
                line.append(_plain(value, column.kind))
        writer.writerow(line)
    return buffer.getvalue()
