"""Writes a whole report: the tables, figures and sections of every kind of record that the run has."""
from ulpgate_report.app import output, summary
from ulpgate_report.collisions import kind as kind_collisions
from ulpgate_report.figures import figure_style
from ulpgate_report.history import kind as kind_history
from ulpgate_report.kernels import kind as kind_kernels
from ulpgate_report.libraries import kind as kind_libraries
from ulpgate_report.math import kind as kind_math
from ulpgate_report.page import page, page_views
from ulpgate_report.pendulum import kind as kind_pendulum
from ulpgate_report.scenes import kind as kind_scenes
from ulpgate_report.stability import kind as kind_stability
from ulpgate_report.standing import kind as kind_standing
from ulpgate_report.tables import table_csv, table_latex, table_markdown
from ulpgate_report.work_precision import kind as kind_work_precision

KINDS = (
    kind_standing,
    kind_math,
    kind_kernels,
    kind_pendulum,
    kind_scenes,
    kind_collisions,
    kind_stability,
    kind_work_precision,
    kind_history,
    kind_libraries,
)
_FORMATS = {
    "csv": table_csv.render,
    "md": table_markdown.render,
    "tex": table_latex.render,
}


def parts_of(run):
    """[(kind, its data)] of what was run."""
    found = [(kind, kind.of(run)) for kind in KINDS]
    return [(kind, data) for kind, data in found if data is not None]


def _write_tables(parts, out):
    written, in_document = set(), []
    for kind, data in parts:
        for make, formats in kind.TABLES:
            table = make(data)
            for form in formats:
                name = f"{table.name}.{form}"
                output.write_text(out / name, _FORMATS[form](table))
                written.add(name)
            if "tex" in formats and table.rows:
                in_document.append(table)
    output.write_text(out / "tables.tex", table_latex.document(in_document))
    # An older report's table would pass for this run's.
    for kind in KINDS:
        for make, formats in kind.TABLES:
            for form in formats:
                if f"{make.__name__}.{form}" not in written:
                    output.remove(out / f"{make.__name__}.{form}")


def drawn_of(kind, data):
    """Yield (name, caption, figure) of all figures of a kind that exist."""
    for draw in kind.FIGURES:
        made = draw(data)
        for name, caption, figure in [made] if isinstance(made, tuple) else made:
            if figure is not None:
                yield name, caption, figure


def _remove_stale_figures(folder, drawn):
    families = tuple(family for kind in KINDS for family in kind.FAMILIES)
    for suffix in (*figure_style.SUFFIXES, "caption.txt"):
        for path in sorted(folder.glob(f"*.{suffix}")):
            name = path.name.removesuffix(f".{suffix}")
            if name.startswith(families) and name not in drawn:
                output.remove(path)


def _write_figures(parts, out):
    """Write the figures; returns the SVG text and caption of each by its name."""
    drawn = {}
    for kind, data in parts:
        for name, caption, figure in drawn_of(kind, data):
            base = out / "figures" / name
            files = figure_style.render(figure, name)
            for suffix, content in files.items():
                output.write_bytes(f"{base}.{suffix}", content)
            output.write_text(f"{base}.caption.txt", caption + "\n")
            drawn[name] = (files["svg"].decode("utf-8"), caption)
    _remove_stale_figures(out / "figures", drawn)
    return drawn


def write_report(context, parts, out, left_out=()):
    """Write all tables, figures, the page and the summary to the folder `out`.

    Returns a sentence for each thing that is left out for lack of a file; `left_out` are sentences about the input
    that the page shows too.
    """
    _write_tables(parts, out)
    data = dict(parts)
    output.write_text(
        out / "summary.json",
        summary.render(
            context,
            data.get(kind_math),
            data.get(kind_kernels),
            data.get(kind_scenes),
            data.get(kind_pendulum),
            data.get(kind_stability),
            data.get(kind_work_precision),
            data.get(kind_collisions),
        ),
    )
    drawn = _write_figures(parts, out)
    sections = [one for kind, d in parts for one in kind.sections(d, drawn)]
    if left_out:
        said = [page_views.note(sentence) for sentence in left_out]
        sections.append(page_views.section("left-out", "Left out", *said))
    curves = kind_math.distributions(data[kind_math]) if kind_math in data else None
    headlines = [kind.headline(d) for kind, d in parts]
    output.write_text(
        out / "index.html", page.render(context, headlines, sections, curves)
    )
    noting = [kind for kind in data if hasattr(kind, "notes")]
    found = [sentence for kind in noting for sentence in kind.notes(data[kind], drawn)]
    return [*left_out, *found]
