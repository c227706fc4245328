"""Tests of loading scenes and of their tables: what is optional, what is refused, by file and line."""
import json
import shutil

import pytest

from ulpgate_report.app import cli
from ulpgate_report.records import records, scene_records
from ulpgate_report.scenes import benchmark, kind, tables
from ulpgate_report.testing import sample_scenes
from ulpgate_report.testing.changes import edit_line, with_fields, without
from ulpgate_report.testing.table_check import compile_tables, csv_rows, needs_latex

TOKENS = ("float", "double", "long_double", "mpfr62")


@pytest.fixture
def run_directory(tmp_path):
    """A small good run."""
    return sample_scenes.write_sample(tmp_path / "run", TOKENS, bodies=30)


def test_good_run_loads(run_directory):
    scenes = records.load(run_directory).scenes
    assert scenes.type_tokens == list(TOKENS) and scenes.names == ["deposition"]
    assert sorted(scenes.series) == sorted(("deposition", t) for t in TOKENS)
    steps = [step for step, _ in scenes.snapshots["deposition", "double"]]
    assert steps == [0, 1000, 3000, 7000], "four of the five, first and last among them"
    assert scenes.unknown == ()


SERIES = "series/deposition_double.csv"
DIVERGENCE = "series/divergence_deposition_double.csv"
SNAPSHOT = "snapshots/deposition_double_3000.csv"


