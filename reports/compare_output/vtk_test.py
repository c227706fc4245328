"""Tests of the readers of VTK files: every way of writing the same arrays gives the same numbers."""

import base64
import json
import lzma
import struct
import zlib

import numpy as np
import pytest

from compare_output import cli, read
from compare_output.problem import BAD_INPUT, DIFFERENT, PASS, Problem

try:
    import lz4.block
except ImportError:
    lz4 = None

POINTS = [0.0, 0.25, -1.5, 2.0, 3.0, 4.0]  # two points
RADIUS = [0.5, 0.125]
CELLS = [1, 0, 1, 1]


def legacy_ascii(radius=RADIUS):
    return (
        "# vtk DataFile Version 3.0\ntwo spheres\nASCII\nDATASET POLYDATA\nPOINTS 2 double\n"
        + " ".join(map(repr, POINTS[:3]))
        + "\n"
        + " ".join(map(repr, POINTS[3:]))
        + "\nVERTICES 2 4\n1 0\n1 1\nPOINT_DATA 2\nSCALARS radius double 1\nLOOKUP_TABLE default\n"
        + "\n".join(map(repr, radius))
        + "\n"
    ).encode()


def legacy_binary(radius=RADIUS):
    return (
        b"# vtk DataFile Version 3.0\ntwo spheres\nBINARY\nDATASET POLYDATA\nPOINTS 2 double\n"
        + struct.pack(">6d", *POINTS)
        + b"\nVERTICES 2 4\n"
        + struct.pack(">4i", *CELLS)
        + b"\nPOINT_DATA 2\nFIELD FieldData 1\nradius 1 2 double\n"
        + struct.pack(">2d", *radius)
        + b"\n"
    )


def zlib_of(block):
    return zlib.compress(block)


def lzma_of(block):
    return lzma.compress(block)


def lz4_of(block):
    return lz4.block.compress(block, store_size=False)


COMPRESSORS = {
    "vtkZLibDataCompressor": zlib_of,
    "vtkLZMADataCompressor": lzma_of,
    "vtkLZ4DataCompressor": lz4_of,
}


def xml(
    radius=RADIUS,
    form="ascii",
    compressed=False,
    order="<",
    header="I",
    compressor="vtkZLibDataCompressor",
):
    appended = []

    def encoded(raw):
        if not compressed:
            return struct.pack(order + header, len(raw)) + raw, None
        blocks = [raw[i : i + 16] for i in range(0, len(raw), 16)]
        packed = [COMPRESSORS[compressor](b) for b in blocks]
        last = len(blocks[-1]) if len(blocks) > 1 and len(blocks[-1]) < 16 else 0
        head = struct.pack(
            f"{order}{3 + len(blocks)}{header}",
            *(len(blocks), len(blocks[0]), last, *map(len, packed)),
        )
        return head, b"".join(packed)

    def array(name, values, kind="d", components=1):
        vtk_type = {"d": "Float64", "i": "Int32"}[kind]
        head = f'<DataArray type="{vtk_type}" Name="{name}" NumberOfComponents="{components}" '
        raw = struct.pack(f"{order}{len(values)}{kind}", *values)
        if form == "ascii":
            return head + f'format="ascii">{" ".join(map(repr, values))}</DataArray>'
        first, rest = encoded(raw)
        if form == "appended_raw":
            offset = sum(map(len, appended))
            appended.append(first + (rest or b""))
        else:
            text = base64.b64encode(first) + (base64.b64encode(rest) if rest else b"")
            if form == "binary":
                return head + f'format="binary">\n{text.decode()}\n</DataArray>'
            offset = sum(map(len, appended))
            appended.append(text)
        return head + f'format="appended" offset="{offset}"/>'

    body = (
        "<PolyData><Piece NumberOfPoints='2'><PointData>"
        + array("radius", radius)
        + "</PointData><Points>"
        + array("Points", POINTS, components=3)
        + "</Points><Verts>"
        + array("connectivity", [0, 1], kind="i")
        + "</Verts></Piece></PolyData>"
    )
    tail = b""
    if appended:
        encoding = "raw" if form == "appended_raw" else "base64"
        tail = (
            f'<AppendedData encoding="{encoding}">\n_'.encode()
            + b"".join(appended)
            + b"\n</AppendedData>"
        )
    endian = "LittleEndian" if order == "<" else "BigEndian"
    head = f'<?xml version="1.0"?><VTKFile type="PolyData" version="1.0" byte_order="{endian}" header_type="{"UInt64" if header == "Q" else "UInt32"}"'
    head += f' compressor="{compressor}">' if compressed else ">"
    return head.encode() + body.encode() + tail + b"</VTKFile>"


