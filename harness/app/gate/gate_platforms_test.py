"""Budgets of platforms: which are used, what a first run on another platform writes, and what is refused."""

import json
import pathlib
import re
import shutil
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "reading"))

from edited_records import run, seal  # noqa: E402


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """Records of functions and of a scene, and budgets that just hold for them, with the platform they are of."""
    place = tmp_path_factory.mktemp("platforms")
    code, _, err = run(
        *("math", "--types", "float", "--functions", "sin,exp", "--timing", "off"),
        *("--samples", "200", "--strata", "uniform,edges", "--out", place / "math"),
    )
    assert code == 0, err
    code, _, err = run(
        *("scene", "run", "pendulum3", "--types", "double", "--steps", "50"),
        *("--series", "--out", place / "scene"),
    )
    assert code == 0, err
    libraries = json.loads((place / "math/context.json").read_text())["libraries"]
    for records, budgets in (("math", "budgets"), ("scene", "budgets/scenes/run")):
        words = ("gate", place / records, "--budgets", place / budgets, "--update")
        assert run(*words)[0] == 0
    versions = [series(libraries[name]) for name in ("glibc", "Boost")]
    (place / "budgets/platform").write_text("glibc {}\nBoost {}\n".format(*versions))
    return place


def series(version):
    return ".".join(version.split(".")[:2])


@pytest.fixture
def other(place, tmp_path):
    """The same, and the records once more as if another C library and Boost had made them."""
    for name in ("math", "scene", "budgets"):
        shutil.copytree(place / name, tmp_path / name)
    of_platform(tmp_path, "2.99", "1.99.0")
    return tmp_path


def of_platform(place, glibc, boost, sets=None):
    for name in ("math", "scene"):
        file = place / name / "context.json"
        context = json.loads(file.read_text())
        context["libraries"]["glibc"] = glibc
        context["libraries"]["Boost"] = boost
        if sets is not None:
            context["instruction_sets"] = sets
        file.write_text(json.dumps(context))
        seal(place / name)


def gate(place, *words, records="math", budgets="budgets"):
    return run("gate", place / records, "--budgets", place / budgets, *words)


def tighten(file, key="max_ulp"):
    """As if the base had been measured with a better library: the budgets of one row, at a hundredth."""
    text = file.read_text()
    row = text.index('[budget."sin"]')
    changed = re.sub(
        rf"(?m)^{key} = {{.*}}$",
        lambda m: re.sub(r"uniform = [0-9][^ ,]*", "uniform = 0.005", m[0]),
        text[row:],
        count=1,
    )
    file.write_text(text[:row] + changed)


def test_the_base_is_used_on_its_own_platform_and_said(place):
    code, _, err = gate(place)
    assert code == 0 and "budgets of glibc " in err and "no budgets of" not in err


def test_another_platform_is_said_and_makes_its_own_budgets(other):
    base = other / "budgets/float.toml"
    tighten(base)
    before = base.read_bytes()
    code, out, err = gate(other)
    assert code == 1 and "FAIL" in out
    assert "no budgets of glibc 2.99, Boost 1.99" in err and "--platform auto" in err
    code, out, err = gate(other, "--update")
    assert code == 2 and "--platform auto" in err and base.read_bytes() == before
    code, out, err = gate(other, "--update", "--platform", "auto")
    assert code == 0 and "of the platform sin float" in out, err
    assert base.read_bytes() == before
    own = other / "budgets/platforms/glibc-2.99_boost-1.99"
    assert (own / "platform").read_text() == "glibc 2.99\nBoost 1.99\n"
    text = (own / "float.toml").read_text()
    assert re.findall(r"\[budget\.(.*)\]", text) == ['"sin"']
    assert 'reason = "as measured with glibc 2.99, Boost 1.99"' in text
    code, out, err = gate(other)
    assert code == 0 and "budgets of glibc 2.99, Boost 1.99, over those of" in err
    # What was known of the platform is loosened with a reason alone.
    tighten(own / "float.toml")
    held = (own / "float.toml").read_bytes()
    code, out, err = gate(other, "--update", "--platform", "auto")
    assert code == 1 and "WOULD LOOSEN sin" in out
    assert (own / "float.toml").read_bytes() == held
    code, out, err = gate(other, "--platform", "base")
    assert code == 1
    words = ("--update", "--platform", "auto", "--reason", "a newer patch")
    assert gate(other, *words)[0] == 0
    assert 'reason = "a newer patch"' in (own / "float.toml").read_text()
    assert gate(other)[0] == 0


