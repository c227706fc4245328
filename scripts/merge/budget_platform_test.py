"""Tests that records of another C library or Boost than the budgets' are told, and patch releases are not."""

import json
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import budget_platform  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]

CASES = [
    ("2.36", "1.81.0", ""),
    ("2.36", "1.81.1", ""),
    ("2.41", "1.81.0", "this is glibc 2.41 / Boost 1.81"),
    ("2.36", "1.88.0", "this is glibc 2.36 / Boost 1.88"),
    ("2.3", "1.8.0", "this is glibc 2.3 / Boost 1.8"),
]


@pytest.mark.parametrize("glibc, boost, sentence", CASES)
def test_another_library_is_named(tmp_path, glibc, boost, sentence):
    (tmp_path / "platform").write_text("glibc 2.36\nBoost 1.81\n")
    context = {"libraries": {"glibc": glibc, "Boost": boost, "MPFR": "4.2.0"}}
    (tmp_path / "context.json").write_text(json.dumps(context))
    told = budget_platform.difference(tmp_path, tmp_path)
    assert told.endswith(sentence)
    assert bool(told) == bool(sentence)
    if told:
        assert told.startswith("budgets of glibc 2.36 / Boost 1.81, ")


def test_a_platform_with_rows_of_its_own_is_no_other(tmp_path):
    (tmp_path / "platform").write_text("glibc 2.36\nBoost 1.81\n")
    libraries = {"glibc": "2.41", "Boost": "1.88.0"}
    context = {"libraries": libraries, "instruction_sets": "AVX AVX2 FMA"}
    (tmp_path / "context.json").write_text(json.dumps(context))
    assert budget_platform.difference(tmp_path, tmp_path)
    own = tmp_path / "platforms/glibc-2.41_boost-1.88"
    own.mkdir(parents=True)
    assert budget_platform.difference(tmp_path, tmp_path), "an empty directory"
    (own / "platform").write_text("glibc 2.41\nBoost 1.88\n")
    assert not budget_platform.difference(tmp_path, tmp_path)
    context["instruction_sets"] = "AVX AVX2"
    (tmp_path / "context.json").write_text(json.dumps(context))
    told = budget_platform.difference(tmp_path, tmp_path)
    assert told.endswith("Boost 1.88 / instructions no-fma")


def test_the_budgets_name_their_platform():
    names = [
        line.split()[0]
        for line in (ROOT / "ci/budgets/platform").read_text().splitlines()
    ]
    assert names == ["glibc", "Boost"]
