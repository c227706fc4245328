"""The outputs of the gate, each held to its format by a reader of its own: JUnit, Markdown, OpenMetrics, SARIF."""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml

import jsonschema
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

import program  # noqa: E402
from program import run  # noqa: E402

OUTPUTS = ("junit", "markdown", "openmetrics", "sarif")


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A run of functions, its budgets, budgets that it does not hold, and a run that is not whole."""
    place = tmp_path_factory.mktemp("outputs")
    code, _, err = run(
        *("math", "--types", "float,double", "--functions", "sin,exp,ctan,pow"),
        *("--samples", "200", "--strata", "uniform,edges", "--timing", "off"),
        *("--out", place / "records"),
    )
    assert code == 0, err
    words = ("gate", place / "records", "--budgets", place / "budgets", "--update")
    assert run(*words)[0] == 0
    shutil.copytree(place / "budgets", place / "red")
    for file in (place / "red").glob("*.toml"):
        text = re.sub(
            r"(?m)^(max_ulp|mean_ulp) = {.*}$",
            lambda m: re.sub(r"= [0-9][^ ,]*", "= 1e-9", m[0]),
            file.read_text(),
        )
        file.write_text(text)
    (place / "part").mkdir()
    shutil.copy(place / "budgets/double.toml", place / "part")
    (place / "empty").mkdir()
    return place


def gate(place, out, records="records", budgets="budgets", **changed):
    """Exit code and the files of all outputs."""
    out.mkdir(exist_ok=True)
    files = {name: out / name for name in OUTPUTS} | changed
    words = ["gate", place / records, "--budgets", place / budgets]
    for name, file in files.items():
        words += [f"--{name}", file]
    code, text, err = run(*words)
    return code, files, text, err


# What stands for green, red and incomplete: records, budgets, exit code.
CASES = [
    ("records", "budgets", 0),
    ("records", "red", 1),
    ("records", "part", 3),
    ("empty", "budgets", 3),
]
cases = pytest.mark.parametrize("records, budgets, expected", CASES)

# The elements and attributes of junit-10.xsd (Jenkins, xunit plugin) that readers know, and who may hold whom.
JUNIT = {
    "testsuites": ({"name", "tests", "failures", "errors", "time"}, {"testsuite"}),
    "testsuite": (
        {"name", "tests", "failures", "errors", "skipped", "time"},
        {"properties", "testcase"},
    ),
    "properties": (set(), {"property"}),
    "property": ({"name", "value"}, set()),
    "testcase": ({"classname", "name", "time"}, {"failure", "error", "system-out"}),
    "failure": ({"message", "type"}, set()),
    "error": ({"message", "type"}, set()),
    "system-out": (set(), set()),
}


def check_junit(element):
    attributes, children = JUNIT[element.tag]
    assert set(element.attrib) == attributes, element.tag
    for child in element:
        assert child.tag in children, (element.tag, child.tag)
        check_junit(child)


@cases
def test_junit(place, tmp_path, records, budgets, expected):
    code, files, _, _ = gate(place, tmp_path, records, budgets)
    assert code == expected
    root = xml.parse(files["junit"]).getroot()
    assert root.tag == "testsuites"
    check_junit(root)
    for suite in (root, *root):
        tests = list(suite.iter("testcase"))
        assert int(suite.get("tests")) == len(tests) > 0, "an empty file is green"
        for tag in ("failure", "error"):
            count = sum(1 for test in tests if test.find(tag) is not None)
            assert int(suite.get(f"{tag}s")) == count
    names = [(t.get("classname"), t.get("name")) for t in root.iter("testcase")]
    assert len(set(names)) == len(names)
    failures = list(root.iter("failure"))
    errors = list(root.iter("error"))
    assert bool(failures) == (expected == 1)
    assert bool(errors) == (expected == 3)
    for failure in failures:
        assert "reproduce: ulpgate " in failure.text


def parse_openmetrics(text):
    """Samples by family, by the grammar of OpenMetrics 1.0 (section 'Text format' of the specification), strictly."""
    assert text.endswith("# EOF\n") and text.count("# EOF") == 1
    name = r"[a-zA-Z_:][a-zA-Z0-9_:]*"
    label = r'[a-zA-Z_][a-zA-Z0-9_]*="(?:[^"\\\n]|\\["\\n])*"'
    number = (
        r"(?:[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?|NaN|[-+]Inf)"
    )
    sample = re.compile(rf"({name})(?:{{((?:{label})(?:,{label})*)}})? ({number})")
    families = {}
    family = None
    seen = set()
    for line in text[: -len("# EOF\n")].splitlines():
        if line.startswith("# TYPE "):
            family, kind = line[len("# TYPE ") :].split(" ")
            assert re.fullmatch(name, family) and kind in ("gauge", "info")
            assert family not in families, "the samples of a family stand together"
            families[family] = (kind, [])
        elif line.startswith("# HELP "):
            assert line.split(" ")[2] == family
        else:
            found = sample.fullmatch(line)
            assert found, line
            kind, samples = families[family]
            assert found[1] == family + ("_info" if kind == "info" else "")
            keys = re.findall(rf"({label})", found[2] or "")
            labels = {k.split("=", 1)[0]: k.split("=", 1)[1] for k in keys}
            assert len(labels) == len(keys), "a label twice"
            assert (found[1], found[2]) not in seen, "a sample twice"
            seen.add((found[1], found[2]))
            samples.append((labels, float(found[3])))
    return {family: samples for family, (_, samples) in families.items()}


@cases
def test_openmetrics(place, tmp_path, records, budgets, expected):
    code, files, _, _ = gate(place, tmp_path, records, budgets)
    assert code == expected
    text = files["openmetrics"].read_text()
    families = parse_openmetrics(text)
    assert [value for _, value in families["ulpgate_gate_exit_code"]] == [expected]
    ratios = [value for _, value in families["ulpgate_budget_ratio"]]
    if records == "records":
        # Two types; ctan has two parts; two strata.
        assert len(families["ulpgate_measured"]) == 2 * 5 * 2
        assert (max(ratios) > 1) == (expected == 1)
    found = {
        labels["kind"]: value for labels, value in families["ulpgate_gate_findings"]
    }
    assert bool(found['"regression"']) == (expected == 1)
    try:
        from prometheus_client.openmetrics import parser
    except ImportError:
        return
    assert len(list(parser.text_string_to_metric_families(text))) == len(families)


@cases
def test_markdown(place, tmp_path, records, budgets, expected):
    code, files, text, _ = gate(place, tmp_path, records, budgets)
    assert code == expected
    markdown = files["markdown"].read_text()
    words = {0: "passes", 1: "red", 3: "incomplete"}[expected]
    assert markdown.splitlines()[0].startswith(f"## ulpgate gate: {words}")
    assert len(markdown.encode()) < 1 << 20
    numbered = re.findall(r"(?m)^(\d+)\. \*\*", markdown)
    failing = sum(
        1 for line in text.splitlines() if re.match(r"(FAIL|NO BUDGET) ", line)
    )
    assert len(numbered) == min(20, failing)
    assert markdown.count("\nreproduce: ulpgate ") == len(numbered)
    if failing > 20:
        assert f"... and {failing - 20} more" in markdown
    assert "| records | rows |" in markdown


SARIF = json.loads(
    (pathlib.Path(__file__).parent / "sarif_subset.schema.json").read_text()
)


@cases
def test_sarif(place, tmp_path, records, budgets, expected):
    code, files, text, _ = gate(place, tmp_path, records, budgets)
    assert code == expected
    log = json.loads(files["sarif"].read_text())
    jsonschema.Draft202012Validator(SARIF).validate(log)
    only = log["runs"][0]
    rules = [rule["id"] for rule in only["tool"]["driver"]["rules"]]
    invocation = only["invocations"][0]
    assert invocation["exitCode"] == expected
    assert invocation["executionSuccessful"] == (expected in (0, 1))
    if records == "empty":
        assert invocation["toolExecutionNotifications"]
    results = only["results"]
    assert len(results) == len(re.findall(r"(?m)^(FAIL|NO BUDGET) ", text))
    for result in results:
        assert rules[result["ruleIndex"]] == result["ruleId"]
        where = result["locations"][0]["physicalLocation"]
        file = where["artifactLocation"]["uri"]
        assert file.startswith("file:///")
        row = result["locations"][0]["logicalLocations"][0]["fullyQualifiedName"]
        row = row.rsplit("/", 1)[1]
        if result["ruleId"] == "regression":
            lines = pathlib.Path(file[len("file://") :]).read_text().splitlines()
            assert lines[where["region"]["startLine"] - 1] == f'[budget."{row}"]'


def test_sarif_is_relative_to_where_the_gate_runs(place, tmp_path):
    words = ["gate", place / "records", "--budgets", "red", "--sarif", tmp_path / "s"]
    done = subprocess.run(program.command(*words), cwd=place, capture_output=True)
    assert done.returncode == 1
    log = json.loads((tmp_path / "s").read_text())
    uris = {
        result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
        for result in log["runs"][0]["results"]
    }
    assert uris == {"red/float.toml", "red/double.toml"}


def test_outputs_are_the_same_bytes(place, tmp_path):
    files = [gate(place, tmp_path / name, budgets="red")[1] for name in "ab"]
    for name in OUTPUTS:
        assert files[0][name].read_bytes() == files[1][name].read_bytes()


@pytest.mark.parametrize("name", OUTPUTS)
def test_a_file_that_cannot_be_written_is_exit_4_after_the_verdict(
    place, tmp_path, name
):
    code, files, text, err = gate(
        place, tmp_path, budgets="red", **{name: tmp_path / "nowhere/file"}
    )
    assert code == 4 and "FAIL" in text and "nowhere/file" in err
    others = [file for other, file in files.items() if other != name]
    assert all(file.stat().st_size > 0 for file in others), "the others are written"
    assert not list(tmp_path.glob("*.part"))


def test_outputs_that_make_no_sense_are_refused(place, tmp_path):
    words = ["gate", place / "records", "--budgets", place / "budgets"]
    same = ["--junit", tmp_path / "x", "--sarif", tmp_path / "y/../x"]
    code, _, err = run(*words, *same)
    assert code == 2 and "one file" in err
    code, _, err = run(*words, "--update", "--junit", tmp_path / "x")
    assert code == 2 and "verdict" in err
    assert not (tmp_path / "x").exists()


def test_names_with_every_kind_of_character_survive(place, tmp_path):
    odd = tmp_path / 'a "b" <c> & `d` | \\e \té\n\x01 %'
    shutil.copytree(place / "records", odd)
    files = {name: tmp_path / name for name in OUTPUTS}
    words = ["gate", odd, "--budgets", place / "red"]
    for name, file in files.items():
        words += [f"--{name}", file]
    assert run(*words)[0] == 1
    check_junit(xml.parse(files["junit"]).getroot())
    families = parse_openmetrics(files["openmetrics"].read_text())
    label = families["ulpgate_gate_exit_code"][0][0]["records"]
    escapes = {"\\\\": "\\", '\\"': '"', "\\n": "\n"}
    back = re.sub(r'\\[\\"n]', lambda m: escapes[m[0]], label[1:-1])
    assert back == str(odd)
    log = json.loads(files["sarif"].read_text())
    assert log["runs"][0]["results"][0]["properties"]["records"] == str(odd)
    assert files["markdown"].read_text().count("\n1. ") == 1


def test_what_the_same_argument_shows_is_told_together(place, tmp_path):
    _, _, text, _ = gate(place, tmp_path, "records", "red")
    groups = []
    for line in text.splitlines():
        if line.startswith("FAIL "):
            row = line.split(":")[0].split(maxsplit=1)[1]
            if not groups or groups[-1]["details"] and row != groups[-1]["row"]:
                groups.append({"row": row, "limits": [], "details": []})
            groups[-1]["limits"].append(line)
        elif "   reproduce: " in line:
            # Its first limit alone is followed by what shows it.
            if groups[-1]["details"]:
                last = groups[-1]["limits"].pop()
                groups.append({"row": row, "limits": [last], "details": []})
            groups[-1]["details"].append(line.strip())
    assert all(len(group["details"]) == 1 for group in groups)
    shown = [(group["row"], group["details"][0]) for group in groups]
    assert len(set(shown)) == len(shown)
    together = [group["limits"] for group in groups if len(group["limits"]) > 1]
    assert together
    for first, *_ in together:
        assert "maximum error" in first
