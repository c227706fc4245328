"""Tables of a file, by what its name or its first bytes say it is."""
from compare_output import read_csv, read_hdf5, read_vtk, read_vtk_xml
from compare_output.problem import BAD_INPUT, ENVIRONMENT, Problem

_XML = {".vtp", ".vtu", ".vti", ".vtr", ".vts"}
_HDF5 = {".h5", ".hdf5", ".hdf"}
SUFFIXES = {".csv", ".tsv", ".txt", ".dat", ".vtk"} | _XML | _HDF5
_HDF5_SIGNATURE = b"\x89HDF\r\n\x1a\n"


def read(path):
    """{what its rows are: Table}; a Problem where it cannot be read or understood."""
    try:
        if path.is_dir():
            raise Problem(BAD_INPUT, f"{path}: a directory, where a file is wanted")
        with path.open("rb") as file:
            first = file.read(512)
    except FileNotFoundError:
        raise Problem(BAD_INPUT, f"{path}: no such file")
    except OSError as e:
        raise Problem(ENVIRONMENT, f"{path}: {e.strerror}")
    if not first:
        raise Problem(BAD_INPUT, f"{path}: empty")
    if first.startswith(_HDF5_SIGNATURE) or path.suffix in _HDF5:
        return read_hdf5.read(path)
    if first.startswith(b"# vtk DataFile"):
        return read_vtk.read(path)
    if path.suffix in _XML or b"<VTKFile" in first:
        return read_vtk_xml.read(path)
    return read_csv.read(path)
