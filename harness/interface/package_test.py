"""Tests of the installed package: projects that find it, what they build, what passes and what fails, and what errors say."""
import os
import pathlib
import shutil
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "kernels/examples"
BUILD = os.environ.get("ULPGATE_BUILD")
if BUILD is None:
    pytest.skip("ULPGATE_BUILD names no build", allow_module_level=True)


def run(*words, cwd=None):
    done = subprocess.run(
        list(map(str, words)), capture_output=True, text=True, cwd=cwd
    )
    return done.returncode, done.stdout + done.stderr


@pytest.fixture(scope="session")
def prefix(tmp_path_factory):
    """What is installed, and nothing else of the source tree."""
    there = tmp_path_factory.mktemp("prefix")
    code, text = run(
        "cmake", "--install", BUILD, "--component", "interface", "--prefix", there
    )
    assert code == 0, text
    return there


def configured(source, build, *more):
    return run("cmake", "-S", source, "-B", build, "-G", "Ninja", *more)


def built(source, build, prefix):
    code, text = configured(source, build, f"-DCMAKE_PREFIX_PATH={prefix}")
    assert code == 0, text
    code, text = run("cmake", "--build", build)
    assert code == 0, text
    return build


@pytest.fixture(scope="session")
def examples(prefix, tmp_path_factory):
    folder = tmp_path_factory.mktemp("examples")
    shutil.copytree(EXAMPLES, folder / "source")
    return built(folder / "source", folder / "build", prefix)


def test_the_examples_pass_and_fail_as_they_should(examples):
    code, text = run("ctest", "--test-dir", examples)
    assert code != 0
    verdicts = {
        line.split()[3]: "Passed" in line
        for line in text.splitlines()
        if "Test #" in line
    }
    assert verdicts == {
        "length": True,
        "versine": False,
        "compensated-1": True,
        "compensated-2": True,
        # -ffast-math takes what the compensation is.
        "compensated-3": False,
        "rotation": True,
    }, text
    code, text = run("ctest", "--test-dir", examples, "-L", "accuracy", "-N")
    assert "Total Tests: 6" in text


def test_a_failure_says_how_to_see_it_again(examples):
    program = examples / "versine_accuracy"
    code, text = run(program, "--max-ulp", "4")
    assert code == 1 and "FAILED: versine double" in text
    command = next(line for line in text.splitlines() if "--at" in line).split()
    words = [w.strip("'") for w in command]
    code, text = run(*words)
    assert (
        code == 0
        and "ULP error" in text
        and "exact value" in text
        and "condition number" in text
    )


def test_runs_are_repeatable_and_recorded(examples, tmp_path):
    program = examples / "length_accuracy"
    for name in ("a", "b"):
        assert run(program, "--max-ulp", "2", "--records", tmp_path / name)[0] == 0
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()
    assert run(program, "--seed", "2", "--records", tmp_path / "c")[0] == 0
    assert (tmp_path / "a").read_bytes() != (tmp_path / "c").read_bytes()
    # Squares of small numbers underflow, which the default ranges do not reach.
    code, text = run(program, "--max-ulp", "2", "--extremes")
    assert code == 1 and "underflow_spurious" in text


def test_budgets(examples, tmp_path):
    program = examples / "rotation_accuracy"
    budget = tmp_path / "budget.toml"
    code, text = run(program, "--budget", budget, "--update")
    assert code == 0, text
    assert run(program, "--budget", budget)[0] == 0
    budget.write_text("[max_ulp]\n" + "\n".join(budget.read_text().splitlines()[3:]))
    code, text = run(program, "--budget", budget)
    assert code == 1 and "no row for 'rotated float part 1'" in text
    budget.write_text('[max_ulp]\n"rotated float part 1" = -1\n')
    code, text = run(program, "--budget", budget)
    assert code == 2 and f"{budget}:2" in text
    assert run(program, "--budget", tmp_path / "none.toml")[0] == 2
    assert (
        run(program, "--max-ulp", "4", "--records", tmp_path / "no/such/file")[0] == 4
    )


