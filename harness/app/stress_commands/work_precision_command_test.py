"""Tests of `ulpgate work-precision` through the program: records, schema, bytes, resumed and refused runs."""

import functools
import json
import pathlib
import shutil
import signal
import sys

import jsonschema
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

import program  # noqa: E402
from program import ROOT, wait_for_pieces  # noqa: E402

sys.path.insert(0, str(ROOT / "reports"))

from ulpgate_report.records import work_precision_records  # noqa: E402
from ulpgate_report.work_precision import axes, settings  # noqa: E402

run = functools.partial(program.run, "work-precision")
started = functools.partial(program.started, "work-precision")
SCHEMA = json.loads(
    (ROOT / "reports/schema/work_precision.schema.json").read_text("utf-8")
)

# A second each, exact parts alone.
KEPLER = ["--cases", "kepler", "--integrators", "leapfrog,yoshida8,gauss4"]
KEPLER += ["--types", "float,double", "--steps", "64..32768"]
PENDULUM = ["--cases", "pendulum3", "--until", "0.01", "--types", "float,double"]
PENDULUM += ["--integrators", "leapfrog,pefrl"]
SUBJECTS = ["--subjects", "sin,sphere_sphere", "--types", "float,double"]
SUBJECTS += ["--samples", "300"]
SIZES = {"trajectory": KEPLER, "scene": PENDULUM, "subjects": SUBJECTS}
FILES = ["work_precision.jsonl", "work_precision_fits.jsonl"]


def rows(text):
    return [json.loads(line) for line in text.splitlines()]


def exact(out):
    return [(out / name).read_bytes() for name in FILES]


@pytest.fixture(scope="module", params=sorted(SIZES))
def whole(request, tmp_path_factory):
    """The options of an uninterrupted run of one thread without times, and its directory."""
    size = [*SIZES[request.param], "--repeats", "0"]
    out = tmp_path_factory.mktemp(request.param)
    code, table, err = run(*size, "--threads", "1", "--out", out)
    assert code == 0, table + err
    assert not (out / "units").exists(), "a complete run keeps no units"
    return size, out


def test_every_line_is_what_the_schema_says(tmp_path):
    for name, size in SIZES.items():
        out = tmp_path / name
        code, _, err = run(*size, "--repeats", "2", "--out", out)
        assert code == 0, err
        lines = [
            x
            for f in (*FILES, "work_precision_timing.jsonl")
            for x in rows((out / f).read_text())
        ]
        for line in lines:
            jsonschema.validate(line, SCHEMA)
        kinds = {line["what"] for line in lines}
        fitted = {"work_precision_fit"} if name != "subjects" else set()
        assert kinds == {"work_precision", "work_precision_timing", *fitted}
        timed = {x["key"]: x for x in lines if x["what"] == "work_precision_timing"}
        good = [
            x for x in lines if x["what"] == "work_precision" and x["failure"] is None
        ]
        assert len(timed) == len(good), "every setting that did not fail is timed"
        for t in timed.values():
            assert t["seconds"] == min(t["samples_s"]) <= t["median_s"]
        assert any(t["on_front"] for t in timed.values())


def test_any_number_of_threads_gives_the_same_bytes(tmp_path, whole):
    size, out = whole
    code, _, err = run(*size, "--threads", "3", "--out", tmp_path)
    assert code == 0, err
    assert exact(tmp_path) == exact(out)


def test_a_killed_run_goes_on_to_the_same_bytes(tmp_path, whole):
    size, out = whole
    with started(*size, "--threads", "1", "--out", tmp_path) as process:
        wait_for_pieces(tmp_path, 1, process)
        process.send_signal(signal.SIGKILL)
        process.wait()
    code, _, err = run(*size, "--resume", "--out", tmp_path)
    assert code == 0, err
    assert exact(tmp_path) == exact(out)
    code, table, err = run(*size, "--resume", "--out", tmp_path)
    assert code == 0 and "complete already" in err and table


def test_orders_are_measured_and_rounding_is_found():
    code, out, err = run(
        *["--cases", "kepler", "--integrators", "gauss4", "--types", "double,float"],
        *["--steps", "16384..131072", "--repeats", "0", "--json"],
    )
    assert code == 0, err
    lines = rows(out)
    fits = {
        (x["type"], x["error"]): x for x in lines if x["what"] == "work_precision_fit"
    }
    assert fits["double", "final_error"]["best_error"] < 1e-6
    errors = {
        x["type"]: x["final_error"]
        for x in lines
        if x["what"] == "work_precision" and x["steps"] == 131072
    }
    assert errors["float"] > 1e3 * errors["double"]


def test_leapfrog_of_the_pendulum_is_of_first_order_and_its_energy_of_second():
    code, out, err = run(
        *["--cases", "pendulum3", "--until", "0.01", "--types", "double", "--json"],
        *["--integrators", "leapfrog", "--repeats", "0"],
    )
    assert code == 0, err
    fits = {x["error"]: x for x in rows(out) if x["what"] == "work_precision_fit"}
    assert abs(fits["final_error"]["order"] - 1) < 0.1
    assert abs(fits["energy_error"]["order"] - 2) < 0.2


