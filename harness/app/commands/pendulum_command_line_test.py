"""Tests of the pendulum suite through the program: records, checkpoints, correlation, its gate."""

import csv
import json
import os
import pathlib
import signal
import subprocess
import sys
import time
from decimal import Decimal

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "reports"))

from ulpgate_report.records.checksums import fnv1a, sealed  # noqa: E402

ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))


def start(*words):
    return subprocess.Popen(
        [ULPGATE, *map(str, words)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
    )


def run(*words):
    process = start(*words)
    out, err = process.communicate()
    return process.returncode, out, err


def wait_for(path):
    """A run that writes there has begun, and looks at signals."""
    for _ in range(600):
        if path.exists():
            return
        time.sleep(0.02)
    raise AssertionError(f"{path} never came")


def everything_in(directory):
    """Every file with its bytes, but for the context, which holds times and threads."""
    return {
        str(path.relative_to(directory)): path.read_bytes()
        for path in sorted(directory.rglob("*"))
        if path.is_file() and path.name != "context.json"
    }


def test_a_trajectory_is_written_at_full_precision(tmp_path):
    code, _, err = run(
        "scene",
        "run",
        "pendulum3",
        "--types",
        "double,mpfr62",
        "--steps",
        "200",
        "--record",
        "--out",
        tmp_path,
    )
    assert code == 0, err
    rows = {}
    for name in ("double", "mpfr62"):
        with open(tmp_path / f"trajectory/pendulum3_{name}.csv") as file:
            rows[name] = list(csv.DictReader(file))
    assert [row["step"] for row in rows["double"]] == ["0", "1"] + [
        str(10 * i) for i in range(1, 21)
    ]
    # The text is the number: the same rest length of the rod to the last digit of either type.
    first = rows["mpfr62"][0]
    length = (
        (Decimal(first["x_2"]) - Decimal(first["x_1"])) ** 2
        + (Decimal(first["y_2"]) - Decimal(first["y_1"])) ** 2
    ).sqrt()
    assert abs(length - Decimal("0.025")) < Decimal(
        "1e-26"
    )  # the context of Decimal has 28 digits
    assert len(first["x_1"].split("e")[0].replace(".", "")) >= 64
    assert float(rows["mpfr62"][5]["x_3"]) == pytest.approx(
        float(rows["double"][5]["x_3"]), rel=1e-13
    )
    row = rows["mpfr62"][-1]
    product = Decimal(row["angle_1_rad"]) * Decimal(row["angle_2_rad"])
    assert abs(product - Decimal(row["angle_product"])) < Decimal("1e-26")
    parts = sum(
        Decimal(row[name]) for name in ("translational_on_step", "elastic", "potential")
    )
    assert abs(parts - Decimal(row["sum"])) < Decimal("1e-33")


RECORDED = [
    "scene",
    "run",
    "pendulum3",
    "--types",
    "double,mpfr62",
    "--until",
    "0.8",
    "--record",
]
RECORDED += ["--set", "damping=5e-3", "--snapshots", "0,0.3,0.8"]


def test_a_killed_run_goes_on_to_the_same_bytes(tmp_path):
    code, _, err = run(*RECORDED, "--out", tmp_path / "whole")
    assert code == 0, err
    kills = 0
    for _ in range(40):
        process = start(
            *RECORDED,
            "--out",
            tmp_path / "killed",
            "--resume",
            "--checkpoint-seconds",
            "0.02",
        )
        time.sleep(0.12)
        process.send_signal(signal.SIGKILL)
        process.communicate()
        if process.returncode == 0:
            break
        kills += 1
        if kills == 10:
            break
    assert kills >= 3, "the run was too short to be killed"
    code, _, err = run(*RECORDED, "--out", tmp_path / "killed", "--resume")
    assert code == 0, err
    assert everything_in(tmp_path / "killed") == everything_in(tmp_path / "whole")


def test_checkpoints_are_guarded(tmp_path):
    process = start(*RECORDED, "--out", tmp_path)
    wait_for(tmp_path / "series")
    process.send_signal(signal.SIGINT)
    _, err = process.communicate()
    assert process.returncode == 3 and "--resume" in err
    code, _, err = run(*RECORDED, "--out", tmp_path)
    assert code == 2 and "--resume" in err and "--overwrite" in err
    code, _, err = run(*RECORDED, "--out", tmp_path, "--resume", "--dt", "2e-5")
    assert code == 2 and "another plan" in err
    checkpoint = next((tmp_path / "checkpoints").glob("*.json"))
    whole = checkpoint.read_text()
    checkpoint.write_text(whole[: len(whole) // 2])
    code, _, err = run(*RECORDED, "--out", tmp_path, "--resume")
    assert code == 2 and checkpoint.name in err and "torn" in err
    checkpoint.write_text(whole.replace('"step":', '"step":1', 1))
    code, _, err = run(*RECORDED, "--out", tmp_path, "--resume")
    assert code == 2 and "checksum" in err
    checkpoint.write_text(whole)
    series = tmp_path / "series" / (checkpoint.stem + ".csv")
    series.write_bytes(series.read_bytes()[:100])
    code, _, err = run(*RECORDED, "--out", tmp_path, "--resume")
    assert code == 2 and series.name in err
    assert run(*RECORDED, "--out", tmp_path, "--overwrite")[0] == 0
    assert not (tmp_path / "checkpoints").exists()
    code, _, err = run("scene", "run", "pendulum3", "--steps", 10, "--resume")
    assert code == 2 and "--out" in err


def test_correlation_resumes_and_its_gate_catches_a_worse_run(tmp_path):
    words = [
        "scene",
        "correlate",
        "pendulum3",
        "--types",
        "float,double",
        "--reference",
        "float128",
    ]
    words += ["--until", "1.5", "--series", "--out"]
    code, table, err = run(*words, tmp_path / "whole")
    assert code == 0, err
    assert "limited by rounding" in table and "limited by the end of the run" in table
    rows = [
        json.loads(x)
        for x in (tmp_path / "whole/correlation.jsonl").read_text().splitlines()
    ]
    assert {r["against"] for r in rows} == {"RealHP4", "half_step", "float128"}
    process = start(*words, tmp_path / "cut")
    wait_for(tmp_path / "cut/series/pendulum3_float128_RealHP4.csv")
    process.send_signal(signal.SIGTERM)
    process.communicate()
    code, _, err = run(*words, tmp_path / "cut", "--resume")
    assert code == 0, err
    assert everything_in(tmp_path / "cut") == everything_in(tmp_path / "whole")

    budgets = tmp_path / "budgets"
    gate = ["gate", tmp_path / "whole", "--budgets", budgets]
    assert run(*gate)[0] == 2, "no directory of budgets"
    assert run(*gate, "--update")[0] == 0
    assert run(*gate)[0] == 0
    scenes = tmp_path / "whole/scenes.jsonl"
    worse = []
    for line in scenes.read_text().splitlines():
        row = json.loads(line)
        if row["type"] == "double":
            row["max_energy_error"] *= 2
        worse.append(json.dumps(row))
    scenes.write_text("\n".join(worse) + "\n")
    code, _, err = run(*gate)
    assert code == 2 and "scenes.jsonl: not as the run wrote it" in err
    context = json.loads((tmp_path / "whole/context.json").read_text())
    context["records_checksum"]["scenes.jsonl"] = fnv1a(scenes.read_text())
    del context["checksum"]
    (tmp_path / "whole/context.json").write_text(sealed(json.dumps(context, indent=2)))
    code, out, _ = run(*gate)
    assert (
        code == 1
        and "energy error" in out
        and "reproduce: ulpgate scene correlate pendulum3 --types double" in out
    )
    code, out, _ = run(*gate, "--update")
    assert code == 1 and "WOULD LOOSEN" in out
    (budgets / "pendulum3.toml").write_text("[budget.x]\nt_s = -1\n")
    code, _, err = run(*gate)
    assert code == 2 and "pendulum3.toml:2" in err


def test_a_trusted_reference_is_not_run_again(tmp_path):
    words = ["scene", "correlate", "pendulum3", "--types", "float,double"]
    words += ["--reference", "long_double", "--until", "1.5", "--out"]
    told, trusted = tmp_path / "told", tmp_path / "trusted"
    assert run(*words, told)[0] == 0
    code, table, err = run(*words, trusted, "--trust-reference")
    assert code == 0, err
    assert "not told" in table and "RealHP<4>" not in table

    def rows(of):
        lines = (of / "correlation.jsonl").read_text().splitlines()
        found = [json.loads(line) for line in lines]
        return {row["type"]: row for row in found if row["against"] == "long_double"}

    assert len((trusted / "correlation.jsonl").read_text().splitlines()) == 2
    for token, row in rows(trusted).items():
        limit = {"float": "not told", "double": "the end of the run"}[token]
        known = {"limited_by": limit, "plan": row["plan"]}
        assert row == rows(told)[token] | known
    assert not list((trusted / "correlation").glob("*RealHP4*"))
    # The other plan is not gone on with.
    code, _, err = run(*words, trusted, "--resume")
    assert code == 2, err
    alone = ["scene", "correlate", "pendulum3", "--types", "double", "--reference"]
    code, _, err = run(*alone, "double", "--until", "1.5", "--trust-reference")
    assert code == 3 and "nothing to correlate" in err
    budgets = tmp_path / "budgets"
    assert run("gate", told, "--budgets", budgets, "--update")[0] == 0
    code, text, err = run("gate", trusted, "--budgets", budgets)
    assert code == 0, text + err
    code, _, err = run("report", trusted, "--out", tmp_path / "page")
    assert code == 0, err


def test_all_parts_record_the_same_energies(tmp_path):
    words = [
        "scene",
        "run",
        "pendulum3",
        "--types",
        "double",
        "--steps",
        3000,
        "--series",
        "--out",
    ]
    assert run(*words, tmp_path / "lean")[0] == 0
    assert run(*words, tmp_path / "full", "--all-parts")[0] == 0
    name = "series/pendulum3_double.csv"
    assert (tmp_path / "lean" / name).read_bytes() == (
        tmp_path / "full" / name
    ).read_bytes()


@pytest.mark.parametrize("dt,published", [("1e-5", 1.87e-10), ("1e-6", 1.27e-9)])
def test_a_setup_made_in_float_has_the_published_energy_error(tmp_path, dt, published):
    """A chaotic walk: the figures come back only where every constant has the published run's bits."""
    code, _, err = run(
        *["scene", "run", "pendulum3", "--types", "float", "--dt", dt, "--until", "16"],
        *["--set", "constants=stepwise", "--set", "material.rod.stiffness=100"],
        *["--series", "--out", tmp_path],
    )
    assert code == 0, err
    record = json.loads((tmp_path / "scenes.jsonl").read_text().splitlines()[0])
    assert record["max_energy_error"] == pytest.approx(published, rel=0.03)


def test_correlation_needs_a_chain(tmp_path):
    code, _, err = run("scene", "correlate", "collision", "--out", tmp_path)
    assert code == 2 and "chain" in err or "record_every" in err
