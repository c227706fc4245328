"""The report of error against run time: its tables, figures, sections of the page and what goes to the terminal."""
from ulpgate_report.page import page_views
from ulpgate_report.values import numbers
from ulpgate_report.work_precision import (
    axes,
    drawing,
    figure_curves,
    figure_fits,
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
FIGURES = (figure_curves.draw, figure_subjects.draw, figure_fits.draw)
FAMILIES = (drawing.FAMILY,)
# Of the list on the page.
MOST_ROWS = 5000
_TITLE = "Error against run time"


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


def _anchor(place):
    """The anchor of a row of the table of fronts."""
    return f"work-precision-{place}"


def _hover(found):
    _, row = found
    lines = [
        f"{row['name']}, {row['type']}: {settings.method(row)}, {row['steps']:,} steps",
        f"{numbers.short_real(row.get('seconds'))} s, {row['evaluations']:,} evaluations",
    ]
    return "\n".join(lines)


def _fronts(measured):
    """Blocks: the least errors, each a link to its setting in the table of fronts, and that table."""
    table = page_views.table_view(tables.work_precision_front(measured))
    if not table["rows"]:
        return []
    page_views.anchor_rows(table, map(_anchor, range(len(table["rows"]))))
    least = tables.least_errors(measured).values()
    matrix = page_views.heat_view(
        tables.work_precision_matrix(measured),
        page_views.cells_by_type(least, measured.type_tokens),
        lambda found: None,
        _hover,
        None,
        lambda found: _anchor(found[0]),
    )
    return [page_views.table(matrix), page_views.table(table)]


def _types(measured):
    """A block: functions and kernels by type."""
    table = page_views.table_view(tables.work_precision_types(measured))
    return [page_views.table(table)] if table["rows"] else []


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
    # Section, title, kinds of subjects, tables.
    of_subjects = (f"{_TITLE}: functions and kernels", settings.OF_SUBJECTS, _types)
    for name, title, kinds, make in (
        ("work-precision", _TITLE, figure_curves.KINDS, _fronts),
        ("work-precision-types", *of_subjects),
    ):
        if not measured.subjects(kinds):
            continue
        blocks = _figures(drawn, kinds) + make(measured)
        none_text = "Every setting failed, or none has both an error and a cost."
        blocks = blocks or [page_views.note(none_text)]
        found.append(page_views.section(name, title, *blocks))
    fits = tables.work_precision_fits(measured)
    if fits.rows:
        blocks = _figures(drawn, (figure_fits.PART,))
        blocks.append(page_views.table(page_views.table_view(fits)))
        title = f"{_TITLE}: laws of the error"
        found.append(page_views.section("work-precision-fits", title, *blocks))
    blocks = [_all_settings(measured)]
    blocks += [page_views.note(said) for said in notes(measured, drawn)]
    title = f"{_TITLE}: all settings"
    found.append(page_views.section("work-precision-all", title, *blocks))
    return found