@pytest.mark.parametrize(
    "words, said",
    [
        (["--kernel", "none"], "no kernel"),
        (["--at", "1"], "3 arguments"),
        (["--at", "1", "2", "x"], "'x' is no number"),
        (["--sample"], "sample"),
    ],
)
def test_bad_usage(examples, words, said):
    code, text = run(examples / "rotation_accuracy", *words)
    assert code == 2 and said in text


FOUR_LINES = """cmake_minimum_required(VERSION 3.20)
project(mine CXX)
find_package(ulpgate REQUIRED)
ulpgate_add_accuracy_test(length HEADER kernels.hpp KERNEL length ARGUMENTS x y MAX_ULP 2)
"""


def project(folder, lines, kernels):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "CMakeLists.txt").write_text(lines)
    (folder / "kernels.hpp").write_text(kernels)
    return folder


LENGTH = "#include <cmath>\ntemplate <class Real>\nReal length(Real x, Real y) { using std::sqrt; return sqrt(x * x + y * y); }\n"


def test_four_lines_are_a_project(prefix, tmp_path):
    build = built(
        project(tmp_path / "mine", FOUR_LINES, LENGTH), tmp_path / "build", prefix
    )
    assert run("ctest", "--test-dir", build)[0] == 0


@pytest.mark.parametrize(
    "body, said",
    [
        ("return std::sqrt(x * x + y * y);", "using std::sqrt"),
        ("double r = x * x; return r + y;", "Write Real instead of double"),
        ("return std::max(x, 0.0) + y;", "max(x, Real(0.0))"),
    ],
)
def test_a_kernel_that_is_no_template_of_numbers_is_told_the_remedy(
    prefix, tmp_path, body, said
):
    kernels = (
        "#include <algorithm>\n#include <cmath>\ntemplate <class Real>\nReal length(Real x, Real y) { %s }\n"
        % body
    )
    source = project(tmp_path / "mine", FOUR_LINES, kernels)
    assert (
        configured(source, tmp_path / "build", f"-DCMAKE_PREFIX_PATH={prefix}")[0] == 0
    )
    code, text = run("cmake", "--build", tmp_path / "build")
    assert code != 0 and said in text


@pytest.mark.parametrize(
    "line, said",
    [
        (
            "ulpgate_add_accuracy_test(a HEADER none.hpp KERNEL length ARGUMENTS x y)",
            "none.hpp",
        ),
        (
            "ulpgate_add_accuracy_test(a HEADER kernels.hpp KERNEL length)",
            "ARGUMENTS is missing",
        ),
        (
            "ulpgate_add_accuracy_test(a HEADER kernels.hpp KERNEL length ARGUMENTS x y RANGE z 0 1)",
            "RANGE wants",
        ),
    ],
)
def test_a_wrong_call_stops_the_configuration(prefix, tmp_path, line, said):
    source = project(
        tmp_path / "mine", "\n".join([*FOUR_LINES.splitlines()[:3], line, ""]), LENGTH
    )
    code, text = configured(source, tmp_path / "build", f"-DCMAKE_PREFIX_PATH={prefix}")
    assert code != 0 and said in text


def test_the_same_by_fetchcontent(tmp_path):
    lines = FOUR_LINES.replace("3.20", "3.25").replace(
        "find_package(ulpgate REQUIRED)",
        f"include(FetchContent)\nFetchContent_Declare(ulpgate SOURCE_DIR {ROOT})\nFetchContent_MakeAvailable(ulpgate)",
    )
    build = tmp_path / "build"
    # Without a build type, as a project of so few lines has none.
    code, text = configured(project(tmp_path / "mine", lines, LENGTH), build)
    assert code == 0, text
    code, text = run("cmake", "--build", build)
    assert code == 0, text
    assert run("ctest", "--test-dir", build)[0] == 0


