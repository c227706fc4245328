"""Tests of a page that several kinds of records share."""
import json
import shutil

from ulpgate_report.app import build, cli
from ulpgate_report.records import reading, records
from ulpgate_report.scenes import kind as kind_scenes
from ulpgate_report.testing import sample_kernels, sample_scenes
from ulpgate_report.testing.page_check import References

TOKENS = ("float", "double", "mpfr62")


def test_scenes_and_kernels_share_a_page(tmp_path):
    run_directory = sample_scenes.write_sample(tmp_path / "run", TOKENS, bodies=30)
    context = {**sample_kernels.context(), "plan": sample_scenes.PLAN}
    sample_kernels.write(run_directory, sample_kernels.records(), context)
    assert cli.main([str(run_directory), "--out", str(tmp_path)]) == 0
    page = (tmp_path / "index.html").read_text("utf-8")
    assert 'id="kernel_stability"' in page and 'id="scene_table"' in page
    found = References()
    found.feed(page)
    assert len(set(found.ids)) == len(found.ids), "of seven figures on one page"
    links = [value for _, value in found.fetched if not value.startswith("data:image/")]
    assert {link[1:] for link in links} <= set(found.ids)
    summary = json.loads((tmp_path / "summary.json").read_text("utf-8"))
    reading.validator("summary").validate(summary)
    assert len(summary["scenes"]) == len(TOKENS) and summary["kernels"]
    # The records of the scenes alone draw nothing: what stays would be the older report's.
    for name in ("kernels.jsonl", "timing.jsonl"):
        (run_directory / name).unlink()
    for folder in ("series", "snapshots"):
        shutil.rmtree(run_directory / folder)
    assert cli.main([str(run_directory), "--out", str(tmp_path)]) == 0
    assert not list(tmp_path.rglob("kernel*")), "nothing of the older report stays"
    assert not list((tmp_path / "figures").iterdir())
    assert [one for one, _ in build.parts_of(records.load(run_directory))] == [
        kind_scenes
    ]
