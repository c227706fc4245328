"""The report of collisions: its tables, figures, sections of the page and what goes to the terminal."""
import re

from ulpgate_report.collisions import figure_collisions, tables
from ulpgate_report.page import page_views
from ulpgate_report.values import numbers

# What is tabled, and in which formats; a table has the name of its function.
TABLES = tuple(
    (make, ("tex", "md", "csv"))
    for make in (
        tables.collision_table,
        tables.collision_energy,
        tables.collision_findings,
    )
)
FIGURES = (figure_collisions.draw,)
FAMILIES = (figure_collisions.FAMILY,)
_TITLE = "Collisions"


def of(run):
    """The collisions, None where no ledger was kept."""
    return run.collisions


def printed(collisions):
    """Tables for the terminal."""
    return [table for table in (make(collisions) for make, _ in TABLES) if table.rows]


def headline(collisions):
    """What stands above everything."""
    ended, beyond = (
        sum(run.totals[name] for run in collisions.runs) for name in ("ended", "beyond")
    )
    text = f"{ended:,} collisions in {len(collisions.runs):,} runs;"
    found = f"{beyond:,}" if beyond else "none"
    return [(text, False), (found, bool(beyond)), ("beyond its condition.", False)]


class Scale:
    """Colours of a part of what may be gained: nothing, within, beyond; told apart by colour-blind readers."""

    @staticmethod
    def background(part):
        """Colour of a cell."""
        return "#eef3f7" if part == 0 else "#7cc0ee" if part <= 1 else "#d55e00"

    @staticmethod
    def foreground(_):
        """Colour of its number."""
        return "#000000"


def anchors(collisions):
    """The anchor of each run on the page, each another."""
    plain = (f"collisions-{run.scene}-{run.type}" for run in collisions.runs)
    names = [re.sub(r"[^A-Za-z0-9_.-]+", "-", name) for name in plain]
    return [f"{name}-{place}" for place, name in enumerate(names)]


def _hover(run):
    told = run.totals
    largest = numbers.short_real(numbers.signed(told["largest_created"]))
    lines = [
        f"{run.scene}, {run.type}: {told['ended']:,} collisions ended",
        f"{told['creating']:,} made energy, at most {largest} of the pair's",
        f"nearest to its bound: {tables.place_text(told['largest_part_of_bound_at']) or 'none'}",
        f"{told['beyond']:,} beyond their condition",
    ]
    return "\n".join(lines)


def _matrix_block(collisions, names):
    """Scene by type: each cell is a link to the run with the command that repeats it."""
    of_run = {id(run): name for run, name in zip(collisions.runs, names)}
    groups = tables.groups(collisions).values()
    view = page_views.heat_view(
        tables.collision_matrix(collisions),
        page_views.cells_by_type(groups, collisions.type_tokens),
        tables.part_of_run,
        _hover,
        Scale,
        lambda run: of_run[id(run)],
    )
    return page_views.table(view)


def sections(collisions, drawn):
    """The sections of the page."""
    names = anchors(collisions)
    view = page_views.table_view
    energy = view(tables.collision_energy(collisions))
    page_views.anchor_rows(energy, names)
    none_ended = "No collision ended: nothing is drawn."
    return [
        page_views.section(
            "collisions",
            _TITLE,
            _matrix_block(collisions, names),
            *page_views.figures(drawn, figure_collisions.FAMILY, _TITLE, none_ended),
            page_views.table(view(tables.collision_table(collisions))),
        ),
        page_views.section(
            "collision-energy",
            f"{_TITLE}: energy",
            page_views.table(energy),
            page_views.table(
                view(tables.collision_findings(collisions)),
                "No collision made more energy than its condition allows.",
            ),
        ),
    ]