def test_a_package_of_debian(tmp_path):
    for program in ("cpack", "dpkg-deb", "dpkg-shlibdeps"):
        if shutil.which(program) is None:
            pytest.skip(f"no {program}")
    code, text = run("cpack", "--config", f"{BUILD}/CPackConfig.cmake", "-B", tmp_path)
    assert code == 0, text
    (package,) = tmp_path.glob("*.deb")
    code, depends = run("dpkg-deb", "-f", package, "Depends")
    assert "libmpfr6" in depends and "libc6" in depends
    # Unpacked beside the system, as its own rules have it.
    root = tmp_path / "root"
    assert run("dpkg-deb", "-x", package, root)[0] == 0
    ulpgate = root / "usr/bin/ulpgate"
    for file in ("man/man1/ulpgate-math.1", "bash-completion/completions/ulpgate"):
        assert (root / "usr/share" / file).is_file(), file
    words = ["at", "exp", "double", "1", "--library", "libm.so.6", "--symbol", "exp"]
    code, text = run(ulpgate, *words, cwd=tmp_path)
    assert code == 0 and "libm.so.6 exp" in text, text
    measuring = ["--functions", "exp", "--types", "double", "--samples", "100"]
    code, text = run(ulpgate, "math", *measuring, "--out", tmp_path / "run")
    assert code == 0, text
    code, text = run(ulpgate, "report", tmp_path / "run", "--out", tmp_path / "page")
    assert code == 0 and (tmp_path / "page/index.html").exists(), text
    mine = project(tmp_path / "mine", FOUR_LINES, LENGTH)
    build = built(mine, tmp_path / "build", root / "usr")
    assert run("ctest", "--test-dir", build)[0] == 0


MATCHED = """
#include <cmath>
TEST_OF(good) {
  HOLDS(std::sin(1.0), ulpgate::call("sin", 1.0), 0.6);
  HOLDS(0.1 + 0.2, 0.3, 2);
  HOLDS(std::pow(2.5f, 3.5f), ulpgate::call("pow", 2.5f, 3.5f), 1);
}
TEST_OF(bad) { HOLDS(std::sin(1.0) * 1.0000001, ulpgate::call("sin", 1.0), 1); }
"""
GOOGLE = """#include <ulpgate/gtest.hpp>
#define TEST_OF(name) TEST(Ulp, name)
#define HOLDS(got, exact, limit) EXPECT_ULP_LE(got, exact, limit)
"""
CATCH = """#define CATCH_CONFIG_MAIN
#include <ulpgate/catch2.hpp>
#define TEST_OF(name) TEST_CASE(#name)
#define HOLDS(got, exact, limit) CHECK_THAT(got, ulpgate::WithinUlp(exact, limit))
"""


@pytest.mark.parametrize(
    "name, head, libraries",
    [("gtest", GOOGLE, ["-lgtest_main", "-lgtest"]), ("catch2", CATCH, [])],
)
def test_matchers(prefix, tmp_path, name, head, libraries):
    if (
        name == "catch2"
        and run(
            "cc",
            "-x",
            "c++",
            "-fsyntax-only",
            "-include",
            "catch2/catch.hpp",
            "/dev/null",
        )[0]
        != 0
    ):
        pytest.skip("no Catch2 2 (Debian 12: catch2)")
    matched = MATCHED.replace("0.1 + 0.2, 0.3, 2", "0.1 + 0.2, 0.3, 2.0")
    (tmp_path / "a.cpp").write_text(head + matched)
    library = next(prefix.rglob("libulpgate.so")).parent
    words = [
        "c++",
        "-std=c++17",
        tmp_path / "a.cpp",
        f"-I{prefix}/include",
        f"-L{library}",
        f"-Wl,-rpath,{library}",
    ]
    code, text = run(*words, "-lulpgate", *libraries, "-pthread", "-o", tmp_path / "a")
    assert code == 0, text
    code, text = run(tmp_path / "a")
    assert code != 0
    for said in (
        "ULP (limit 1)",
        "sin(0x1p+0)",
        "condition number",
        "0x1.aed548f090ceep-1",
        "8.41470984807896506",
    ):
        assert said in text
    assert "pow" not in text and "0.3" not in text.replace("0.33", "")
