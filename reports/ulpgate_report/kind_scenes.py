"""The report of the scenes: its tables, figures, sections of the page and what goes to the terminal."""
from ulpgate_report import (
    figure_benchmark,
    figure_divergence,
    figure_energy,
    figure_snapshots,
    page_views,
    scene_tables,
)

# What is tabled, and in which formats; a table has the name of its function.
TABLES = (
    (scene_tables.scene_table, ("tex", "md", "csv")),
    (scene_tables.scene_states, ("tex", "md", "csv")),
    (scene_tables.energy_table, ("tex", "md", "csv")),
    (scene_tables.divergence_table, ("tex", "md", "csv")),
    (scene_tables.benchmark_table, ("tex", "md", "csv")),
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
    ("scenes", "Scenes", "snapshots", scene_tables.scene_table),
    ("scene-divergence", "Divergence", "divergence", scene_tables.divergence_table),
    ("scene-energy", "Energy", "energy", scene_tables.energy_table),
    ("scene-benchmark", "Speed", "benchmark", scene_tables.benchmark_table),
    ("scene-states", "States", None, scene_tables.scene_states),
)
_MISSING = {
    "snapshots": "No snapshots/SCENE_TYPE_STEP.csv: the bodies are not drawn.",
    "divergence": "No series/divergence_SCENE_TYPE.csv: no divergence is drawn.",
    "energy": "No series/SCENE_TYPE.csv: no energy is drawn.",
    "benchmark": "No line of a scene in timing.jsonl: no speed is drawn.",
}


def of(run):
    """The scenes, None where none was run."""
    return run.scenes


def printed(scenes):
    """Tables for the terminal."""
    made = [
        make(scenes) for make in (scene_tables.scene_table, scene_tables.scene_states)
    ]
    made += [
        make(scenes)
        for make in (scene_tables.divergence_table, scene_tables.benchmark_table)
    ]
    return [table for table in made if table.rows]


def headline(scenes):
    """What stands above everything."""
    bodies = max((record["bodies"] for record in scenes.records), default=0)
    count, types = len(scenes.names), len(scenes.type_tokens)
    text = f"{count} scene{'s' * (count != 1)} in {types} type{'s' * (types != 1)}"
    return [(text + (f", up to {bodies:,} bodies." if bodies else "."), False)]


def missing(scenes):
    """A sentence for each figure that is left out, and for each file whose name tells nothing."""
    there = {
        "snapshots": scenes.snapshots,
        "divergence": scenes.divergences,
        "energy": scenes.series,
        "benchmark": scenes.timings,
    }
    found = [_MISSING[family] for family, what in there.items() if not what]
    return found + [
        f"{name}: tells no scene and type; left out." for name in scenes.unknown
    ]


def sections(scenes, drawn):
    """The sections of the page."""
    found = []
    for name, title, family, make in _PARTS:
        blocks = []
        table = make(scenes)
        if table.rows:
            blocks.append(page_views.table(page_views.table_view(table)))
        if family:
            blocks += page_views.figures(drawn, family, title, _MISSING[family])
        if blocks:
            found.append(page_views.section(name, title, *blocks))
    unknown = [
        page_views.note(f"{name}: tells no scene and type; left out.")
        for name in scenes.unknown
    ]
    if unknown:
        found.append(page_views.section("scene-files", "Files left out", *unknown))
    return found
