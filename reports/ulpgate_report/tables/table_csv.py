"""Writes a table as CSV with all digits; a marked column becomes two, the value and its mismatches."""
import csv
import io

from ulpgate_report.tables.table import Judged, Marked
from ulpgate_report.values import numbers


def _mark_name(table):
    """The name of what stands beside the values of a matrix, None for other tables."""
    # A cell without a record is None, so one marked cell anywhere tells.
    for row in table.rows:
        for value in row:
            if isinstance(value, (Marked, Judged)):
                return value.mark_name
    return None


def _plain(value, kind):
    if value is None:
        return ""
    if kind == "arguments":
        return " ".join(value)
    if kind in ("ulp", "distance", "real", "rough"):
        return numbers.exact_text(value)
    return str(value)


def _is_plain(table, index):
    """Whether a column's values bear no marks: the names of rows."""
    values = (row[index] for row in table.rows)
    return index == 0 or any(
        value is not None and not isinstance(value, (Marked, Judged))
        for value in values
    )


def render(table):
    """The whole file."""
    split = _mark_name(table)
    header = []
    plain = [_is_plain(table, index) for index in range(len(table.columns))]
    for index, column in enumerate(table.columns):
        header.append(column.name)
        if split and not plain[index]:
            header.append(f"{column.name}_{split}")
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(header)
    for row in table.rows:
        line = []
        for index, (value, column) in enumerate(zip(row, table.columns)):
            if split and not plain[index]:
                marked = value or Marked(None, "")
                line += [_plain(marked.value, column.kind), marked.mark_value]
            else:
                line.append(_plain(value, column.kind))
        writer.writerow(line)
    return buffer.getvalue()
