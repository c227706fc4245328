"""The report of the scenes: its tables, figures, sections of the page and what goes to the terminal."""
from ulpgate_report.page import page_views
from ulpgate_report.scenes import (
    figure_benchmark,
    figure_divergence,
    figure_energy,
    figure_snapshots,
    tables,
)

# What is tabled, and in which formats; a table has the name of its function.
TABLES = (
    (tables.scene_table, ("tex", "md", "csv")),
    (tables.scene_states, ("tex", "md", "csv")),
    (tables.energy_table, ("tex", "md", "csv")),
    (tables.divergence_table, ("tex", "md", "csv")),
    (tables.benchmark_table, ("tex", "md", "csv")),
)
# What is drawn: each yields (name, caption, figure) for the scenes that have what it needs.
FIGURES = (
    figure_snapshots.draw,
    figure_divergence.draw,
    figure_energy.draw,
    figure_benchmark.draw,
)
FAMILIES = ("snapshots", "divergence", "energy", "benchmark")
# Section, title, family of figures, table, and what is said where there is neither.
_PARTS = (
    ("scenes", "Scenes", "snapshots", tables.scene_table),
    ("scene-divergence", "Divergence", "divergence", tables.divergence_table),
    ("scene-energy", "Energy", "energy", tables.energy_table),
    ("scene-benchmark", "Speed", "benchmark", tables.benchmark_table),
    ("scene-states", "States", None, tables.scene_states),
)
_MISSING = {
    "snapshots": "No snapshots/SCENE_TYPE_STEP.csv with a sphere: the bodies are not drawn.",
    "divergence": "No series/divergence_SCENE_TYPE.csv with a difference: no divergence is drawn.",
    "energy": "No series/SCENE_TYPE.csv with a row: no energy is drawn.",
    "benchmark": "No line of a scene in timing.jsonl: no speed is drawn.",
}


def of(run):
    """The scenes, None where none was run."""
    return run.scenes


def printed(scenes):
    """Tables for the terminal."""
    made = [make(scenes) for make in (tables.scene_table, tables.scene_states)]
    made += [make(scenes) for make in (tables.divergence_table, tables.benchmark_table)]
    return [table for table in made if table.rows]


def headline(scenes):
    """What stands above everything."""
    bodies = max((record["bodies"] for record in scenes.records), default=0)
    count, types = len(scenes.names), len(scenes.type_tokens)
    text = f"{count} scene{'s' * (count != 1)} in {types} type{'s' * (types != 1)}"
    return [(text + (f", up to {bodies:,} bodies." if bodies else "."), False)]


def _left_out(scenes):
    return [
        f"{name}: the name tells no scene and type; left out."
        for name in scenes.unknown
    ]


def _is_drawn(family, drawn):
    return any(name.startswith(f"{family}_") for name in drawn)


def notes(scenes, drawn):
    """A sentence for each family of figures without a figure, and for each file whose name tells nothing."""
    missing = [
        sentence
        for family, sentence in _MISSING.items()
        if family not in scenes.not_missed and not _is_drawn(family, drawn)
    ]
    return missing + _left_out(scenes)


def sections(scenes, drawn):
    """The sections of the page."""
    found = []
    for name, title, family, make in _PARTS:
        blocks = []
        table = make(scenes)
        if table.rows:
            blocks.append(page_views.table(page_views.table_view(table)))
        if family and (family not in scenes.not_missed or _is_drawn(family, drawn)):
            blocks += page_views.figures(drawn, family, title, _MISSING[family])
        if blocks:
            found.append(page_views.section(name, title, *blocks))
    unknown = [page_views.note(sentence) for sentence in _left_out(scenes)]
    if unknown:
        found.append(page_views.section("scene-files", "Files left out", *unknown))
    return found