def test_angles_of_a_chain_stay_true_for_a_time():
    code, out, err = run(
        *["--cases", "pendulum3", "--until", "0.05", "--dt", "2e-5,1e-5", "--json"],
        *["--types", "double", "--integrators", "pefrl", "--repeats", "0"],
    )
    assert code == 0, err
    lines = [x for x in rows(out) if x["what"] == "work_precision"]
    assert [x["steps"] for x in lines] == [2500, 5000]
    for x in lines:
        assert x["t_s_to_the_end"] and abs(x["t_s"] - 0.05) < 1e-9
        assert x["largest_error"] >= x["final_error"] > 100 * x["reference_error"]
        assert x["evaluations"] == 4 * x["steps"]


def test_failed_settings_break_their_curve_and_have_no_error():
    code, out, err = run(
        *["--cases", "robertson", "--integrators", "euler,cash_karp54,radau3"],
        *["--types", "double", "--steps", "64,65536", "--repeats", "0", "--json"],
    )
    assert code == 0, err
    lines = [x for x in rows(out) if x["what"] == "work_precision"]
    failed = [x for x in lines if x["failure"]]
    assert {x["integrator"] for x in failed} >= {"euler", "cash_karp54"}
    for x in failed:
        assert x["failure"] in ("diverged", "refused") and x["why"]
        assert x["final_error"] is None and x["regime"] == "failed"
    fine = [x for x in lines if x["steps"] == 65536 and x["integrator"] == "radau3"]
    assert [x["failure"] for x in fine] == [None] and fine[0]["final_error"] < 1e-9


def test_planned_steps_make_curves_of_stiff_problems():
    code, out, err = run(
        *["--cases", "robertson", "--until", "1e11", "--types", "float,double"],
        *["--integrators", "radau5,rodas3,rk4,gauss4", "--dt", "plan:1e-3..1e-6"],
        *["--repeats", "0", "--json"],
    )
    assert code == 0, err
    lines = [x for x in rows(out) if x["what"] == "work_precision"]
    for line in rows(out):
        jsonschema.validate(line, SCHEMA)
        assert line["planned"]
    tolerances = ["plan:1e-3", "plan:1e-4", "plan:1e-5", "plan:1e-6"]
    found = {}
    for x in lines:
        found.setdefault((x["integrator"], x["type"]), []).append(x)
    for curve in found.values():
        assert [x["dt_text"] for x in curve] == tolerances
        steps = [x["steps"] for x in curve]
        assert steps == sorted(set(steps)), "a sharper tolerance has more steps"
    # The same steps in every type.
    for a, b in zip(found["radau5", "float"], found["radau5", "double"], strict=True):
        assert a["steps"] == b["steps"] and a["dt"] == b["dt"]
    for x in found["rodas3", "double"]:
        assert x["failure"] is None and x["instants"] == 16
        assert x["largest_error"] >= x["final_error"]
    # At the end, long after all fast changes, an error of the way is forgotten.
    errors = [x["largest_error"] for x in found["rodas3", "double"]]
    assert errors == sorted(errors, reverse=True) and 1e-8 < errors[-1] < 1e-3
    assert max(x["final_error"] for x in found["rodas3", "double"]) < 1e-8
    assert found["radau5", "double"][0]["final_error"] < 1e-8
    # Explicit methods and iterations that no stiff problem lets converge end, and say how.
    for name in ("rk4", "gauss4"):
        for x in found[name, "double"]:
            assert x["failure"] in ("diverged", "refused") and x["why"]
            assert x["largest_error"] is None and "instants" not in x


def test_the_default_steps_of_a_stiff_problem_are_planned():
    code, out, err = run(
        *["--cases", "chemakzo", "--integrators", "rodas3", "--types", "float"],
        *["--repeats", "0", "--json"],
    )
    assert code == 0, err
    lines = [x for x in rows(out) if x["what"] == "work_precision"]
    assert [x["dt_text"] for x in lines] == [f"plan:1e-{k}" for k in range(3, 13)]


def test_the_largest_error_is_over_the_times_at_which_steps_end():
    code, out, err = run(
        *["--cases", "kepler", "--integrators", "pefrl", "--types", "double"],
        *["--steps", "1000,1024,1025", "--repeats", "0", "--json"],
    )
    assert code == 0, err
    found = {x["steps"]: x for x in rows(out) if x["what"] == "work_precision"}
    assert {n: x["instants"] for n, x in found.items()} == {1000: 8, 1024: 16, 1025: 1}
    assert found[1025]["largest_error"] == found[1025]["final_error"]
    # The pericentre is the end: the error of the orbit is larger before it or there, not less.
    assert found[1024]["largest_error"] >= found[1024]["final_error"] > 0


