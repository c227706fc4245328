"""The report of error against run time: its tables, figures, sections of the page and what goes to the terminal."""
from ulpgate_report.page import page_views
from ulpgate_report.work_precision import (
    axes,
    drawing,
    figure_curves,
    figure_subjects,
    settings,
    tables,
)

# What is tabled, and in which formats; a table has the name of its function.
TABLES = (
    (tables.work_precision_front, ("tex", "md", "csv")),
    (tables.work_precision_types, ("tex", "md", "csv")),
    (tables.work_precision_fits, ("tex", "md", "csv")),
    (tables.work_precision_records, ("md", "csv")),
)
FIGURES = (figure_curves.draw, figure_subjects.draw)
FAMILIES = (drawing.FAMILY,)
# Of the list on the page.
MOST_ROWS = 5000
_TITLE = "Error against run time"
# Section, title, kinds of subjects, table.
_PARTS = (
    ("work-precision", _TITLE, figure_curves.KINDS, tables.work_precision_front),
    (
        "work-precision-types",
        f"{_TITLE}: functions and kernels",
        settings.OF_SUBJECTS,
        tables.work_precision_types,
    ),
)


def of(run):
    """The settings, None where none was measured."""
    if run.work_precision is None:
        return None
    return settings.made_of(run.work_precision, run.axes)


def printed(measured):
    """Tables for the terminal."""
    made = [make(measured) for make, formats in TABLES if "tex" in formats]
    return [table for table in made if table.rows]


def headline(measured):
    """What stands above everything."""
    failed = sum(settings.has_failed(row) for row in measured.rows)
    untimed = sum(axes.value(row, "seconds") is None for row in measured.rows)
    text = f"{len(measured.rows):,} settings of error against run time, {failed:,} of them failed"
    return [(text + (f", {untimed:,} not timed." if untimed else "."), False)]


def _untold(measured):
    count = measured.untold
    times = "1 time" if count == 1 else f"{count:,} times"
    return [f"work_precision_timing.jsonl: {times} of no setting; left out."] * bool(
        count
    )


def _missing(measured, drawn):
    """A sentence for each subject and pair of axes without a figure."""
    found = []
    groups = [(key, "_".join(key)) for key in measured.subjects(figure_curves.KINDS)]
    groups += [
        ((kind, None), kind)
        for kind in settings.OF_SUBJECTS
        if measured.subjects((kind,))
    ]
    for (kind, name), part in groups:
        rows = measured.of_kind(kind, name)
        shown = f"{kind} {name}" if name else f"{kind}s"
        pairs = settings.drawn_pairs(measured, rows)
        if not pairs:
            found.append(f"{shown}: neither times nor counts: nothing is drawn.")
        for pair, suffix, _ in pairs:
            if drawing.name_of(part, suffix) not in drawn:
                what = " and ".join(pair)
                found.append(f"{shown}: no setting with {what}: nothing is drawn.")
    return found


def notes(measured, drawn):
    """Sentences about what is not drawn, and times that belong to nothing."""
    return _missing(measured, drawn) + _untold(measured)


def _figures(drawn, kinds):
    """The figures of some kinds; those of one pair of axes after those of another."""
    found = []
    for kind in kinds:
        found += page_views.figures(drawn, f"{drawing.FAMILY}_{kind}", _TITLE, "")
    return [block for block in found if block["kind"] == "figure"]


def _all_settings(measured):
    """The list of all, or where a page with it would be slow a sentence."""
    table = tables.work_precision_records(measured)
    if len(table.rows) > MOST_ROWS:
        count = f"{len(table.rows):,} settings"
        return page_views.note(f"{count}: they are in {table.name}.csv.")
    return page_views.details(page_views.table_view(table), "settings")


def sections(measured, drawn):
    """The sections of the page."""
    found = []
    for name, title, kinds, make in _PARTS:
        if not measured.subjects(kinds):
            continue
        blocks = _figures(drawn, kinds)
        table = make(measured)
        if table.rows:
            blocks.append(page_views.table(page_views.table_view(table)))
        none_text = "Every setting failed, or none has both an error and a cost."
        blocks = blocks or [page_views.note(none_text)]
        found.append(page_views.section(name, title, *blocks))
    fits = tables.work_precision_fits(measured)
    if fits.rows:
        block = page_views.table(page_views.table_view(fits))
        title = f"{_TITLE}: laws of the energy error"
        found.append(page_views.section("work-precision-fits", title, block))
    blocks = [_all_settings(measured)]
    blocks += [page_views.note(said) for said in notes(measured, drawn)]
    title = f"{_TITLE}: all settings"
    found.append(page_views.section("work-precision-all", title, *blocks))
    return found
