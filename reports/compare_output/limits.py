"""What a field is held to: a class and its limit, stated by a person or derived from a wider run."""
import fnmatch
import math
import tomllib
from dataclasses import dataclass

from compare_output.problem import BAD_INPUT, Problem

CLASSES = ("exact", "ulp", "norm", "derived", "noise")
# Significand bits and the least exponent of a subnormal.
FORMATS = {
    "float": (24, -149),
    "double": (53, -1074),
    "long_double": (64, -16445),
    "float128": (113, -16494),
}
# How many times the error of REF against WIDE may OUT's be: another compiler or order of sums makes other roundings of the
# same size, seldom more than twice as large.
FACTOR = 4.0


@dataclass(frozen=True)
class Limit:
    kind: str
    value: float = 0.0
    type: str = "double"  # of class ulp: whose spacing counts

    @property
    def text(self):
        if self.kind == "ulp":
            return f"ulp:{self.value:g}" + (
                "" if self.type == "double" else f":{self.type}"
            )
        if self.kind in ("norm", "derived"):
            return f"{self.kind}:{self.value:.3g}"
        return self.kind


def parse(text, place):
    """A limit as text: exact, ulp:N[:TYPE], norm:E, derived[:FACTOR], noise."""

    def bad(why):
        raise Problem(
            BAD_INPUT,
            f"{place}: '{text}': {why}; exact, ulp:N[:TYPE], norm:E, derived[:FACTOR] and noise are known",
        )

    kind, *words = str(text).split(":")
    if kind not in CLASSES:
        bad("no class of that name")
    if kind in ("exact", "noise"):
        return Limit(kind) if not words else bad("takes no limit")
    if kind == "derived" and not words:
        return Limit(kind, FACTOR)
    if not words or len(words) > (2 if kind == "ulp" else 1):
        bad("a limit is wanted")
    try:
        value = float(words[0])
    except ValueError:
        bad("its limit is no number")
    if not (math.isfinite(value) and value >= 0):
        bad("its limit is not a finite number from 0 on")
    if len(words) == 2 and words[1] not in FORMATS:
        bad(f"TYPE is one of {', '.join(FORMATS)}")
    return Limit(kind, value, *words[1:])


def read_file(path):
    """[(pattern, Limit)] of a file of limits."""
    try:
        data = tomllib.loads(path.read_text())
        fields = data["fields"]
        return [(name, parse(text, f"{path}: {name}")) for name, text in fields.items()]
    except OSError as e:
        raise Problem(BAD_INPUT, f"{path}: {e.strerror}")
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as e:
        raise Problem(BAD_INPUT, f"{path}: {e}")
    except (KeyError, AttributeError):
        raise Problem(
            BAD_INPUT, f"{path}: a table [fields] of names and limits is wanted"
        )


class Limits:
    """Which limit a field has: the last pattern that fits its name decides."""

    def __init__(self, rules, with_wide):
        self.rules = rules
        self.with_wide = with_wide
        self.used = set()
        for pattern, limit in rules:
            if limit.kind == "derived" and not with_wide:
                raise Problem(
                    BAD_INPUT,
                    f"'{pattern}' is to be derived, which takes a third output, WIDE",
                )

    def of(self, names, column, other):
        """Of REF's column and OUT's, a field by any of its names: exact for whole numbers and texts, for others derived where there is a WIDE, else exact."""
        texts = column.numbers is None or other.numbers is None
        found = None
        for pattern, limit in self.rules:
            if any(fnmatch.fnmatchcase(name, pattern) for name in names):
                self.used.add(pattern)
                found = limit
        if found is not None:
            if texts and found.kind not in ("exact", "noise"):
                raise Problem(
                    BAD_INPUT,
                    f"field '{names[0]}' holds texts: exact or noise, not {found.text}",
                )
            return found
        if texts or (column.whole and other.whole) or not self.with_wide:
            return Limit("exact")
        return Limit("derived", FACTOR)

    def unused(self):
        return [p for p, _ in self.rules if p not in self.used]
