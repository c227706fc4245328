"""Tests of the paper: what it shows, the same bytes twice, every number traced, a PDF whose numbers are known."""
import csv
import json
import shutil
import subprocess

import pytest

from ulpgate_report.libraries import kind as kind_libraries
from ulpgate_report.libraries.beside import Beside
from ulpgate_report.math import combine
from ulpgate_report.paper import (
    check,
    cli,
    findings,
    fragments,
    provenance,
    source,
    tables,
    write,
)
from ulpgate_report.records import records
from ulpgate_report.testing import sample_pendulum, sample_records, sample_scenes

CLAIM = {
    "function": "sin",
    "type": "double",
    "implementation": "libsleef.so.3 Sleef_sin_u10",
    "symbol": "Sleef_sin_u10",
    "claim_ulp": 1.0,
    "largest_ulp": 8556.5,
    "args": ["0x1.065c829d6873p+40"],
    "mismatches": [],
    "arguments": 20000,
    "holds": False,
}


def _write_runs(runs):
    """A run of functions, a pendulum and one library's claims."""
    context = sample_records.context(["sin", "lgamma", "ctan"])
    math = sample_records.math_records(context)
    timing = sample_records.timing_records(context)
    sample_records.write(runs / "math", context, math, timing)
    for entry in sample_records.TYPES[:2]:
        one = sample_records.context(["sin"], [entry], ["uniform", "stratified"])
        rows = sample_records.math_records(one, [entry])
        sample_records.write(runs / "published" / entry[0], one, rows, [])
    sample_pendulum.write_suite(
        runs / "pendulum", tokens=("double", "mpfr150"), end=3.0, every=1e-2
    )
    for run in ("dt_1e-6", "damped"):
        shutil.rmtree(runs / "pendulum" / run)
    for build in ("gcc_default", "gcc_native"):
        place = runs / "speed" / build
        sample_scenes.write_sample(place, tokens=("float", "double"), bodies=5)
    claims = runs / "claims" / "sleef"
    claims.mkdir(parents=True)
    (claims / "claims.json").write_text(json.dumps([CLAIM]))
    commands = {"math": "ulpgate math --samples 1000 --out math"}
    (runs / "commands.json").write_text(json.dumps(commands))
    return runs


@pytest.fixture(scope="module")
def paper(tmp_path_factory):
    """(runs, paper) of a small run."""
    base = tmp_path_factory.mktemp("paper")
    runs = _write_runs(base / "runs")
    assert cli.main([str(runs), "--out", str(base / "out")]) == 0
    return runs, base / "out"


def _manifest(out):
    return json.loads((out / write.MANIFEST).read_text())


def test_every_figure_has_its_numbers_its_caption_and_a_fragment(paper):
    _, out = paper
    names = {p.name.removesuffix(".tex") for p in (out / "figures").glob("*.tex")}
    assert {"heatmap", "error_vs_time", "distributions_real"} <= names
    assert any(name.startswith("pendulum_t_s") for name in names)
    for name in names:
        for suffix in ("pdf", "svg", "png", "caption.txt"):
            assert (out / f"figures/{name}.{suffix}").stat().st_size, name
        rows = list(csv.reader(open(out / f"data/{name}.csv", encoding="utf-8")))
        assert len(rows) > 3, name
        # No font is of type 3, which publishers refuse.
        assert b"/Type3" not in (out / f"figures/{name}.pdf").read_bytes()
    assert (out / "figures/error_vs_time_column.pdf").exists()


def test_a_caption_says_what_made_it(paper):
    _, out = paper
    text = (out / "figures/error_vs_time.caption.txt").read_text()
    context = sample_records.context(["sin"])
    assert f"seed {context['seed']}" in text
    assert "ulpgate math --samples 1000 --out math" in text
    for stratum in context["strata"]:
        assert stratum in text