def test_the_report_draws_the_front_that_the_program_found(tmp_path):
    size = ["--cases", "kepler", "--types", "float,double", "--steps", "256..16384"]
    size += ["--integrators", "pefrl,yoshida8,rk4,fehlberg78,gauss4,euler"]
    code, _, err = run(*size, "--repeats", "3", "--out", tmp_path)
    assert code == 0, err
    context = json.loads((tmp_path / "context.json").read_text())
    measured = settings.made_of(work_precision_records.load(tmp_path, context))
    drawn = settings.front(measured.rows, axes.DEFAULT)
    key = ("type", "integrator", "steps")
    times = rows((tmp_path / "work_precision_timing.jsonl").read_text())
    wanted = {tuple(x[k] for k in key) for x in times if x["on_front"]}
    assert {tuple(x[k] for k in key) for x in drawn} == wanted
    assert 3 < len(wanted) < len(times)


def test_references_of_a_killed_run_are_not_computed_again(tmp_path, whole):
    size, out = whole
    if "--subjects" in size:
        pytest.skip("functions have none to keep")
    with started(*size, "--threads", "1", "--out", tmp_path) as process:
        wait_for_pieces(tmp_path, 1, process)
        process.send_signal(signal.SIGKILL)
        process.wait()
    kept = sorted((tmp_path / "units/results").iterdir())
    assert len(kept) == 1
    before = kept[0].read_bytes()
    code, _, err = run(*size, "--resume", "--out", tmp_path)
    assert code == 0 and "computed again" not in err
    assert exact(tmp_path) == exact(out) and not (tmp_path / "units").exists()
    # A torn one, and one of which a digit was changed, is named and done again: to the same bytes.
    for damaged in (before[: len(before) // 2], before.replace(b" 0x1.", b" 0x1.1", 1)):
        with started(*size, "--threads", "1", "--out", tmp_path / "d") as process:
            wait_for_pieces(tmp_path / "d", 1, process)
            process.send_signal(signal.SIGKILL)
            process.wait()
        file = next((tmp_path / "d/units/results").iterdir())
        file.write_bytes(damaged)
        code, _, err = run(*size, "--resume", "--out", tmp_path / "d")
        assert code == 0 and f"{file}: damaged, torn" in err
        assert exact(tmp_path / "d") == exact(out)
        shutil.rmtree(tmp_path / "d")


def test_what_is_over_the_budget_is_refused():
    code, out, err = run(
        *["--cases", "kepler", "--integrators", "gauss4", "--types", "double"],
        *["--steps", "64", "--budget", "10", "--repeats", "0"],
    )
    assert code == 3 and "budget" in out + err and "nothing measured" in err


REFUSED = [
    (2, ["--cases", "keplr"], "kepler"),
    (2, ["--subjects", "sine"], "sin"),
    (2, ["--integrators", "yoshida7"], "yoshida6"),
    (2, ["--types", "decimal"], "type"),
    (2, ["--steps", "0"], "--steps"),
    (2, ["--steps", "64..32"], "ends before"),
    (2, ["--cases", "robertson", "--dt", "plan:1e-20"], "1e-13 to 0.001"),
    (2, ["--cases", "robertson", "--dt", "plan:1e-9..1e-3"], "fall"),
    (2, ["--cases", "robertson", "--dt", "plan:"], "tolerance"),
    (2, ["--cases", "pendulum3", "--dt", "plan:1e-6"], "none is among the cases"),
    (2, ["--cases", "kepler", "--dt", "1e-5"], "--steps"),
    (2, ["--cases", "collision", "--steps", "64"], "--steps"),
    (2, ["--cases", "kepler", "--steps", "64", "--dt", "plan:1e-6"], "--steps"),
    (2, ["--cases", "kepler", "--until", "7"], "2 pi"),
    (2, ["--cases", "collision", "--dt", "1e-6,3e-7"], "--until"),
    (2, ["--cases", "collision", "--dt", "nonsense"], "nonsense"),
    (2, ["--resume"], "--out"),
    (3, ["--cases", "collision", "--integrators", "gauss2"], "applies"),
]


@pytest.mark.parametrize("code,more,message", REFUSED)
def test_what_is_asked_wrongly_is_refused(code, more, message):
    got, out, err = run(*more, "--repeats", "0")
    assert got == code and message in err, out + err


def test_records_of_another_plan_are_not_replaced_silently(tmp_path):
    size = ["--subjects", "sin", "--samples", "50", "--repeats", "0", "--out", tmp_path]
    assert run(*size)[0] == 0
    kept = exact(tmp_path)
    code, _, err = run(*size, "--types", "float")
    assert code == 2 and "another plan" in err
    assert exact(tmp_path) == kept
    assert run(*size, "--types", "float", "--overwrite")[0] == 0


def test_a_changed_record_is_noticed(tmp_path):
    size = ["--subjects", "sin", "--samples", "50", "--repeats", "0", "--out", tmp_path]
    assert run(*size)[0] == 0
    file = tmp_path / "work_precision.jsonl"
    file.write_text(file.read_text().replace('"evaluations":50', '"evaluations":51'))
    code, _, err = run(*size, "--resume")
    assert code == 2 and "checksum" in err
