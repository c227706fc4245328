"""Writes a paper: tables, figures at two widths, every number plotted, findings, the document and its manifest."""
import csv
import dataclasses
import hashlib
import io
import json

from ulpgate_report.app import build, output
from ulpgate_report.figures import figure_style, plotted
from ulpgate_report.paper import (
    figure_builds,
    findings,
    fragments,
    provenance,
    source,
    tables,
)
from ulpgate_report.libraries import kind as kind_libraries
from ulpgate_report.math import kind as kind_math
from ulpgate_report.pendulum import kind as kind_pendulum
from ulpgate_report.scenes import kind as kind_scenes
from ulpgate_report.tables import table_csv

MANIFEST = "data/manifest.json"
# Of the libraries side by side what this program is linked with.
OWN_LIBRARIES = ("glibc",)
COLUMN = "_column"
# What is larger in one column is no figure for a column: heat maps of all functions, say.
MOST_COLUMN_INCHES = (3.7, 9.6)


class Writer:
    """Writes files below a folder and notes the checksum of each."""

    def __init__(self, out):
        self.out = out
        self.files = {}

    def text(self, name, text):
        """Write a text file."""
        self.data(name, text.encode("utf-8"))

    def data(self, name, content):
        """Write a file."""
        output.write_bytes(self.out / name, content)
        self.files[name] = hashlib.sha256(content).hexdigest()


def _csv(columns, rows):
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(rows)
    return text.getvalue()


def _own_tables(one):
    """Tables that only the paper has, of a chapter's run."""
    data = dict(one.parts).get(kind_math)
    if data is None:
        return []
    return [tables.types(one.context), tables.beside_published(data)]


def _tables_of(one):
    """{name: table} of a chapter."""
    found = {table.name: table for table in _own_tables(one)}
    for kind, data in one.parts:
        for make, formats in kind.TABLES:
            table = make(data)
            found[table.name] = table
    return found


def _write_table(writer, table, said, prefix):
    name = f"{prefix}{table.name}"
    whole = dataclasses.replace(table, name=name, caption=table.caption + said)
    writer.text(f"tables/{name}.tex", fragments.table(whole))
    writer.text(f"data/{name}.csv", table_csv.render(table))
    return f"tables/{name}.tex"


def _fits_column(png):
    width, height = fragments.inches(png, figure_style.PNG_DOTS_PER_INCH)
    return width <= MOST_COLUMN_INCHES[0] and height <= MOST_COLUMN_INCHES[1]


def _figures_of(one, prefix):
    """(name in the paper, caption, figure) of a chapter, drawn at the width that is in force."""
    if figure_builds.NAME in one.chapter.figures:
        for kind, data in one.parts:
            if kind is kind_scenes:
                name, caption, figure = figure_builds.draw(data)
                if figure is not None:
                    yield prefix + name, caption, figure
        return
    for kind, data in one.parts:
        for name, caption, figure in build.drawn_of(kind, data):
            if name.startswith(one.chapter.figures):
                yield name if name.startswith(
                    prefix
                ) else prefix + name, caption, figure
            else:
                figure_style.pyplot.close(figure)


def _write_figures(writer, one, said, prefix, tell):
    """All figures of a chapter at both widths, with the numbers they show; returns their fragments."""
    inputs = []
    for name, caption, figure in _figures_of(one, prefix):
        tell(f"{one.chapter.run}: {name}")
        files = figure_style.render(figure, name)
        writer.text(f"data/{name}.csv", _csv(plotted.COLUMNS, plotted.of(figure)))
        for suffix, content in files.items():
            writer.data(f"figures/{name}.{suffix}", content)
        dots = figure_style.PNG_DOTS_PER_INCH
        whole = caption + said(name)
        fragment = fragments.figure(name, whole, files["png"], dots)
        writer.text(f"figures/{name}.tex", fragment)
        writer.text(f"figures/{name}.caption.txt", whole + "\n")
        inputs.append(f"figures/{name}.tex")
    with figure_style.one_column():
        for name, _, figure in _figures_of(one, prefix):
            files = figure_style.render(figure, name + COLUMN)
            if not _fits_column(files["png"]):
                tell(f"{one.chapter.run}: {name} is for a whole page alone")
                continue
            for suffix, content in files.items():
                writer.data(f"figures/{name}{COLUMN}.{suffix}", content)
    return inputs


