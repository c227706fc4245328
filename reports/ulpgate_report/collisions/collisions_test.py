"""Tests of the report of collisions: records, tables, figures, links of the page."""
import itertools
import json
import shutil

import pytest
from matplotlib import pyplot

from ulpgate_report.app import cli
from ulpgate_report.collisions import figure_collisions, kind, tables
from ulpgate_report.records import collision_records, reading, records, suite
from ulpgate_report.testing import sample_collisions as sample
from ulpgate_report.testing.changes import edit_line, with_fields, without
from ulpgate_report.testing.page_check import References
from ulpgate_report.testing.table_check import compile_tables, csv_rows, needs_latex

TOKENS = ("float", "double", "mpfr62")
COUNT = 40


def lines(count=COUNT, tokens=TOKENS, scene="packing"):
    """Lines of a few types."""
    return [row for token in tokens for row in sample.of_run(scene, token, count)]


@pytest.fixture
def run_directory(tmp_path):
    """A small good run."""
    return sample.write(tmp_path / "run", lines())


def collisions_of(tmp_path, rows):
    """Collisions as a report has them."""
    return collision_records.load(sample.write(tmp_path / "made", rows))


def test_a_run_has_its_collisions_totals_and_steps(run_directory):
    found = records.load(run_directory).collisions
    assert found.type_tokens == list(TOKENS) and found.scenes == ["packing"]
    for run in found.runs:
        assert len(run.ended) == COUNT and len(run.collisions) == COUNT + 2
        assert run.steps == 7001
        nearest = run.at(run.totals["largest_part_of_bound_at"])
        assert nearest.part_of_bound == run.totals["largest_part_of_bound"]
        assert max(one.part_of_bound for one in run.ended) == nearest.part_of_bound
        assert run.at([0, 1, 10**6]) is None and run.at(None) is None


LINE = "collisions.jsonl:2"
# The line of the totals of the first type.
TOTALS = COUNT + 3


@pytest.mark.parametrize(
    "number, change, named, why",
    [
        (2, lambda s: s[:40], LINE, "truncated"),
        (2, without("condition"), LINE, "field missing"),
        (2, with_fields(odd=1), LINE, "unknown field"),
        (2, with_fields(what="touch"), f"{LINE}: ", "no kind of line"),
        (2, with_fields(steps_inside=-1), f"{LINE}: steps_inside", "negative"),
        (2, with_fields(energy_created=-1), f"{LINE}: energy_created", "negative"),
        (2, with_fields(open="no"), f"{LINE}: open", "no truth value"),
        (2, with_fields(restitution="big"), f"{LINE}: restitution", "no number"),
        (2, lambda s: s + "\n" + s, "collisions.jsonl:3", "twice"),
        (2, lambda s: "", f"collisions.jsonl:{TOTALS}: rows", "one is missing"),
        (TOTALS, lambda s: "", "packing float: its line of totals", "no totals"),
        (TOTALS, lambda s: s + "\n" + s, f"{TOTALS + 1}: packing", "totals twice"),
        (TOTALS, with_fields(largest_created_at=[1]), f":{TOTALS}", "no place"),
        (TOTALS, with_fields(rows=3), f":{TOTALS}: rows", "does not count them"),
    ],
)
def test_bad_input_is_refused(run_directory, capsys, number, change, named, why):
    edit_line(run_directory, "collisions.jsonl", number, change)
    assert cli.main([str(run_directory), "--print"]) == 2, why
    assert named in capsys.readouterr().err, why


@pytest.mark.parametrize(
    "share, expected",
    [(0.0, 1), (0.25, 1), (0.26, 2), (0.5, 2), (0.95, 4), (1.0, 4)],
)
def test_quantiles(share, expected):
    assert tables.quantile([4, 2, 1, 3], share) == expected
    assert tables.quantile([], share) is None


