"""The report of the pendulum: its tables, figures, sections of the page and what goes to the terminal."""
from ulpgate_report.integrators import figure_orders, tables as order_tables
from ulpgate_report.page import page_views
from ulpgate_report.pendulum import (
    figure_correlation,
    figure_damped_angle,
    figure_energy,
    figure_energy_error,
    figure_snapshots,
    figure_t_s,
    tables as pendulum_tables,
)

# What is tabled, and in which formats; a table has the name of its function.
TABLES = (
    (pendulum_tables.pendulum_divergence, ("tex", "md", "csv")),
    (pendulum_tables.pendulum_correlations, ("md", "csv")),
    (pendulum_tables.pendulum_energy, ("tex", "md", "csv")),
    (order_tables.order_table, ("tex", "md", "csv")),
    (order_tables.drift_table, ("tex", "md", "csv")),
    (order_tables.order_records, ("md", "csv")),
)
FIGURES = (
    figure_snapshots.draw,
    figure_correlation.draw,
    figure_t_s.draw,
    figure_damped_angle.draw,
    figure_energy.draw,
    figure_energy_error.draw,
    figure_orders.draw,
)
FAMILIES = ("pendulum", "orders")
# Section, title, tables, families of figures, and what is said where a family has no figure.
_PARTS = (
    (
        "pendulum-divergence",
        "Pendulum: how long each type stays true",
        (pendulum_tables.pendulum_divergence,),
        ("pendulum_t_s", "pendulum_correlation"),
    ),
    ("pendulum-snapshots", "Pendulum: snapshots", (), ("pendulum_snapshots",)),
    ("pendulum-angle", "Pendulum: damped angle", (), ("pendulum_angle",)),
    (
        "pendulum-energy",
        "Pendulum: energy",
        (pendulum_tables.pendulum_energy,),
        ("pendulum_energy", "pendulum_max_error"),
    ),
    ("orders", "Integrators: order", (order_tables.order_table,), ("orders",)),
    ("drift", "Integrators: energy", (order_tables.drift_table,), ()),
)
_MISSING = {
    "pendulum_t_s": "No line in correlation.jsonl: no duration is drawn.",
    "pendulum_correlation": "No correlation/SCENE_TYPE_AGAINST.csv of a line in correlation.jsonl: no correlation is drawn.",
    "pendulum_snapshots": "No snapshots/SCENE_TYPE_STEP.csv of a chain: the pendulum is not drawn.",
    "pendulum_angle": "No series with angle_1_rad of a variant with damping: no damped angle is drawn.",
    "pendulum_energy": "No series with parts of the energy and energy_error_J: no energy of the pendulum is drawn.",
    "pendulum_max_error": "No record of a pendulum with max_energy_error: no largest error is drawn.",
    "orders": "No line in orders.jsonl: no order is drawn.",
}


def of(run):
    """The pendulum's runs, None where there are none."""
    return run.pendulum


def printed(pendulum):
    """Tables for the terminal."""
    made = [
        pendulum_tables.pendulum_divergence(pendulum),
        pendulum_tables.pendulum_energy(pendulum),
        order_tables.order_table(pendulum),
        order_tables.drift_table(pendulum),
    ]
    return [table for table in made if table.rows]


def headline(pendulum):
    """What stands above everything."""
    counts = (
        (len(pendulum.correlations), "duration", "of the pendulum's correlation"),
        (len(pendulum.orders), "error", "of integrators"),
        (len(pendulum.drifts), "energy error", "of integrators"),
    )
    texts = [f"{n:,} {noun}{'s' * (n != 1)} {what}" for n, noun, what in counts if n]
    return [("; ".join(texts) + "." if texts else "A pendulum.", False)]


def _has_pendulum(pendulum):
    return any(run.records or run.correlations or run.series for run in pendulum.runs)


def _expected(pendulum):
    """The families that belong to what was run: a run of orders alone misses no pendulum."""
    return [
        family
        for family in _MISSING
        if (_has_pendulum(pendulum) if family != "orders" else pendulum.orders)
    ]


def notes(pendulum, drawn):
    """A sentence for each family of figures that has none."""
    return [
        _MISSING[family]
        for family in _expected(pendulum)
        if not any(name.startswith(f"{family}_") for name in drawn)
    ]


def sections(pendulum, drawn):
    """The sections of the page."""
    found, expected = [], _expected(pendulum)
    for name, title, tables, families in _PARTS:
        made = [table for table in (make(pendulum) for make in tables) if table.rows]
        blocks = [page_views.table(page_views.table_view(table)) for table in made]
        for family in families:
            if family in expected:
                blocks += page_views.figures(drawn, family, title, _MISSING[family])
        if blocks:
            found.append(page_views.section(name, title, *blocks))
    details = (
        (pendulum_tables.pendulum_correlations, "durations"),
        (order_tables.order_records, "errors"),
    )
    views = [(page_views.table_view(make(pendulum)), noun) for make, noun in details]
    blocks = [page_views.details(view, noun) for view, noun in views if view["rows"]]
    if blocks:
        found.append(
            page_views.section("pendulum-all", "Pendulum: all records", *blocks)
        )
    return found