def _chapter(writer, one, commands, tell):
    """Write a chapter's fragments; returns their names."""
    chapter = one.chapter

    def said(name):
        command = provenance.command_of(commands, chapter.run, name)
        return provenance.sentence(one.context, command)

    # Kinds share names of tables and figures between runs of scenes.
    prefix = "" if chapter.run == "math" else f"{chapter.run}_"
    found = _tables_of(one)
    inputs = [
        _write_table(writer, found[name], said(name), prefix)
        for name in chapter.tables
        if name in found and found[name].rows
    ]
    figures = _write_figures(writer, one, said, prefix, tell)
    # Tables on their side have pages of their own: last, so that no page ends before them.
    upright = [i for i in inputs if not fragments.is_sideways(writer.out / i)]
    return upright + figures + [i for i in inputs if i not in upright]


def _results(one):
    """What a chapter's run found, in the sentences that stand above everything on its page."""
    headlines = (kind.headline(data) for kind, data in one.parts)
    return " ".join(text for said in headlines for text, _ in said)


def libraries_of(data):
    """(name, its functions) of libraries side by side; what this program calls itself is in the chapter of functions."""
    beside = data.get(kind_libraries)
    if beside is None:
        return ()
    own = [label for label in beside.labels if label in OWN_LIBRARIES]
    return [one for one in zip(beside.labels, beside.runs) if one[0] not in own]


def _write_findings(writer, runs, sources):
    documented = []
    for rows in source.claims(runs).values():
        documented += findings.of_claims(rows)
    found = []
    for one in sources:
        data = dict(one.parts)
        for _, run in libraries_of(data):
            found += findings.beyond(findings.of_functions(run), documented)
        if kind_math in data:
            found += findings.of_functions(data[kind_math])
        if kind_pendulum in data:
            found += findings.of_pendulum(data[kind_pendulum])
    found += documented
    # Commands are run where the records stand: a worker that was built there has the same name wherever that is.
    here = f"{runs.resolve()}/"
    found = [dataclasses.replace(f, command=f.command.replace(here, "")) for f in found]
    columns = ("library", "subject", "type", "says", "command")
    rows = [(f.library, f.subject, f.type, f.says, f.command) for f in found]
    writer.text(findings.FILE, _csv(columns, rows))
    writer.text("findings.tex", fragments.findings(findings.by_library(found)))
    return found


def _write_claims(writer, runs, commands):
    inputs = []
    for library, rows in source.claims(runs).items():
        table = tables.claims(rows)
        name = f"claims_{library}"
        said = f" {library}."
        if f"claims/{library}" in commands:
            command = provenance.in_code(commands[f"claims/{library}"])
            said += f" Command: {command}."
        renamed = dataclasses.replace(table, name=name)
        inputs.append(_write_table(writer, renamed, said, ""))
    return inputs


def write(runs, out, history=None, tell=lambda _: None):
    """Write the paper of the runs; returns sentences about what is left out."""
    sources, left_out = source.load(runs, history)
    commands = provenance.commands_of(runs)
    writer = Writer(out)
    chapters = []
    for one in sources:
        inputs = _chapter(writer, one, commands, tell)
        if one.chapter.run == "libraries":
            inputs += _write_claims(writer, runs, commands)
        says = f"{one.chapter.says} {_results(one)}"
        chapters.append((one.chapter.title, says, inputs))
    found = _write_findings(writer, runs, sources)
    if found:
        says = (
            f"{len(found)} findings from the records above, a function in a type each: results of the wrong kind, errors beyond {findings.LARGE_ULP:g} ULP, "
            "documented bounds that do not hold, and constants of too few digits; types and symbols of one function are told together, with the command that shows "
            "the worst. Some errors are what a library promises and no more; none is what a user expects."
        )
        chapters.append(("Findings", says, ["findings.tex"]))
    context = sources[0].context
    version = context.get("tool", {}).get("version", "")
    abstract = f"{sources[0].chapter.title}: {_results(sources[0])} "
    if found:
        abstract += f"{len(found)} findings, each with a command that shows it, are in the last section. "
    abstract += (
        f"Every number is from records that stand beside this document; `scripts/paper --check` traces each to its record. "
        f"Made on {provenance.machine(context)}."
    )
    if left_out:
        abstract += " Not in this paper: " + " ".join(left_out)
    writer.text("paper.tex", fragments.document(version, abstract, chapters))
    manifest = {"commands": commands, "files": dict(sorted(writer.files.items()))}
    output.write_text(out / MANIFEST, json.dumps(manifest, indent=1) + "\n")
    return left_out