def test_motion_is_that_of_the_collisions_that_ended(tmp_path):
    rows = [sample.collision("a", "double", n) for n in range(4)]
    for row, restitution, steps in zip(rows, (0.1, 0.2, 0.3, None), (5, 6, 7, 8)):
        row.update(restitution=restitution, steps_inside=steps, duration_s=steps * 1e-4)
    rows.append(sample.left_open("a", "double", 9, steps_inside=900))
    rows.append(sample.ledger(rows))
    (found,) = csv_rows(tables.collision_table(collisions_of(tmp_path, rows)))
    assert (found["ended"], found["still_open"], found["listed"]) == ("4", "1", "5")
    wanted = {"restitution_5": 0.1, "restitution_50": 0.2, "restitution_95": 0.3}
    wanted.update(fewest_steps=5, median_steps=6, duration_s=6e-4)
    for name, value in wanted.items():
        assert float(found[name]) == pytest.approx(value), name


def test_energy_names_the_collisions_and_a_command(tmp_path):
    rows = [sample.collision("a", "double", n, dt="(1e-5)/2") for n in range(30)]
    rows[7].update(energy_gained_J=6.0, energy_created=0.5, beyond_condition=True)
    rows[7].update(rounding_bound_J=1.0, step_bound_J=2.0, law_bound_J=0.0)
    for row in rows:
        row.update(variant="speed=5,mass=yade")
    rows.append(sample.ledger(rows))
    found = collisions_of(tmp_path, rows)
    (energy,) = csv_rows(tables.collision_energy(found))
    assert float(energy["created_part"]) == float(energy["largest_part"]) == 2.0
    assert energy["created_at"] == energy["nearest_at"] == "0-14 from step 280"
    assert energy["beyond"] == "1" and int(energy["creating"]) > 1
    command = "ulpgate scene run a --types double --dt '(1e-5)/2' --set speed=5 --set mass=yade --collisions --out DIR"
    assert energy["command"] == command
    (finding,) = csv_rows(tables.collision_findings(found))
    assert finding["bodies"] == "0-14 from step 280" and float(finding["part"]) == 2.0
    # Totals are of more collisions than are listed.
    rows[-1].update(largest_created_at=[90, 91, 92], ended=10**6)
    (energy,) = csv_rows(tables.collision_energy(collisions_of(tmp_path, rows)))
    assert energy["created_part"] == "" and energy["created_at"] == "90-91 from step 92"


def test_ways_of_a_scene_are_told_apart(tmp_path):
    rows = []
    for dt in ("1e-4", "1e-5"):
        mine = [sample.collision("a", "double", n, dt=dt) for n in range(3)]
        rows += [*mine, sample.ledger(mine)]
    rows += sample.of_run("b", "double", 3)
    found = collisions_of(tmp_path, rows)
    matrix = csv_rows(tables.collision_matrix(found))
    assert [row["scene"] for row in matrix] == [
        "a leapfrog dt=1e-4",
        "a leapfrog dt=1e-5",
        "b",
    ]
    assert len(set(kind.anchors(found))) == 3
    names = [name for name, _, _ in closed(figure_collisions.draw(found))]
    assert names == [
        "collisions_a-leapfrog-dt-1e-4",
        "collisions_a-leapfrog-dt-1e-5",
        "collisions_b",
    ]


def closed(drawn):
    """The figures, each closed."""
    for name, caption, figure in drawn:
        pyplot.close(figure)
        yield name, caption, figure


def test_a_figure_shows_points_steps_and_the_bound(tmp_path):
    rows = [sample.collision("a", "double", n) for n in range(30)]
    gained = [row for row in rows if row["energy_gained_J"] > 0]
    gained[0].update(energy_gained_J=1e3, energy_created=0.5, beyond_condition=True)
    rows.append(sample.collision("a", "double", 31, restitution=None))
    rows.append(sample.ledger(rows))
    ((_, caption, figure),) = figure_collisions.draw(collisions_of(tmp_path, rows))
    left, middle, right = figure.axes
    (points,) = left.lines
    assert len(points.get_xdata()) == 30, "one has no restitution"
    heights = middle.patches[0].get_data().values
    assert sum(heights) == pytest.approx(1)
    steps = [row["steps_inside"] for row in rows[:-1]]
    assert heights[0] == pytest.approx(steps.count(min(steps)) / 31)
    counts = sorted(len(line.get_xdata()) for line in right.lines)
    assert counts == sorted([len(gained), 1, 2]), "all, the one beyond, the bound"
    assert "none" not in caption
    pyplot.close(figure)


