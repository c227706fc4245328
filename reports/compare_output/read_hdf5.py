"""HDF5 by h5py, where that is installed: a table for each dataset, its first axis the rows."""
import numpy as np

from compare_output.problem import BAD_INPUT, ENVIRONMENT, Problem
from compare_output.tables import Column, Table


def _texts(data):
    return [x.decode() if isinstance(x, bytes) else str(x) for x in data.ravel()]


def read(path):
    """{name of a dataset: Table}."""
    try:
        import h5py
    except ImportError:
        raise Problem(
            ENVIRONMENT,
            f"{path}: HDF5 is read by h5py, which is not here (in Debian: python3-h5py)",
        )
    tables = {}

    def take(name, item):
        if not isinstance(item, h5py.Dataset):
            return
        data = np.atleast_1d(item[()])
        table = Table(f"{path} ({name})")
        leaf = name.rsplit("/", 1)[-1]
        if data.dtype.names:
            for field in data.dtype.names:
                _add(table, field, data[field])
        else:
            _add(table, leaf, data)
        tables[name] = table

    def _add(table, name, data):
        if data.dtype.kind in "SOU":
            table.add(Column(name, None, _texts(data)))
        elif data.dtype.kind in "fiub":
            table.add_array(name, data.astype(np.int8) if data.dtype == bool else data)
        else:
            raise Problem(
                BAD_INPUT,
                f"{table.file}: values of type {data.dtype} are not known here",
            )

    try:
        with h5py.File(path, "r") as file:
            file.visititems(take)
    except OSError as e:
        raise Problem(BAD_INPUT, f"{path}: {e}")
    return tables
