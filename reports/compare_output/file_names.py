"""Files of two directories that belong together: by the same name, or by names that differ in the type of the numbers alone."""
import re

# As ulpgate writes them, and as other programs do: a word of its own within the name.
_TYPE = re.compile(
    r"(?<![A-Za-z0-9])(?:long[_-]double|float128|float64|float32|float|double|half|quad"
    r"|mpfr\d+|cpp_bin_float\d+)(?![A-Za-z0-9])"
)


def _by_pattern(names):
    """{name without its type: name}, of names that no other of them is taken for."""
    patterns = {}
    for name in names:
        patterns.setdefault(_TYPE.sub("*", str(name)), []).append(name)
    return {p: of[0] for p, of in patterns.items() if len(of) == 1}


def counterparts(names, others):
    """{name: the one of `others` that belongs to it}.  A directory that holds one file in several types says by their names alone
    which is which: there a type in a name is no other file's."""
    found = {name: name for name in names if name in others}
    left, of_others = _by_pattern(names), _by_pattern(others)
    taken = set(found.values())
    for pattern, name in left.items():
        other = of_others.get(pattern)
        if name not in found and other is not None and other not in taken:
            found[name] = other
    return found