@pytest.mark.parametrize(
    "steps", [[1], [1, 2, 3], [5, 400], [1, 10**6], [7, 99, 12345]]
)
def test_bins_hold_every_number_of_steps(steps):
    edges, _ = figure_collisions.bins(steps)
    assert len(edges) < 120
    for low, high in itertools.pairwise(edges):
        assert high > low and low % 1 == high % 1 == 0.5
    assert edges[0] < min(steps) and max(steps) < edges[-1]


NONE_GAINED = [
    sample.collision("a", "double", n, energy_gained_J=-1.0, energy_created=0.0)
    for n in range(3)
]
OPEN = [sample.left_open("a", "double", 1)]
ODD = [
    sample.collision("a", "double", n, **odd)
    for n, odd in enumerate(
        (
            {"restitution": "inf", "normal_velocity_before": 0.0},
            {"restitution": "nan", "duration_s": "nan"},
            {"energy_gained_J": "inf", "beyond_condition": True},
            {"rounding_bound_J": 0.0, "step_bound_J": 0.0, "energy_gained_J": 1.0},
            {"steps_inside": 10**7},
            {"normal_velocity_before": 5e-324},
        )
    )
]


@pytest.mark.parametrize(
    "rows, totals, count",
    [
        (NONE_GAINED, {}, 1),
        (OPEN, {}, 0),
        ([], {"ended": 0}, 0),
        (ODD, {"largest_created": "inf", "largest_part_of_bound": "inf"}, 1),
    ],
    ids=["none gained", "only open", "none", "odd numbers"],
)
def test_hard_records(tmp_path, capsys, rows, totals, count):
    plain = [row for row in rows if row not in ODD] or NONE_GAINED[:1]
    made = {**sample.ledger(plain), "rows": len(rows), **totals}
    run = sample.write(tmp_path / "run", [*rows, made], scenes=())
    (run / "scenes.jsonl").unlink()
    out = tmp_path / "out"
    assert cli.main([str(run), "--out", str(out)]) == 0, capsys.readouterr().err
    assert len(list(out.glob("figures/*.svg"))) == count
    assert cli.main([str(run), "--print"]) == 0


def test_whole_report(run_directory, tmp_path):
    out = tmp_path / "out"
    assert cli.main([str(run_directory), "--out", str(out)]) == 0
    page = (out / "index.html").read_text("utf-8")
    found = References()
    found.feed(page)
    assert len(set(found.ids)) == len(found.ids)
    links = [value for _, value in found.fetched if not value.startswith("data:image/")]
    assert {link[1:] for link in links} <= set(found.ids)
    cells = [link for link in links if link.startswith("#collisions-packing-")]
    assert len(cells) == len(TOKENS), "each cell leads to its run"
    assert "--steps 7001 --collisions --out DIR" in page
    assert "No collision made more energy than its condition allows." in page
    for make, formats in kind.TABLES:
        for form in formats:
            assert (out / f"{make.__name__}.{form}").stat().st_size > 0
    summary = json.loads((out / "summary.json").read_text("utf-8"))
    reading.validator("summary").validate(summary)
    assert [row["type"] for row in summary["collisions"]] == list(TOKENS)


def test_runs_of_a_suite(run_directory, tmp_path):
    base = tmp_path / "suite"
    for name in ("first", "second"):
        shutil.copytree(run_directory, base / name)
    found = suite.load(base).collisions
    assert found.scenes == ["packing_first", "packing_second"]
    assert tables.command(found.runs[0]).startswith("ulpgate scene run packing --types")


@needs_latex
def test_latex_compiles(run_directory, tmp_path):
    found = records.load(run_directory).collisions
    made = [make(found) for make, _ in kind.TABLES]
    assert "Overfull" not in compile_tables(made, tmp_path)