@pytest.mark.parametrize(
    "name, line, change, named, why",
    [
        ("scenes.jsonl", 2, lambda s: s[:40], "scenes.jsonl:2", "truncated"),
        ("scenes.jsonl", 2, without("plan"), "scenes.jsonl:2", "field missing"),
        ("scenes.jsonl", 2, with_fields(odd=1), "scenes.jsonl:2", "unknown field"),
        (
            "scenes.jsonl",
            2,
            with_fields(steps=-1),
            "scenes.jsonl:2: steps",
            "negative",
        ),
        (
            "scenes.jsonl",
            2,
            with_fields(mean_position=[0, 1]),
            "scenes.jsonl:2: mean_position",
            "no point",
        ),
        (
            "scenes.jsonl",
            2,
            with_fields(state_hash="xyz"),
            "scenes.jsonl:2: state_hash",
            "no hash",
        ),
        (
            "scenes.jsonl",
            2,
            lambda s: s + "\n" + s,
            "scenes.jsonl:3",
            "twice the same record",
        ),
        ("timing.jsonl", 3, with_fields(kept=0), "timing.jsonl:3: kept", "none kept"),
        (
            "timing.jsonl",
            3,
            with_fields(ns_per_eval=3.0),
            "timing.jsonl:3",
            "of another kind of line",
        ),
        ("timing.jsonl", 3, without("scene"), "timing.jsonl:3", "no scene"),
        (
            "timing.jsonl",
            3,
            with_fields(scene="../a"),
            "timing.jsonl:3: scene",
            "would write elsewhere",
        ),
        ("timing.jsonl", 3, lambda s: s + "\n" + s, "timing.jsonl:4", "twice"),
        (SERIES, 5, lambda s: s[: len(s) // 2], f"{SERIES}:5", "too few fields"),
        (SERIES, 5, lambda s: s + ",1", f"{SERIES}:5", "too many fields"),
        (
            SERIES,
            5,
            lambda s: "x" + s[1:],
            f"{SERIES}:5: step",
            "no number",
        ),
        (
            SERIES,
            6,
            lambda s: s.rsplit(",", 1)[0] + ",high",
            f"{SERIES}:6: mean_z_m",
            "no decimal",
        ),
        (
            SERIES,
            1,
            lambda s: s.replace("time_s", "time"),
            f"{SERIES}:1",
            "column missing",
        ),
        (
            SERIES,
            1,
            lambda s: s.replace("friction_J", "elastic_J"),
            f"{SERIES}:1",
            "column twice",
        ),
        (DIVERGENCE, 9, lambda s: "", f"{DIVERGENCE}:9", "an empty line"),
        (
            DIVERGENCE,
            1,
            lambda s: s.replace("max_position_ulp", "ulp"),
            f"{DIVERGENCE}:1",
            "column missing",
        ),
        (SNAPSHOT, 7, lambda s: s + "x", f"{SNAPSHOT}:7: time_s", "no number"),
    ],
)
def test_bad_input_is_refused(run_directory, capsys, name, line, change, named, why):
    edit_line(run_directory, name, line, change)
    assert cli.main([str(run_directory), "--print"]) == 2, why
    assert named in capsys.readouterr().err, why


@pytest.mark.parametrize("name", [SERIES, DIVERGENCE, SNAPSHOT])
def test_a_cut_file_is_refused(run_directory, capsys, name):
    text = (run_directory / name).read_text()
    (run_directory / name).write_text(text[:-2])
    assert cli.main([str(run_directory), "--print"]) == 2
    last = text.count("\n")
    assert f"{name}:{last}: the file ends within a line" in capsys.readouterr().err
    (run_directory / name).write_text("")
    assert cli.main([str(run_directory), "--print"]) == 2
    assert f"{name}:1" in capsys.readouterr().err


def test_tables(run_directory):
    scenes = records.load(run_directory).scenes
    row = csv_rows(tables.scene_table(scenes))[1]
    assert (row["type"], row["dt_s"], row["contacts"]) == ("double", "1e-4", "9892")
    assert row["mean_y_m"] == "-0.345608"
    state = csv_rows(tables.scene_states(scenes))[0]
    assert state["left_out"] == "damping: it is 0" and len(state["state_hash"]) == 16
    energy = csv_rows(tables.energy_table(scenes))[0]
    assert list(energy)[-3:] == ["sum_J", "energy_start_J", "max_energy_error_J"]
    (last,) = [
        row
        for row in csv_rows(tables.divergence_table(scenes))
        if row["type"] == "float"
    ]
    assert last["other_contacts_step"] and last["max_position_error_m"] == "0.5"


def test_benchmark_takes_or_makes_the_slowdown():
    def bars(**changes):
        timings = [{**sample_scenes.timing_record(t), **changes} for t in TOKENS]
        scenes = scene_records.Scenes((), tuple(timings), {}, {}, {})
        return {bar.timing["type"]: bar for bar in benchmark.bars(scenes)}

    assert bars()["long_double"].slowdown == 1.6
    made = bars(slowdown_against_double=None)["long_double"]
    assert made.slowdown == pytest.approx(1.6)
    assert made.slowdown_deviation == pytest.approx(1.6 * 0.02 * 2**0.5)
    assert made.paper_slowdown == 1.4
    assert bars(scene="rolling")["mpfr62"].paper_slowdown is None


def test_null_and_infinite_values(run_directory):
    line = sample_scenes.scene_record(
        "double",
        kinetic_energy_half_step_J="nan",
        max_energy_error="inf",
        energy=None,
        energy_start=None,
        mean_position=["-inf", None, 0],
        parts_left_out=[],
    )
    # The other files hold none of these values, and their figures take long.
    (run_directory / "timing.jsonl").unlink()
    for folder in ("series", "snapshots"):
        shutil.rmtree(run_directory / folder)
    (run_directory / "scenes.jsonl").write_text(json.dumps(line) + "\n")
    scenes = records.load(run_directory).scenes
    (row,) = csv_rows(tables.scene_table(scenes))
    assert (row["kinetic_half_step_J"], row["max_energy_error_J"]) == ("nan", "inf")
    assert (row["mean_x_m"], row["mean_y_m"]) == ("-inf", "")
    assert tables.energy_table(scenes).rows == ()
    assert cli.main([str(run_directory), "--out", str(run_directory / "out")]) == 0


@needs_latex
def test_latex_compiles(run_directory, tmp_path):
    scenes = records.load(run_directory).scenes
    made = [make(scenes) for make, _ in kind.TABLES]
    assert all(
        table.name == make.__name__ for table, (make, _) in zip(made, kind.TABLES)
    )
    compile_tables(made, tmp_path)


def test_everything_is_optional(run_directory, tmp_path, capsys):
    for name in (
        "timing.jsonl",
        *(f"series/{p.name}" for p in (run_directory / "series").iterdir()),
    ):
        (run_directory / name).unlink()
    (run_directory / "series" / "angles.csv").write_text("t\n")
    assert cli.main([str(run_directory), "--out", str(tmp_path / "out")]) == 0
    said = capsys.readouterr().err
    assert "no speed is drawn" in said and "series/angles.csv" in said
    names = [path.name for path in (tmp_path / "out" / "figures").glob("*.svg")]
    assert names == ["snapshots_deposition_double.svg"]
    page = (tmp_path / "out" / "index.html").read_text("utf-8")
    assert "no divergence is drawn" in page and "series/angles.csv" in page


@pytest.mark.parametrize(
    "kept", ["timing.jsonl", "series", "snapshots", "scenes.jsonl"]
)
def test_one_of_the_files_is_enough(run_directory, tmp_path, kept):
    for path in list(run_directory.iterdir()):
        if path.name not in (kept, "context.json"):
            path.rename(tmp_path / path.name)
    assert cli.main([str(run_directory), "--out", str(tmp_path / "out")]) == 0