def test_a_platform_without_a_row_of_its_own_is_known_all_the_same(other):
    assert gate(other, "--update", "--platform", "auto")[0] == 0
    own = other / "budgets/platforms/glibc-2.99_boost-1.99"
    assert [file.name for file in own.iterdir()] == ["platform"]
    code, _, err = gate(other)
    assert code == 0 and "no budgets of" not in err


def test_figures_have_platforms_too_below_the_same_root(other):
    where = {"records": "scene", "budgets": "budgets/scenes/run"}
    base = other / "budgets/scenes/run/pendulum3.toml"
    text = base.read_text()
    base.write_text(
        re.sub(r"(?m)^max_energy_error = .*$", "max_energy_error = 1e-99", text)
    )
    code, _, err = gate(other, **where)
    assert code == 1 and "no budgets of" in err
    assert gate(other, "--update", "--platform", "auto", **where)[0] == 0
    own = other / "budgets/platforms/glibc-2.99_boost-1.99/scenes/run/pendulum3.toml"
    assert own.is_file()
    code, _, err = gate(other, **where)
    assert code == 0, err


# Platforms with rows of their own, that of the run, and the one whose rows are used.
ORDER = [
    (["2.99 1.99", "2.99 1.90"], "2.99 1.99.0", "glibc 2.99, Boost 1.99"),
    (["2.99 1.90", "2.99 1.95"], "2.99 1.99.0", "glibc 2.99, Boost 1.95"),
    (["2.99 1.100", "2.99 1.95"], "2.99 1.99.0", "glibc 2.99, Boost 1.95"),
    (["2.99 1.101", "2.99 1.100"], "2.99 1.99.0", "glibc 2.99, Boost 1.100"),
    (["2.98 1.99"], "2.99 1.99.0", "base"),
]


@pytest.mark.parametrize("known, here, used", ORDER)
def test_the_order_in_which_platforms_are_looked_for(other, known, here, used):
    for platform in known:
        glibc, boost = platform.split()
        own = other / f"budgets/platforms/glibc-{glibc}_boost-{boost}"
        own.mkdir(parents=True)
        (own / "platform").write_text(f"glibc {glibc}\nBoost {boost}\n")
    of_platform(other, *here.split())
    code, _, err = gate(other)
    assert code == 0
    if used == "base":
        used = (other / "budgets/platform").read_text().replace("\n", ", ", 1).strip()
    said = re.search(
        r"(?:those of|budgets of) (glibc [\d.]+, Boost [\d.]+)",
        err.split("no budgets of")[-1],
    )
    if "no budgets of" in err:
        said = re.search(r"those of (glibc [\d.]+, Boost [\d.]+) are used", err)
    assert said[1] == used


def test_without_fused_multiply_add_it_is_another_platform(other):
    base = dict(
        line.split() for line in (other / "budgets/platform").read_text().splitlines()
    )
    of_platform(other, base["glibc"], base["Boost"] + ".0", "SSE4_1 SSE4_2 AVX")
    assert gate(other, "--update", "--platform", "auto")[0] == 0
    key = f"glibc-{base['glibc']}_boost-{base['Boost']}_no-fma"
    text = (other / "budgets/platforms" / key / "platform").read_text()
    assert text.endswith("instructions no-fma\n")
    code, _, err = gate(other)
    assert code == 0 and "no-fma" in err


