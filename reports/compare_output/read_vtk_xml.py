"""VTK's XML files (.vtp .vtu .vti .vtr .vts): ASCII, base64 and appended data, whole or compressed by zlib, LZMA or LZ4
(that one with python3-lz4).

Format: "VTK XML File Formats", https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html.
"""
import base64
import binascii
import lzma
import xml.etree.ElementTree as ElementTree
import zlib

import numpy as np

from compare_output import numbers
from compare_output.problem import BAD_INPUT, Problem
from compare_output.tables import Column, Table

# What decompressors raise.
_BROKEN = (zlib.error, lzma.LZMAError, ValueError, MemoryError)
_TYPES = {
    "Float32": "f4",
    "Float64": "f8",
    **{
        f"{u}Int{8 * n}": f"{'u' if u else 'i'}{n}"
        for u in ("", "U")
        for n in (1, 2, 4, 8)
    },
}
_PLACES = {"PointData": "points", "Points": "points", "CellData": "cells"}


class _Appended:
    """What stands behind the underscore of AppendedData."""

    def __init__(self, data, encoding):
        self.data = data
        self.encoding = encoding


class _Reader:
    def __init__(self, path):
        self.path = path
        self.tables = {}
        self.parts = {}
        self.appended = None
        xml = self.without_appended(path.read_bytes())
        try:
            self.root = ElementTree.fromstring(xml)
        except ElementTree.ParseError as e:
            self.fail(f"no XML: {e}")
        if self.root.tag != "VTKFile":
            self.fail(f"VTKFile is wanted, not {self.root.tag}")
        self.order = "<" if self.root.get("byte_order") == "LittleEndian" else ">"
        self.header = _TYPES[self.root.get("header_type", "UInt32")]
        compressor = self.root.get("compressor")
        self.compressed = compressor is not None
        self.decompress = self.decompressor(compressor) if self.compressed else None

    def fail(self, what):
        raise Problem(BAD_INPUT, f"{self.path}: {what}")

    def decompressor(self, name):
        """(bytes of a block, its size when it is not the last) -> what was compressed."""
        if name == "vtkZLibDataCompressor":
            return lambda block, _: zlib.decompress(block)
        if name == "vtkLZMADataCompressor":
            return lambda block, _: lzma.decompress(block)
        if name != "vtkLZ4DataCompressor":
            self.fail(f"data compressed by {name} are not read here")
        try:
            from lz4.block import LZ4BlockError, decompress
        except ImportError:
            self.fail(f"data compressed by {name} want python3-lz4")

        def lz4(block, size):
            try:
                return decompress(block, uncompressed_size=size)
            except LZ4BlockError as e:
                raise ValueError(e) from None

        return lz4

    def without_appended(self, data):
        """Raw bytes are no XML: they are cut out first."""
        begin = data.find(b"<AppendedData")
        if begin < 0:
            return data
        opened = data.find(b">", begin)
        closed = data.rfind(b"</AppendedData>")
        first = data.find(b"_", opened)
        if min(opened, closed, first) < 0 or first > closed:
            self.fail("AppendedData that do not end: the file is cut")
        encoding = b"base64" if b"base64" in data[begin:opened] else b"raw"
        self.appended = _Appended(data[first + 1 : closed], encoding.decode())
        return data[:begin] + data[closed + len(b"</AppendedData>") :]

    # Bytes of one array, from its header on.
    def decoded(self, data, is_base64):
        size = np.dtype(self.header).itemsize

        def words(raw, count):
            if len(raw) < count * size:
                self.fail("an array's header is cut")
            return np.frombuffer(raw, self.order + self.header, count).astype(int)

        def base64_of(text, length):
            chars = 4 * -(-length // 3)
            if len(text) < chars:
                self.fail("an array in base64 is cut")
            try:
                return base64.b64decode(text[:chars], validate=True)[:length], chars
            except binascii.Error as e:
                self.fail(f"no base64: {e}")

        if not self.compressed:
            if is_base64:
                (length,) = words(base64_of(data, size)[0], 1)
                return base64_of(data, size + int(length))[0][size:]
            (length,) = words(data, 1)
            if size + length > len(data):
                self.fail("an array is cut")
            return data[size : size + length]
        # Number of blocks, size of a block, size of the last (0: as the others), then the compressed sizes.
        first = base64_of(data, 3 * size)[0] if is_base64 else data
        blocks = int(words(first, 3)[0])
        length = (3 + blocks) * size
        if is_base64:
            head, chars = base64_of(data, length)
        else:
            head, chars = data[:length], length
        _, block_size, _, *sizes = map(int, words(head, 3 + blocks))
        total = sum(sizes)
        rest = data[chars:]
        body = base64_of(rest, total)[0] if is_base64 else rest[:total]
        out, at = [], 0
        for n in sizes:
            try:
                out.append(self.decompress(body[at : at + n], block_size))
            except _BROKEN as e:
                self.fail(f"a compressed block: {e}")
            at += n
        return b"".join(out)

    def array(self, element):
        """(array or texts, components) of a DataArray."""
        name = element.get("Name") or "unnamed"
        kind = element.get("type")
        if kind not in _TYPES:
            return None, 0  # texts
        components = int(element.get("NumberOfComponents") or 1)
        form = element.get("format", "ascii")
        if form == "ascii":
            return (element.text or "").split(), components
        if form == "appended":
            if self.appended is None:
                self.fail(f"'{name}' stands in AppendedData, which are not there")
            data = self.appended.data[int(element.get("offset", 0)) :]
            raw = self.decoded(data, self.appended.encoding == "base64")
        else:
            text = "".join((element.text or "").split())
            if not text:
                return np.zeros(0), components
            raw = self.decoded(text.encode(), True)
        dtype = np.dtype(self.order + _TYPES[kind])
        if len(raw) % dtype.itemsize:
            self.fail(f"'{name}' has {len(raw)} bytes, no multiple of {dtype.itemsize}")
        return np.frombuffer(raw, dtype).astype(dtype.newbyteorder("=")), components

    def take(self, place, element):
        values, components = self.array(element)
        if values is None:
            return
        name = element.get("Name") or "unnamed"
        if len(values) % components:
            self.fail(
                f"'{name}' has {len(values)} values, no multiple of {components} components"
            )
        whole = _TYPES[element.get("type")][0] in "iu"
        self.parts.setdefault((place, name), []).append((values, components, whole))

    def read(self):
        for piece in self.root.iter("Piece"):
            for group in piece:
                place = _PLACES.get(group.tag, group.tag.lower())
                for element in group.iter("DataArray"):
                    # Topology: lists of lengths of their own.
                    own = group.tag not in _PLACES
                    name = element.get("Name") or "unnamed"
                    self.take(f"{place} {name}" if own else place, element)
        for group in self.root.iter("FieldData"):
            for element in group.iter("DataArray"):
                self.take(f"file {element.get('Name')}", element)
        # Pieces of a file are parts of the same arrays.
        for (place, name), pieces in self.parts.items():
            table = self.tables.setdefault(place, Table(f"{self.path} ({place})"))
            self.add(table, name, pieces)
        return self.tables

    def add(self, table, name, pieces):
        components = pieces[0][1]
        if any(c != components for _, c, _ in pieces):
            self.fail(f"'{name}' has other numbers of components in other pieces")
        if all(isinstance(v, np.ndarray) for v, _, _ in pieces):
            array = np.concatenate([v for v, _, _ in pieces])
            table.add_array(
                name, array.reshape(-1, components) if components > 1 else array
            )
            return
        texts = [str(x) for v, _, _ in pieces for x in v]
        bad = next((t for t in texts if not numbers.is_number(t)), None)
        if bad is not None:
            self.fail(f"'{name}' holds '{bad[:40]}', no number")
        suffixes = "xyz" if components == 3 else range(components)
        for i, suffix in zip(range(components), suffixes, strict=True):
            part = numbers.of_texts(texts[i::components])
            column = name if components == 1 else f"{name}_{suffix}"
            table.add(Column(column, part, whole=pieces[0][2]))


def read(path):
    """{what rows are: Table}: 'points', 'cells' and others."""
    return _Reader(path).read()
