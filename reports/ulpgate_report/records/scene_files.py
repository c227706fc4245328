"""Which scene, type and step a file of series/ or snapshots/ belongs to, told by its name."""
import re

_TYPE = r"(?:float128|float|long_double|double|mpfr\d+|cpp_bin_float\d+)"
_BY_PATTERN = re.compile(rf"^(?P<scene>.+?)_(?P<type>{_TYPE})$")
_STEP = re.compile(r"^(?P<rest>.+)_(?P<step>\d+)$")
_DIVERGENCE = "divergence_"


def split_name(stem, known):
    """(scene, type) of `SCENE_TYPE`, or None; `known` has the pairs that the records name.

    Both halves may hold underscores, so a known pair decides, and else the longest name of a type.
    """
    for scene, token in known:
        if stem == f"{scene}_{token}":
            return scene, token
    found = _BY_PATTERN.match(stem)
    return (found["scene"], found["type"]) if found else None


def find(directory, known):
    """(series, divergences, snapshots, names that tell nothing) of a run directory.

    The first two have a path by (scene, type), the third a list of (step, path), ascending.
    """
    series, divergences, snapshots, unknown = {}, {}, {}, []
    for path in sorted((directory / "series").glob("*.csv")):
        of_divergence = path.stem.startswith(_DIVERGENCE)
        stem = path.stem[len(_DIVERGENCE) :] if of_divergence else path.stem
        key = split_name(stem, known)
        if key is None:
            unknown.append(f"series/{path.name}")
        else:
            (divergences if of_divergence else series)[key] = path
    for path in sorted((directory / "snapshots").glob("*.csv")):
        parts = _STEP.match(path.stem)
        key = split_name(parts["rest"], known) if parts else None
        if key is None:
            unknown.append(f"snapshots/{path.name}")
        else:
            snapshots.setdefault(key, []).append((int(parts["step"]), path))
    for found in snapshots.values():
        found.sort()
    return series, divergences, snapshots, unknown