def test_plotted_numbers_are_those_of_the_records(paper):
    runs, out = paper
    times = {
        json.loads(line)["ns_per_eval"]
        for line in (runs / "math/timing.jsonl").read_text().splitlines()
    }
    with open(out / "data/error_vs_time.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    drawn = {10 ** float(r["x"]) for r in rows if r["kind"] == "line" and r["x"]}
    for time in times:
        assert any(abs(one / time - 1) < 1e-9 for one in drawn), time


def test_speeds_of_all_builds_stand_in_one_figure(paper):
    _, out = paper
    with open(out / "data/speed_builds.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    legend = [r["series"] for r in rows if r["kind"] == "legend"]
    assert legend[:2] == ["gcc default, 1 thread", "gcc default, 4 threads"]
    timing = sample_scenes.timing_record("float")
    heights = {r["value"] for r in rows if r["kind"] == "bar"}
    assert repr(timing["iterations_per_s"]) in heights


def test_what_was_not_run_is_said(paper):
    runs, out = paper
    _, left_out = source.load(runs)
    assert any("Stiff and extreme cases" in sentence for sentence in left_out)
    assert "Stiff and extreme cases: nothing was run" in (out / "paper.tex").read_text()


def test_ours_stand_beside_the_published(paper):
    _, out = paper
    with open(out / "data/beside_published.csv", encoding="utf-8") as file:
        rows = {(r["function"], r["type"]): r for r in csv.DictReader(file)}
    assert rows["lgamma", "double"]["published"] == "8"
    assert rows["sin", "double"]["published"] == "1"


def test_runs_of_a_type_each_are_one_table(paper):
    _, out = paper
    with open(out / "data/published_paper_table.csv", encoding="utf-8") as file:
        head = next(csv.reader(file))
    for entry in sample_records.TYPES[:2]:
        assert entry[0] in head


def test_findings_name_the_library_and_the_command(paper):
    _, out = paper
    with open(out / "data/findings.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    mine = [r for r in rows if r["library"] == "libsleef.so.3"]
    assert mine[0]["says"] == "errs by 8556 ULP where 1 is documented"
    assert mine[0]["command"] == (
        "ulpgate at sin double 0x1.065c829d6873p+40 --library libsleef.so.3 --symbol Sleef_sin_u10"
    )
    assert r"\input{findings.tex}" in (out / "paper.tex").read_text()


def test_other_libraries_have_their_findings():
    context = sample_records.context(["sin"])
    run = combine.combine_run(
        records.Run(context, sample_records.math_records(context), {})
    )
    beside = Beside(("glibc", "musl"), (run, run))
    found = write.libraries_of({kind_libraries: beside})
    assert found == [("musl", run)]


def test_samples_are_those_of_a_stratum():
    both = {"samples": 100, "strata": ["uniform", "stratified", "binades"]}
    assert provenance.arguments(both).startswith("50 samples")
    one = {"samples": 100, "strata": ["uniform"]}
    assert provenance.arguments(one).startswith("100 samples")
    states = {"samples": 64, "strata": ["uniform", "stratified", "cone"]}
    assert provenance.arguments(states).startswith("64 samples")


def test_a_contaminated_constant_is_a_finding():
    class Pendulum:
        correlations = [
            {"scene": "p", "dt": "1e-5", "type": "mpfr62", "against": "mpfr150"}
            | {"variant": variant, "t_s": t_s, "to_the_end": False}
            for variant, t_s in (("", 10.75), ("mass=yade", 9.8))
        ]

    (found,) = findings.of_pendulum(Pendulum)
    assert found.library == "YADE" and found.type == "mpfr62"
    assert "9.80 s" in found.says and "10.75 s" in found.says


def test_subjects_are_grouped_and_real_functions_stand_first():
    made = [
        findings.Finding("glibc 2.36", subject, token, "errs", "c", subject, order)
        for subject, token, order in (
            ("cpow re", "float", (2, -1e9)),
            ("cpow re", "double", (2, -1e12)),
            ("cos", "double", (0, -1e5)),
        )
    ]
    ((library, subjects, more),) = findings.by_library(made)
    assert library == "glibc 2.36" and more == 0
    assert [[f.type for f in same] for same in subjects] == [
        ["double"],
        ["double", "float"],
    ]


def test_every_number_is_traced(paper, capsys):
    runs, out = paper
    assert cli.main([str(runs), "--out", str(out), "--check"]) == 0
    said = capsys.readouterr().out
    # The same records give the same bytes: the check made them anew.
    assert "files are what the records give" in said
    with open(out / check.TRACE, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    of_table = [r for r in rows if r["fragment"] == "data/worst_table.csv"]
    found = [r for r in of_table if r["column"] == "max_ulp"]
    assert found and all(r["how"] == "record" for r in found)
    assert all("math/math.jsonl:" in r["where"] for r in found)


@pytest.mark.parametrize(
    "name, change",
    [
        ("data/beside_published.csv", lambda text: text.replace("8", "7", 1)),
        ("tables/ulp_matrix.tex", lambda text: text.replace("1", "2", 1)),
        ("figures/error_vs_time.svg", lambda text: text + " "),
    ],
    ids=["a number of data", "a number of a table", "a figure"],
)
def test_what_was_changed_by_hand_is_found(paper, tmp_path, capsys, name, change):
    runs, out = paper
    other = tmp_path / "out"
    shutil.copytree(out, other)
    (other / name).write_text(change((other / name).read_text()))
    assert cli.main([str(runs), "--out", str(other), "--check"]) == 1
    said = capsys.readouterr()
    assert f"{name}: not what was written" in said.err
    assert "files are what the records give" not in said.out


def test_other_records_are_found(tmp_path, capsys):
    """Of a paper of one function, which is made twice."""
    other, out = tmp_path / "runs", tmp_path / "out"
    context = sample_records.context(["sin"], sample_records.TYPES[:2], ["uniform"])
    rows = sample_records.math_records(context, sample_records.TYPES[:2])
    timing = sample_records.timing_records(context)
    sample_records.write(other / "math", context, rows, timing)
    assert cli.main([str(other), "--out", str(out)]) == 0
    file = other / "math" / "timing.jsonl"
    lines = file.read_text().splitlines()
    row = json.loads(lines[0])
    row["ns_per_eval"] *= 2
    file.write_text("\n".join([json.dumps(row), *lines[1:]]) + "\n")
    assert cli.main([str(other), "--out", str(out), "--check"]) == 1
    assert "data/error_vs_time.csv: the records give another" in capsys.readouterr().err


@pytest.mark.skipif(
    shutil.which("pdflatex") is None or shutil.which("pdftotext") is None,
    reason="no pdflatex or pdftotext",
)
def test_the_document_compiles_and_prints_no_other_number(paper, tmp_path):
    runs, out = paper
    other = tmp_path / "out"
    shutil.copytree(out, other)
    words = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "paper.tex"]
    for _ in range(2):
        done = subprocess.run(words, cwd=other, capture_output=True, text=True)
        assert done.returncode == 0, done.stdout[-2000:]
    log = (other / "paper.log").read_text(errors="replace")
    assert "undefined" not in log.lower()
    names = _manifest(other)["files"]
    assert check.of_pdf(other, names) == []
    # A number that somebody types into the document is in nothing it was made of.
    text = (other / "paper.tex").read_text()
    (other / "paper.tex").write_text(
        text.replace(r"\maketitle", r"\maketitle 98765.4321 ULP")
    )
    subprocess.run(words, cwd=other, capture_output=True, check=True)
    (other / "paper.tex").write_text(text)
    assert check.of_pdf(other, names) == ["98765.4321"]


@pytest.mark.parametrize(
    "content, expected",
    [(None, 3), ("{", 2), ("[]", 2)],
    ids=["no runs", "broken commands", "commands of another kind"],
)
def test_bad_input_is_named(paper, tmp_path, capsys, content, expected):
    runs, _ = paper
    other = tmp_path / "runs"
    if content is not None:
        shutil.copytree(runs, other)
        (other / "commands.json").write_text(content)
    assert cli.main([str(other), "--out", str(tmp_path / "out")]) == expected
    assert str(other) in capsys.readouterr().err


def test_speeds_need_a_run_beside_them(tmp_path):
    place = tmp_path / "speed" / "1_threads"
    place.mkdir(parents=True)
    (place / "timing.jsonl").write_text(
        json.dumps(sample_scenes.timing_record("double"))
    )
    with pytest.raises(source.NothingMeasured):
        source.load(tmp_path)


def test_how_many_commands_there_are_is_no_command():
    assert provenance.in_code("ulpgate math --out a") == "`ulpgate math --out a`"
    more = provenance.in_code("ulpgate math --out a and 4 more in commands.json")
    assert more == "`ulpgate math --out a` and 4 more in `commands.json`"
