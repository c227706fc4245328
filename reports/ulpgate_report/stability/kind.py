"""The report of stiff and extreme cases: its tables, figures, sections of the page and what goes to the terminal."""
import re

from ulpgate_report.page import page_views
from ulpgate_report.records import stress_records as records
from ulpgate_report.stability import figure_matrix, tables, verdicts
from ulpgate_report.values import numbers

# What is tabled, and in which formats; a table has the name of its function.
TABLES = (
    (tables.stress_matrix, ("tex", "md", "csv")),
    (tables.stress_counts, ("tex", "md", "csv")),
    (tables.stress_findings, ("tex", "md", "csv")),
    (tables.stress_records, ("md", "csv")),
)
FIGURES = (figure_matrix.draw,)
FAMILIES = ("stability",)


def of(run):
    """The cases, None where none was run."""
    return run.stress


def printed(stress):
    """Tables for the terminal."""
    made = [make(stress) for make in (tables.stress_counts, tables.stress_findings)]
    return [tables.stress_matrix(stress), *(table for table in made if table.rows)]


def headline(stress):
    """What stands above everything."""
    found = [row["verdict"] for row in stress.rows]
    new = sum(not row["as_known"] for row in stress.rows)
    counts = ((v.words, found.count(v.name)) for v in verdicts.ALL)
    cases = len(stress.of_kind(None))
    text = f"{cases:,} stiff and extreme cases, {len(found):,} runs: "
    text += ", ".join(f"{count:,} {words}" for words, count in counts if count)
    if not new:
        return [(f"{text}; all as known.", False)]
    return [(f"{text};", False), (f"{new:,}", True), ("not as known.", False)]


def anchors(stress):
    """{(key of a case, type): its anchor on the page}, each another."""
    found, taken = {}, set()
    for row in stress.rows:
        key = (records.key_of(row), row["type"])
        plain = re.sub(r"[^A-Za-z0-9_.-]+", "-", "-".join(("stress", *key)))
        name, count = plain, 1
        while name in taken:
            count += 1
            name = f"{plain}-{count}"
        taken.add(name)
        found[key] = name
    return found


def _hover(row):
    def sized(name):
        return numbers.short_real(numbers.signed(row[name]))

    lines = [
        f"{records.key_of(row)}, {row['type']}: {verdicts.BY_NAME[row['verdict']].words}",
        f"error {sized('error')}, condition {sized('condition')}, u {sized('roundoff')}, "
        f"{sized('correct_digits')} correct digits",
        row["first_wrong"] and f"first wrong: {row['first_wrong']}",
        row["why"],
        row["cause"],
    ]
    return "\n".join(filter(None, lines))


def _matrix_block(stress, kind, names):
    """The table of a kind: coloured letters, each a link to its record."""
    view = page_views.heat_view(
        tables.kind_matrix(stress, kind),
        page_views.cells_by_type(stress.of_kind(kind).values(), stress.type_tokens),
        lambda row: verdicts.BY_NAME[row["verdict"]].letter,
        _hover,
        verdicts.Scale,
        lambda row: names[records.key_of(row), row["type"]],
    )
    return page_views.table(view)


def sections(stress, drawn):
    """The sections of the page; the figures are those of the coloured tables."""
    names = anchors(stress)
    view = page_views.table_view
    all_view = view(tables.stress_records(stress))
    page_views.anchor_rows(all_view, names.values())
    none_bad = "Every case is stable or ill-conditioned."
    return [
        page_views.section(
            "stability",
            "Stability",
            page_views.table(view(tables.stress_counts(stress))),
            *(_matrix_block(stress, kind, names) for kind in stress.kinds),
        ),
        page_views.section(
            "stability-findings",
            "Stability: what to look at",
            page_views.table(view(tables.stress_findings(stress)), none_bad),
        ),
        page_views.section(
            "stability-all",
            "Stability: all records",
            page_views.details(all_view, "records"),
        ),
    ]