def test_what_is_no_platform_is_refused(other):
    own = other / "budgets/platforms/glibc-2.99_boost-1.99"
    own.mkdir(parents=True)
    for text in (
        "",
        "glibc 2.99\n",
        "glibc 2.99\nBoost 1.98\n",
        "glibc two\nBoost 1\n",
    ):
        (own / "platform").write_text(text)
        code, _, err = gate(other)
        assert code == 2 and str(own) in err, (text, err)
    (own / "platform").write_text("glibc 2.99\nBoost 1.99\n")
    plan = (
        '[plan]\nsamples = 7\nseed = 1\n[budget."sin"]\nmax_ulp = { uniform = 1.0 }\n'
    )
    (own / "float.toml").write_text(plan)
    code, _, err = gate(other)
    assert code == 2 and "[plan]" in err and str(own) in err
    (other / "budgets/platform").unlink()
    shutil.rmtree(other / "budgets/platforms")
    assert gate(other)[0] == 0, "budgets that name no platform ask for none"
    code, _, err = gate(other, "--update", "--platform", "auto")
    assert code == 2 and "platform" in err


def test_a_platform_is_tightened_in_its_own_rows_alone(other):
    tighten(other / "budgets/float.toml")
    before = (other / "budgets/float.toml").read_bytes()
    code, _, err = gate(other, "--tighten")
    assert code == 1
    assert gate(other, "--update", "--platform", "auto")[0] == 0
    own = other / "budgets/platforms/glibc-2.99_boost-1.99/float.toml"
    loose = re.sub(
        r"uniform = (0\.\d+)", lambda m: f"uniform = {float(m[1]) * 9}", own.read_text()
    )
    own.write_text(re.sub(r"(?m)^reason = .*\n?", "", loose))
    code, out, err = gate(other, "--tighten")
    assert code == 0 and "tightened sin float" in out, err
    assert own.read_text() != loose
    assert (other / "budgets/float.toml").read_bytes() == before


def test_digests_are_asked_for_where_they_were_taken(other):
    """Another platform without budgets of its own computes otherwise; one with budgets has its own digests."""
    where = {"records": "scene", "budgets": "budgets/scenes/run"}
    base = other / "budgets/scenes/run/pendulum3.toml"
    text = base.read_text()
    changed = re.sub(r'digest = ".*"', 'digest = "0123456789abcdef"', text)
    assert changed != text
    base.write_text(changed)
    assert gate(other, "--platform", "base", **where)[0] == 1
    code, out, err = gate(other, **where)
    assert code == 0 and "no budgets of" in err, out
    assert gate(other, "--update", "--platform", "auto", **where)[0] == 0
    own = other / "budgets/platforms/glibc-2.99_boost-1.99/scenes/run/pendulum3.toml"
    digest = re.search('digest = ".*"', text)[0]
    assert digest in own.read_text()
    assert gate(other, **where)[0] == 0
    own.write_text(own.read_text().replace(digest, 'digest = "0123456789abcdef"'))
    code, out, _ = gate(other, **where)
    assert code == 1 and "OTHER RESULTS" in out


def test_first_budgets_of_many_directories_need_no_reason(other):
    """The first directory makes the platform; those after it in the same command are of a first run as well."""
    tighten(other / "budgets/float.toml")
    scene = other / "budgets/scenes/run/pendulum3.toml"
    digest = 'digest = "0123456789abcdef"'
    scene.write_text(re.sub('digest = ".*"', digest, scene.read_text()))
    words = [
        *("gate", other / "math", "--budgets", other / "budgets"),
        *(other / "scene", "--budgets", other / "budgets/scenes/run"),
    ]
    code, out, err = run(*words, "--update", "--platform", "auto")
    assert code == 0, out + err
    assert "of the platform sin float" in out and "pendulum3" in out
    assert run(*words)[0] == 0
    # From then on the platform is known.
    own = other / "budgets/platforms/glibc-2.99_boost-1.99"
    for file in (own / "float.toml", own / "scenes/run/pendulum3.toml"):
        assert 'reason = "as measured with' in file.read_text()
    (own / "scenes/run/pendulum3.toml").unlink()
    code, out, err = run(*words, "--update", "--platform", "auto")
    assert code == 1 and "WOULD LOOSEN pendulum3" in out
