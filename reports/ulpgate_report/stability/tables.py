"""The tables of the stiff and extreme cases as plain data."""
import re
from dataclasses import dataclass

from ulpgate_report.records import stress_records as records
from ulpgate_report.stability import verdicts
from ulpgate_report.tables.table import Column, Judged, Table, columns_of
from ulpgate_report.values import numbers

_CASE = Column("case", "case", "code")
_TYPE = Column("type", "type", "code")
_VERDICT = Column("verdict", "verdict", "text")
_SIZES = ("error", "stepping_error", "condition", "correct_digits")
_ALL_KINDS = "all"
# A wrong outcome says more than an unstable one, and a refusal may be the right answer.
_GRAVITY = ("wrong_outcome", "diverged", "unstable", "refused")


@dataclass(frozen=True)
class Lettered(Judged):
    """The letter of a verdict; what is not known of the case is marked."""

    good: str = "as known"
    mark_name = "standing"


def _standing(row):
    return "as known" if row["as_known"] else "new"


def _matrix(stress, kind, name, caption):
    tokens = stress.type_tokens
    cut = len(kind) + 1 if kind else 0
    rows = []
    for key, of_type in stress.of_kind(kind).items():
        cells = (of_type.get(token) for token in tokens)
        letters = [
            row and Lettered(verdicts.BY_NAME[row["verdict"]].letter, _standing(row))
            for row in cells
        ]
        rows.append((key[cut:], *letters))
    columns = (_CASE, *(Column(token, token, "text") for token in tokens))
    return Table(name, caption, columns, tuple(rows))


def stress_matrix(stress):
    """The verdict of each case in each type, as a letter."""
    caption = (
        f"Stiff and extreme cases: {verdicts.LEGEND}. Marked new: not as known of the case, or where "
        "nothing is known neither stable nor ill-conditioned."
    )
    return _matrix(stress, None, "stress_matrix", caption)


def kind_matrix(stress, kind):
    """The same of one kind, for the page: each letter is a link to its record."""
    words = kind.replace("_", " ")
    caption = f"{words.capitalize()}: {verdicts.LEGEND}. A letter leads to its record with the command that shows it."
    return _matrix(stress, kind, f"stress_matrix_{kind}", caption)


def stress_counts(stress):
    """How many cases of each kind have which verdict."""
    rows = []
    for kind in (_ALL_KINDS, *stress.kinds):
        for token in stress.type_tokens:
            mine = [
                row
                for row in stress.rows
                if row["type"] == token and kind in (_ALL_KINDS, row["kind"])
            ]
            if mine:
                found = [row["verdict"] for row in mine]
                counts = (found.count(verdict.name) for verdict in verdicts.ALL)
                new = sum(not row["as_known"] for row in mine)
                rows.append((kind.replace("_", " "), token, len(mine), *counts, new))
    columns = (
        Column("kind", "kind", "text"),
        _TYPE,
        Column("cases", "cases", "count"),
        *(Column(v.name, v.words, "count") for v in verdicts.ALL),
        Column("new", "not as known", "count"),
    )
    caption = (
        "Cases of each kind by type and verdict. Unstable: the error of rounding is above 16 times condition times "
        "roundoff; ill-conditioned: below it, but the condition costs more than half of the digits; wrong outcome: another "
        "contact, sign, branch or count than the truth has, or a law broken; diverged: not finite, or far beyond what is conserved; refused: an error that says "
        "why. A case whose numbers a type does not have, or that is made for other types, is not there."
    )
    return Table("stress_counts", caption, columns, tuple(rows))


def _types(rows, of_type):
    """The types of some rows: `all` where there is no other of the case."""
    if len(rows) == len(of_type) > 1:
        return "all"
    return ", ".join(row["type"] for row in rows)


def _capitalised(text):
    """As a sentence begins, unless that is a symbol or a name: v + a dt, sphere[0].radius."""
    is_word = re.match(r"[a-z-]{2,}( |:|,|$)", text) or text.startswith("a ")
    return text[0].upper() + text[1:] if is_word else text


def _reason(cause, row):
    """Sentences: why it is known to be, what was found, and where it goes wrong first."""
    wrong = row["first_wrong"] and f"first wrong: {row['first_wrong']}"
    parts = [p.rstrip(". ") for p in (cause, row["why"], wrong) if p]
    return " ".join(_capitalised(p) + "." for p in parts) or None


def stress_findings(stress):
    """Every case that is neither stable nor ill-conditioned or not as known, types of one verdict and cause together."""
    groups, of_case = {}, stress.of_kind(None)
    for row in stress.rows:
        if row["verdict"] not in verdicts.GOOD or not row["as_known"]:
            key = (records.key_of(row), row["verdict"], row["cause"])
            groups.setdefault((*key, row["as_known"]), []).append(row)
    rows = []
    for (case, verdict, cause, known), mine in groups.items():
        first = mine[0]
        rows.append(
            (
                _standing(first),
                case,
                _types(mine, of_case[case]),
                verdicts.BY_NAME[verdict].words,
                None if known else verdicts.BY_NAME[first["expected"]].words,
                _reason(cause, first),
                first["reproducer"] or None,
            )
        )
    order = [verdicts.BY_NAME[name].words for name in _GRAVITY]
    order += [verdicts.BY_NAME[name].words for name in verdicts.GOOD]
    rows.sort(key=lambda row: (row[0] != "new", order.index(row[3])))
    columns = (
        Column("standing", "standing", "text"),
        _CASE,
        Column("types", "types", "prose"),
        _VERDICT,
        Column("expected", "expected", "text"),
        Column("cause", "cause", "prose"),
        Column("reproducer", "command", "command"),
    )
    caption = (
        "Every case whose verdict is neither stable nor ill-conditioned, or is not the known one. The new "
        "ones come first, then those whose cause is known; numbers, first wrong place and command are of the first type named."
    )
    return Table("stress_findings", caption, columns, tuple(rows))


def _figures(row):
    found = {n: numbers.signed(row["figures"][n]) for n in sorted(row["figures"])}
    texts = (f"{name} {numbers.short_real(value)}" for name, value in found.items())
    return "; ".join(texts) or None


def stress_records(stress):
    """Every record, with the command that shows it alone."""
    rows = [
        (
            row["kind"].replace("_", " "),
            row["case"],
            row["form"] or None,
            row["type"],
            verdicts.BY_NAME[row["verdict"]].words,
            verdicts.BY_NAME[row["expected"]].words,
            *(numbers.signed(row[name]) for name in _SIZES),
            row["roundoff"],
            row["first_wrong"] or None,
            row["cause"] or None,
            row["why"] or None,
            row["reproducer"] or None,
            _figures(row),
            row["title"],
        )
        for row in stress.rows
    ]
    columns = (
        Column("kind", "kind", "text"),
        _CASE,
        Column("form", "form", "code"),
        _TYPE,
        _VERDICT,
        Column("expected", "expected", "text"),
        *columns_of(
            "real",
            error="error",
            stepping_error="error of the step",
            condition="condition",
            correct_digits="correct digits",
            roundoff="u",
        ),
        *columns_of("prose", first_wrong="first wrong", cause="cause", why="why"),
        Column("reproducer", "command", "command"),
        *columns_of("prose", figures="further numbers", title="what it is"),
    )
    caption = (
        "Every case in every type: error of rounding (relative, normwise), error of the time step in exact arithmetic, "
        "condition number, digits of the result that are right, unit roundoff u, and the command that shows it alone."
    )
    return Table("stress_records", caption, columns, tuple(rows))
