"""Legacy VTK files, ASCII and binary: points, and the arrays of points, cells and of the file.

Format: "VTK File Formats", The VTK User's Guide, chapter 19.  Binary values are big-endian.
"""
from urllib.parse import unquote

import numpy as np

from compare_output import numbers
from compare_output.problem import BAD_INPUT, Problem
from compare_output.tables import Column, Table

_TYPES = {
    "float": ">f4",
    "double": ">f8",
    "char": ">i1",
    "unsigned_char": ">u1",
    "short": ">i2",
    "unsigned_short": ">u2",
    "int": ">i4",
    "unsigned_int": ">u4",
    "long": ">i8",
    "unsigned_long": ">u8",
    "vtkidtype": ">i8",
    "vtktypeint64": ">i8",
}
_TOPOLOGY = {"VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS", "CELLS"}
_COMPONENTS = {"VECTORS": 3, "NORMALS": 3, "TENSORS": 9}


class _Reader:
    def __init__(self, path):
        self.path = path
        self.data = path.read_bytes()
        self.at = 0
        self.ascii = True
        self.tables = {}

    def fail(self, what):
        line = self.data.count(b"\n", 0, self.at) + 1
        raise Problem(BAD_INPUT, f"{self.path}:{line}: {what}")

    def line(self):
        """The next line that is not empty, or None."""
        while self.at < len(self.data):
            end = self.data.find(b"\n", self.at)
            end = len(self.data) if end < 0 else end
            text = self.data[self.at : end].strip()
            self.at = end + 1
            if text:
                return text.decode("latin-1")
        return None

    def values(self, count, kind):
        """The next `count` values: an array, or texts where the file is ASCII."""
        dtype = _TYPES.get(kind.lower())
        if dtype is None:
            self.fail(f"arrays of type '{kind}' are not known here")
        if not self.ascii:
            size = count * np.dtype(dtype).itemsize
            if self.at + size > len(self.data):
                self.fail(f"{count} values of {kind} are announced, and the file ends")
            array = np.frombuffer(self.data, dtype, count, self.at)
            self.at += size
            return array.astype(array.dtype.newbyteorder("="))
        texts = []
        while len(texts) < count:
            before = self.at
            text = self.line()
            if text is None:
                self.fail(
                    f"{count} values are announced, and the file ends after {len(texts)}"
                )
            texts += text.split()
            if len(texts) > count or not numbers.is_number(texts[-1]):
                self.at = before
                self.fail(
                    f"{count} values are announced, and what follows is none: {text[:60]}"
                )
        return texts

    def add(self, place, name, count, components, kind):
        name = unquote(name)  # blanks and their like in names
        values = self.values(count * components, kind)
        if place not in self.tables:
            self.tables[place] = Table(f"{self.path} ({place})")
        table = self.tables[place]
        if not self.ascii:
            table.add_array(
                name, values.reshape(count, components) if components > 1 else values
            )
            return
        whole = _TYPES[kind.lower()][1] in "iu"
        suffixes = "xyz" if components == 3 else range(components)
        for i, suffix in zip(range(components), suffixes, strict=True):
            part = numbers.of_texts(values[i::components])
            column = name if components == 1 else f"{name}_{suffix}"
            table.add(Column(column, part, whole=whole))

    def skip_metadata(self):
        """What VTK writes behind an array of its keys: it ends with an empty line."""
        while self.at < len(self.data) and self.data[self.at] != 10:
            self.line()

    def field(self, place, arrays):
        for _ in range(arrays):
            words = (self.line() or "").split()
            while words == ["METADATA"]:
                self.skip_metadata()
                words = (self.line() or "").split()
            if len(words) != 4:
                self.fail(
                    "an array of a FIELD begins with its name, components, tuples and type"
                )
            name, components, tuples, kind = words
            # Arrays of the file itself may differ in length: a table each.
            where = place if place != "file" else f"file {name}"
            self.add(where, name, int(tuples), int(components), kind)

    def read(self):
        first = self.line() or ""
        if not first.startswith("# vtk DataFile Version"):
            self.fail("not a legacy VTK file")
        self.line()
        mode = (self.line() or "").upper()
        if mode not in ("ASCII", "BINARY"):
            self.fail(f"ASCII or BINARY is wanted, not '{mode}'")
        self.ascii = mode == "ASCII"
        place, count = "file", 0
        while (text := self.line()) is not None:
            words = text.split()
            word = words[0].upper()
            try:
                if word == "POINTS":
                    self.add("points", "points", int(words[1]), 3, words[2])
                elif word in ("POINT_DATA", "CELL_DATA"):
                    place = "points" if word == "POINT_DATA" else "cells"
                    count = int(words[1])
                elif word in _TOPOLOGY:
                    self.topology(words)
                elif word == "CELL_TYPES":
                    self.add("cells", "cell_type", int(words[1]), 1, "int")
                elif word.endswith("_COORDINATES"):
                    self.add(word.lower(), word.lower(), int(words[1]), 1, words[2])
                elif word == "FIELD":
                    self.field(place, int(words[2]))
                elif word == "SCALARS":
                    components = int(words[3]) if len(words) > 3 else 1
                    table = self.line() or ""
                    if not table.upper().startswith("LOOKUP_TABLE"):
                        self.fail("SCALARS are followed by LOOKUP_TABLE")
                    self.add(place, words[1], count, components, words[2])
                elif word in _COMPONENTS:
                    self.add(place, words[1], count, _COMPONENTS[word], words[2])
                elif word == "TEXTURE_COORDINATES":
                    self.add(place, words[1], count, int(words[2]), words[3])
                elif word == "METADATA":
                    self.skip_metadata()
                elif word in ("DATASET", "DIMENSIONS", "ORIGIN", "SPACING"):
                    if word != "DATASET":
                        self.facts(word.lower(), words[1:])
                else:
                    self.fail(f"'{words[0]}' is not known here")
            except (IndexError, ValueError) as e:
                if isinstance(e, ValueError) and "beyond" in str(e):
                    self.fail(str(e))
                self.fail(f"not understood: {text[:60]}")
        return self.tables

    def facts(self, name, texts):
        table = self.tables[name] = Table(f"{self.path} ({name})")
        whole = all(numbers.is_integer(t) for t in texts)
        table.add(Column(name, numbers.of_texts(texts), whole=whole))

    def topology(self, words):
        """Cells: from version 5 on two arrays, OFFSETS and CONNECTIVITY; before, one list."""
        before = self.at
        following = (self.line() or "").split()
        name = words[0].lower()
        if following[:1] != ["OFFSETS"]:
            self.at = before
            self.add(name, name, int(words[2]), 1, "int")
            return
        self.add(f"{name} offsets", "offsets", int(words[1]), 1, following[1])
        following = (self.line() or "").split()
        if following[:1] != ["CONNECTIVITY"]:
            self.fail("OFFSETS are followed by CONNECTIVITY")
        self.add(f"{name} connectivity", "connectivity", int(words[2]), 1, following[1])


def read(path):
    """{what rows are: Table}: 'points', 'cells' and others."""
    return _Reader(path).read()