XML = [
    {"form": form, "compressed": compressed, "order": order, "header": header}
    for form in ("ascii", "binary", "appended_raw", "appended_base64")
    for compressed in (False, True)
    for order in "<>"
    for header in "IQ"
    if not (form == "ascii" and (compressed or order == ">" or header == "Q"))
]


@pytest.mark.parametrize("write", [legacy_ascii, legacy_binary])
def test_legacy(tmp_path, write):
    file = tmp_path / "a.vtk"
    file.write_bytes(write())
    tables = read.read(file)
    assert tables["points"].columns["radius"].numbers.high.tolist() == RADIUS
    assert tables["points"].columns["points_z"].numbers.high.tolist() == [-1.5, 4.0]
    assert tables["vertices"].columns["vertices"].numbers.high.tolist() == CELLS


@pytest.mark.parametrize("how", XML, ids=lambda h: "-".join(map(str, h.values())))
def test_xml(tmp_path, how):
    file = tmp_path / "a.vtp"
    file.write_bytes(xml(**how))
    tables = read.read(file)
    assert tables["points"].columns["radius"].numbers.high.tolist() == RADIUS
    assert tables["points"].columns["Points_y"].numbers.high.tolist() == [0.25, 3.0]
    assert tables["verts connectivity"].columns["connectivity"].whole


@pytest.mark.parametrize("compressor", list(COMPRESSORS))
@pytest.mark.parametrize("form", ["binary", "appended_raw"])
def test_compressors(tmp_path, compressor, form):
    if compressor == "vtkLZ4DataCompressor" and lz4 is None:
        pytest.skip("no python3-lz4")
    file = tmp_path / "a.vtp"
    whole = xml(form=form, compressed=True, compressor=compressor)
    file.write_bytes(whole)
    assert read.read(file)["points"].columns["radius"].numbers.high.tolist() == RADIUS
    if form == "appended_raw":
        # A byte of a block's beginning.
        at = whole.index(b"\n_") + 2 + 4 * 4
        file.write_bytes(whole[:at] + b"\x9f" + whole[at + 1 :])
        with pytest.raises(Problem) as e:
            read.read(file)
        assert e.value.code == BAD_INPUT and "a compressed block" in str(e.value)


def test_an_unknown_compressor_is_named(tmp_path):
    file = tmp_path / "a.vtp"
    file.write_bytes(xml(form="binary", compressed=True).replace(b"vtkZLib", b"vtkFoo"))
    with pytest.raises(Problem, match="vtkFooDataCompressor"):
        read.read(file)


KEYS = b"METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0.125 0.5\n\n"


def test_keys_behind_arrays_are_passed_over(tmp_path):
    file = tmp_path / "a.vtk"
    field = b"POINT_DATA 2\nFIELD FieldData 2\nthe%20mass 1 2 double\n1 2\n" + KEYS
    field += b"radius 1 2 double\n0.5 0.125\n" + KEYS
    head = b"# vtk DataFile Version 5.1\ntwo\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 0 0 1 1 1\n"
    file.write_bytes(head + KEYS + field)
    columns = read.read(file)["points"].columns
    assert columns["radius"].numbers.high.tolist() == RADIUS
    assert columns["the mass"].numbers.high.tolist() == [1, 2]


