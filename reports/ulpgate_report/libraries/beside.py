"""Several runs of the same functions, one a library."""
import collections
from dataclasses import dataclass

from ulpgate_report.math import combine


@dataclass(frozen=True)
class Beside:
    """The runs in their order: `labels` name the libraries, `runs` are combined; both have one entry a library."""

    labels: tuple
    runs: tuple

    @property
    def type_tokens(self):
        """Types that any of the runs has, in the order in which they come."""
        return tuple(dict.fromkeys(t for run in self.runs for t in run.type_tokens))

    def rows_of(self, token):
        """Rows that any of the runs has in this type."""
        found = {}
        for run in self.runs:
            for row in run.rows:
                if (row, token) in run.cells:
                    found[row] = None
        return tuple(found)


def without_symbol(implementation):
    """The library alone: "libsleef.so.3.5.1" of "libsleef.so.3.5.1 Sleef_sin_u10"."""
    # A function of a library ends with its symbol, this program's own with a version.
    first, _, last = implementation.rpartition(" ")
    return implementation if not first or last[0].isdigit() else first


def library_of(records):
    """What most implementations of a run have in common: "libsleef.so.3.5.1", "glibc 2.36"."""
    counts = collections.Counter(without_symbol(r["implementation"]) for r in records)
    return counts.most_common(1)[0][0]


def _told_apart(labels):
    """The same labels, numbered where several are the same."""
    return tuple(
        f"{label} ({labels[: i + 1].count(label)})"
        if labels.count(label) > 1
        else label
        for i, label in enumerate(labels)
    )


def of(runs, names):
    """`runs` as they were read; a name of None is made from the records."""
    labels = [name or library_of(run.math) for run, name in zip(runs, names)]
    return Beside(_told_apart(labels), tuple(combine.combine_run(run) for run in runs))
