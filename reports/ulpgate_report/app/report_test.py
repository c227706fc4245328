"""Tests of the whole report: the files, the page that stands alone, the summary, nothing stale."""
import json
import shutil

import pytest

from ulpgate_report.app import cli
from ulpgate_report.records import reading
from ulpgate_report.testing import sample_records
from ulpgate_report.testing.page_check import References

SCRIPT_NAME = '<script>alert("x")</script>'
FIGURES = ["error_vs_time", "heatmap", "distributions_real", "distributions_complex"]


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    """(run directory, report directory) of a small run whose one function has a hostile name."""
    base = tmp_path_factory.mktemp("report")
    context = sample_records.context(["sin", "fmod", "ctan"])
    context["functions"][0]["name"] = SCRIPT_NAME
    context["cpu"] = "<b>cpu</b>"
    math = sample_records.math_records(context)
    timing = sample_records.timing_records(context)
    run = sample_records.write(base / "run", context, math, timing)
    assert cli.main([str(run), "--out", str(base / "out")]) == 0
    return run, base / "out"


def test_page_stands_alone(report):
    text = (report[1] / "index.html").read_text("utf-8")
    page = References()
    page.feed(text)
    assert page.fetched
    outside = [(tag, value) for tag, value in page.fetched if not value.startswith("#")]
    assert outside == []
    assert len(set(page.ids)) == len(page.ids)
    assert {value[1:] for _, value in page.fetched} <= set(page.ids)
    assert "@import" not in text and "url(http" not in text
    assert "<?xml" not in text
    expected = [
        "type_table",
        "worst_table",
        "ulp_matrix",
        "paper_table",
        "ulp_table",
        "mismatch_table",
        "long_table",
    ]
    assert page.tables == [name for name in expected if name in page.tables]
    assert {"ulp_matrix", "paper_table", "ulp_table", "long_table"} <= set(page.tables)


def test_page_escapes_everything(report):
    text = (report[1] / "index.html").read_text("utf-8")
    page = References()
    page.feed(text)
    assert page.scripts == 2, "the data and the program, none from a name"
    assert SCRIPT_NAME not in text
    assert "<b>cpu</b>" not in text and "&lt;b&gt;cpu&lt;/b&gt;" in text


def test_page_holds_the_histograms(report):
    text = (report[1] / "index.html").read_text("utf-8")
    start = text.index('id="distributions">') + len('id="distributions">')
    data = json.loads(text[start : text.index("</script>", start)])
    assert list(data["curves"]) == [SCRIPT_NAME, "sin", "ctan re", "ctan im"]
    judged, exact, buckets = data["curves"]["ctan re"]["1"]
    assert judged == exact + sum(count for _, count in buckets)


def test_files_and_summary(report):
    out = report[1]
    for name in FIGURES:
        for suffix in ("pdf", "svg", "png", "caption.txt"):
            assert (out / "figures" / f"{name}.{suffix}").stat().st_size > 0
    assert not list(out.rglob("*.part"))
    summary = json.loads((out / "summary.json").read_text("utf-8"))
    reading.validator("summary").validate(summary)
    assert len(summary["cells"]) == 4 * 7
    lines = [
        json.loads(line) for line in (report[0] / "math.jsonl").open(encoding="utf-8")
    ]
    for cell in summary["cells"]:
        mine = [
            line
            for line in lines
            if all(line[key] == cell[key] for key in ("function", "part", "type"))
        ]
        assert cell["max_ulp"] == max(line["max_ulp"] for line in mine)
        assert cell["samples"] == sum(line["samples"] for line in mine)


def test_second_report_is_the_same_and_nothing_stale_stays(report, tmp_path):
    run, first = report
    assert cli.main([str(run), "--out", str(tmp_path)]) == 0
    names = sorted(
        path.relative_to(first) for path in first.rglob("*") if path.is_file()
    )
    for name in names:
        assert (first / name).read_bytes() == (tmp_path / name).read_bytes(), name
    untimed = tmp_path / "untimed"
    shutil.copytree(run, untimed)
    (untimed / "timing.jsonl").unlink()
    assert cli.main([str(untimed), "--out", str(tmp_path)]) == 0
    assert not list((tmp_path / "figures").glob("error_vs_time*"))
    assert "Nothing was timed." in (tmp_path / "index.html").read_text("utf-8")
