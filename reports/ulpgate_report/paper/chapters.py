"""What the paper shows, in its order: of which run which tables and families of figures."""
from dataclasses import dataclass


@dataclass(frozen=True)
class Chapter:
    """A section; `run` is the directory of its records, `tables` are names, `figures` beginnings of names."""

    run: str
    title: str
    says: str
    tables: tuple = ()
    figures: tuple = ()


CHAPTERS = (
    Chapter(
        "math",
        "Functions",
        "Arguments are made in the type under test; the reference is the exact value, decided at up to four times the precision.",
        (
            "types",
            "type_table",
            "beside_published",
            "worst_table",
            "ulp_matrix",
            "paper_table",
        ),
        ("heatmap", "error_vs_time", "distributions"),
    ),
    Chapter(
        "published",
        "Real functions at the published size",
        "The two sets of arguments of the published verification, as many as it had where this paper was made in full.",
        ("beside_published", "type_table", "worst_table", "paper_table"),
        ("error_vs_time", "distributions"),
    ),
    Chapter(
        "kernels",
        "Kernels of the discrete element method",
        "An error is held against what the condition of the kernel at its state allows.",
        ("kernel_stability", "kernel_unstable", "kernel_mismatches"),
        ("kernel",),
    ),
    Chapter(
        "speed",
        "Speed of a whole simulation",
        "Iterations per second of the deposition of spheres under gravity; runs beyond two standard deviations of the mean are left out. "
        "The steps that are timed are the first: the spheres fall and hardly touch yet.",
        ("benchmark_table",),
        ("builds",),
    ),
    Chapter(
        "deposition",
        "Deposition of spheres",
        "The scene that the speeds were measured on, to the end of the published run.",
        ("scene_table",),
        ("snapshots", "divergence", "energy"),
    ),
    Chapter(
        "pendulum",
        "A chaotic pendulum: how long a precision stays true",
        "Three nodes on elastic rods; a type stays true while its angles correlate above 0.9 with the run in 150 digits.",
        (
            "pendulum_divergence",
            "pendulum_energy",
            "order_table",
            "drift_table",
        ),
        ("pendulum", "orders"),
    ),
    Chapter(
        "stress",
        "Stiff and extreme cases",
        "Each case has a verdict in each type that it can be put to.",
        ("stress_counts", "stress_findings"),
        ("stability",),
    ),
    Chapter(
        "work_precision",
        "Error against run time",
        "The best settings of each problem, and the laws that its errors follow.",
        ("work_precision_front", "work_precision_types", "work_precision_fits"),
        ("work_precision",),
    ),
    Chapter(
        "libraries",
        "Libraries side by side",
        "The same arguments, each library in a process of its own.",
        ("library_ulp", "library_time", "library_findings"),
        ("libraries",),
    ),
    Chapter(
        "history",
        "History",
        "Runs over time, and where a row stepped.",
        ("history_steps",),
        ("history", "trend"),
    ),
)
