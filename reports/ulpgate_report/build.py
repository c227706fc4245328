"""Writes a whole report: one row below for each thing that is made."""
from ulpgate_report import (
    figure_distributions,
    figure_error_vs_time,
    figure_heatmap,
    figure_style,
    output,
    page,
    summary,
    table_csv,
    table_latex,
    table_markdown,
    tables,
)

_FORMATS = {
    "csv": table_csv.render,
    "md": table_markdown.render,
    "tex": table_latex.render,
}
# What is tabled, and in which formats.
TABLES = (
    (tables.paper_table, ("tex", "md", "csv")),
    (tables.ulp_matrix, ("tex", "md", "csv")),
    (tables.ulp_table, ("tex", "md", "csv")),
    (tables.long_table, ("md", "csv")),
    (tables.mismatch_table, ("md", "csv")),
)
# What is drawn: each gives (name, caption, figure or None where there is nothing to draw).
FIGURES = (
    figure_heatmap.draw,
    figure_error_vs_time.draw,
    figure_distributions.draw_real,
    figure_distributions.draw_complex,
    figure_distributions.draw_special,
)


def _write_tables(combined, out):
    in_document = []
    for make, formats in TABLES:
        table = make(combined)
        for form in formats:
            output.write_text(out / f"{table.name}.{form}", _FORMATS[form](table))
        if "tex" in formats:
            in_document.append(table.name)
    output.write_text(out / "tables.tex", table_latex.document(in_document))


def _write_figures(combined, out):
    """Write the figures; returns the SVG text and caption of each by its name."""
    drawn = {}
    for draw in FIGURES:
        name, caption, figure = draw(combined)
        base = out / "figures" / name
        if figure is None:
            # An older report's figure would pass for this run's.
            for suffix in (*figure_style.SUFFIXES, "caption.txt"):
                output.remove(f"{base}.{suffix}")
            continue
        files = figure_style.render(figure, name)
        for suffix, data in files.items():
            output.write_bytes(f"{base}.{suffix}", data)
        output.write_text(f"{base}.caption.txt", caption + "\n")
        drawn[name] = (files["svg"].decode("utf-8"), caption)
    return drawn


def write_report(combined, out):
    """Write all tables, figures, the page and the summary to the folder `out`."""
    _write_tables(combined, out)
    output.write_text(out / "summary.json", summary.render(combined))
    drawn = _write_figures(combined, out)
    output.write_text(out / "index.html", page.render(combined, drawn))