@pytest.mark.parametrize("how", ["legacy-ascii", "legacy-binary", "xml", "xml-raw"])
def test_what_vtk_itself_writes(tmp_path, how):
    vtk = pytest.importorskip("vtk", reason="no python3-vtk9")
    from vtk.util.numpy_support import numpy_to_vtk

    places = np.random.default_rng(1).standard_normal((50, 3))
    points, data, cells = vtk.vtkPoints(), vtk.vtkPolyData(), vtk.vtkCellArray()
    points.SetData(numpy_to_vtk(places, deep=1))
    for i in range(50):
        cells.InsertNextCell(1, [i])
    speeds = numpy_to_vtk(2 * places, deep=1)
    speeds.SetName("speed of it")
    data.SetPoints(points)
    data.SetVerts(cells)
    data.GetPointData().AddArray(speeds)
    legacy = how.startswith("legacy")
    writer = vtk.vtkPolyDataWriter() if legacy else vtk.vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    file = tmp_path / ("a.vtk" if legacy else "a.vtp")
    writer.SetFileName(str(file))
    if how == "legacy-binary":
        writer.SetFileTypeToBinary()
    if how == "xml-raw":
        writer.EncodeAppendedDataOff()
    assert writer.Write() == 1
    read_back = read.read(file)["points"].columns["speed of it_y"].numbers.high
    # ASCII of VTK has fewer digits than a double.
    close = 1e-9 if how == "legacy-ascii" else 0
    assert np.max(np.abs(read_back - 2 * places[:, 1])) <= close


def test_the_same_arrays_in_two_formats_agree(tmp_path, capfd):
    """And a difference is found in either."""
    a, b = tmp_path / "a.vtp", tmp_path / "b.vtp"
    a.write_bytes(xml())
    b.write_bytes(xml(form="appended_raw", compressed=True))
    assert cli.main([str(a), str(b)]) == PASS
    b.write_bytes(xml(radius=[0.5, 0.1250000001], form="binary"))
    assert cli.main([str(a), str(b)]) == DIFFERENT
    assert "points:radius" in capfd.readouterr().out


@pytest.mark.parametrize(
    "whole", [legacy_ascii(), legacy_binary(), *(xml(**h) for h in XML)]
)
def test_a_file_that_is_cut_is_refused_or_lacks_arrays(tmp_path, whole):
    """Wherever it is cut; never a traceback, and never the whole of the arrays."""
    file = tmp_path / ("a.vtk" if whole.startswith(b"#") else "a.vtp")
    for cut in range(0, len(whole) - 12, 7):
        file.write_bytes(whole[:cut])
        try:
            tables = read.read(file)
        except Problem as problem:
            assert problem.code == BAD_INPUT and str(file) in str(problem)
            continue
        points = tables.get("points")
        have = points.columns if points else {}
        last = have["radius"].numbers.high.tolist() if "radius" in have else None
        assert last != RADIUS or whole.startswith(b"# vtk") and cut > len(whole) - 16


def test_a_limit_by_the_name_of_the_array_alone(tmp_path, capfd):
    a, b = tmp_path / "a.vtk", tmp_path / "b.vtk"
    a.write_bytes(legacy_ascii())
    b.write_bytes(legacy_ascii(radius=[0.5, 0.1251]))
    assert cli.main([str(a), str(b), "--field", "radius=norm:1e-3"]) == PASS
    assert cli.main([str(a), str(b), "--field", "points:radius=norm:1e-5"]) == DIFFERENT


def test_json_names_points_and_cells(tmp_path, capfd):
    file = tmp_path / "a.vtk"
    file.write_bytes(legacy_ascii())
    assert cli.main([str(file), str(file), "--json"]) == PASS
    names = {f["field"] for f in json.loads(capfd.readouterr().out)["fields"]}
    assert names == {
        "points:points_x",
        "points:points_y",
        "points:points_z",
        "points:radius",
        "vertices:vertices",
    }
