"""Holds OUT to REF, field by field, and where there is a WIDE both to that."""
from dataclasses import dataclass, field

import numpy as np

from compare_output import tables
from compare_output.limits import FORMATS
from compare_output.problem import BAD_INPUT, Problem

# The unit roundoff of a double: a value written and read as one is not known better.
_DOUBLE = 2.0**-53


@dataclass
class Digits:
    """How many leading decimal digits agree, -log10 of the relative difference; inf where all do."""

    least: float
    one_percent: float
    median: float

    @staticmethod
    def of(digits):
        if len(digits) == 0:
            return None
        ordered = np.sort(digits)
        n = len(ordered)
        return Digits(
            float(ordered[0]),
            float(ordered[(n - 1) // 100]),
            float(ordered[(n - 1) // 2]),
        )


@dataclass
class FieldResult:
    name: str  # 'points:radius' of a VTK file
    limit: object
    rows: int
    different: int = 0
    # Values that are NaN or infinite in one and not, or otherwise, in the other.
    not_finite: int = 0
    failed_rows: np.ndarray = None
    measured: float | None = None  # in the unit of the limit
    allowed: float | None = None
    digits: Digits | None = None
    digits_ref: Digits | None = None  # against WIDE
    digits_out: Digits | None = None
    error_ref: float | None = None  # largest, of the largest value of the field
    error_out: float | None = None
    difference: float | None = None
    worst: int | None = None  # row of the largest difference
    column: str = ""  # 'radius'

    @property
    def failed(self):
        return self.limit.kind != "noise" and bool(self.failed_rows.any())

    @property
    def whose(self):
        """Whose error a difference is: REF's or OUT's where one errs ten times as much, else of both."""
        if self.error_ref is None or not self.different:
            return ""
        if self.error_ref > 10 * self.error_out:
            return "REF"
        return "OUT" if self.error_out > 10 * self.error_ref else "both"


def _agree_in_kind(a, b):
    """Where both are finite, both NaN, or the same infinity."""
    same = np.isfinite(a.high) & np.isfinite(b.high)
    with np.errstate(invalid="ignore"):
        return same | (np.isnan(a.high) & np.isnan(b.high)) | (a.high == b.high)


def _digits(difference, a, b):
    """Of the values that are finite in both."""
    size = np.maximum(np.abs(a.high), np.abs(b.high))
    finite = ~np.isnan(
        difference
    )  # infinite: beyond the range of a double, so nothing agrees
    with np.errstate(divide="ignore", invalid="ignore"):
        digits = -np.log10(np.abs(difference[finite]) / size[finite])
    digits[difference[finite] == 0] = np.inf
    return np.maximum(digits, 0)


def _largest(values):
    """Of sizes; NaN stands for what is no difference of numbers and is judged by its kind."""
    finite = values[~np.isnan(values)]
    return float(np.max(np.abs(finite))) if len(finite) else 0.0


def _spacing(values, type_name):
    """Distance of neighbours of the type at these values."""
    bits, least = FORMATS[type_name]
    _, exponent = np.frexp(values)
    return np.ldexp(1.0, np.maximum(exponent - bits, max(least, -1074)))


def _scale(numbers):
    return _largest(numbers.high[np.isfinite(numbers.high)])


def judge_texts(name, limit, ref, out):
    different = np.array([a != b for a, b in zip(ref, out, strict=True)], dtype=bool)
    result = FieldResult(name, limit, len(ref), int(different.sum()))
    result.failed_rows = different
    return result


def judge_numbers(name, limit, ref, out, wide):
    difference = out.minus(ref)
    in_kind = _agree_in_kind(ref, out)
    # NaN beside NaN is no difference, and the difference of two equal infinities is none either.
    size = np.where(np.isnan(difference), 0.0, np.abs(difference))
    r = FieldResult(name, limit, len(ref))
    r.not_finite = int((~in_kind).sum())
    r.different = int(((size != 0) | ~in_kind).sum())
    r.digits = Digits.of(_digits(difference, ref, out))
    scale = _scale(ref) or _scale(out) or 1.0
    r.difference = _largest(size) / scale
    if len(ref):
        r.worst = int(np.argmax(np.where(in_kind, size, np.inf)))
    failed = size != 0
    if wide is not None:
        in_kind &= _agree_in_kind(out, wide)
        errors = [np.abs(x.minus(wide)) for x in (ref, out)]
        whole = _scale(wide) or scale
        r.error_ref, r.error_out = (_largest(e) / whole for e in errors)
        r.digits_ref, r.digits_out = (
            Digits.of(_digits(e, x, wide))
            for e, x in zip(errors, (ref, out), strict=True)
        )
    if limit.kind == "ulp":
        with np.errstate(invalid="ignore"):
            ulps = size / _spacing(np.where(in_kind, ref.high, 0.0), limit.type)
        r.measured, r.allowed = _largest(ulps), limit.value
        failed = ulps > limit.value
    elif limit.kind == "norm":
        r.measured, r.allowed = r.difference, limit.value
        failed = size > limit.value * scale
    elif limit.kind == "derived":
        r.measured = r.error_out
        r.allowed = limit.value * r.error_ref + _DOUBLE
        error = np.where(np.isnan(errors[1]), 0.0, errors[1])
        failed = error > r.allowed * whole
    r.failed_rows = failed | ~in_kind
    return r


@dataclass
class Comparison:
    """All fields of one table of REF and OUT."""

    name: str  # "points" of a VTK file; empty of a CSV file
    ref: object
    out: object
    wide: object
    matched: object
    fields: list = field(default_factory=list)
    only_in_ref: list = field(default_factory=list)  # fields
    only_in_out: list = field(default_factory=list)

    @property
    def failed(self):
        rows = self.matched.only_in[0] or self.matched.only_in[1]
        return bool(
            rows
            or self.only_in_ref
            or self.only_in_out
            or any(f.failed for f in self.fields)
        )

    def add(self, result, column):
        result.column = column
        self.fields.append(result)

    def first_parting(self):
        """(row, fields) of the first record that is beyond its limit; None where all hold."""
        rows = [int(np.argmax(f.failed_rows)) for f in self.fields if f.failed]
        if not rows:
            return None
        row = min(rows)
        return row, [f for f in self.fields if f.failed and f.failed_rows[row]]

    def values_at(self, field_name, row):
        """[(who, value, where)] of a field."""
        shown = []
        sources = (("REF", self.ref), ("OUT", self.out), ("WIDE", self.wide))
        for (who, table), rows in zip(sources, self.matched.rows, strict=False):
            column = table.columns.get(field_name) if table is not None else None
            if column is not None:
                at = int(rows[row])
                shown.append((who, column.shown(at), table.where(at)))
        return shown

    def row_name(self, row):
        return tables.name_of(
            self.ref, self.matched.key, int(self.matched.rows[0][row])
        )


def compare(name, ref, out, wide, limits, key):
    """Comparison of two tables, and of a third where it is not None."""
    given = [t for t in (ref, out, wide) if t is not None]
    matched = tables.match(given, key)
    if wide is not None and len(matched.rows[0]) < min(ref.rows, out.rows):
        missing = ref.rows - len(matched.rows[0])
        raise Problem(
            BAD_INPUT,
            f"{wide.file}: {missing} of the {ref.rows} rows of {ref.file} are not in it or not in OUT: no error can be derived",
        )
    c = Comparison(name, ref, out, wide, matched)
    for field_name, column in ref.columns.items():
        if field_name in matched.key:
            continue
        other = out.columns.get(field_name)
        full = f"{name}:{field_name}" if name else field_name
        if other is None:
            c.only_in_ref.append(full)
            continue
        limit = limits.of((full, field_name), column, other)
        rows = matched.rows
        if column.numbers is None or other.numbers is None:
            texts = [
                [x.shown(int(i)) for i in which]
                for x, which in ((column, rows[0]), (other, rows[1]))
            ]
            c.add(judge_texts(full, limit, *texts), field_name)
            continue
        third = None
        if wide is not None:
            widest = wide.columns.get(field_name)
            if widest is not None and widest.numbers is not None:
                third = widest.numbers.take(rows[2])
            elif limit.kind == "derived":
                raise Problem(
                    BAD_INPUT, f"{wide.file}: no numbers of the field '{field_name}'"
                )
        numbers = (column.numbers.take(rows[0]), other.numbers.take(rows[1]))
        c.add(judge_numbers(full, limit, *numbers, third), field_name)
    c.only_in_out = [
        f"{name}:{n}" if name else n for n in out.columns if n not in ref.columns
    ]
    return c
