"""Tests of the mutation run: which mutants a source has, and what becomes of those of a small project."""

import json
import pathlib
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import mutate  # noqa: E402
import operators  # noqa: E402
import weave  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent


def changes(text: str) -> set[tuple[str, str]]:
    return {(m.before, m.after) for m in operators.find_mutants("a.cpp", text)}


CASES = [
    ("if (a < b) f();", {"if (a <= b) f();", "if (a > b) f();"}),
    ("if (a && !b) f();", {"if (a || !b) f();", "if (a && b) f();"}),
    ("x = a - b * c;", {"x = a + b * c;", "x = a - b / c;"}),
    ("x = -a;", {"x = a;"}),
    ("return true;", {"return false;"}),
    ("++i;", {"--i;"}),
    ("x += 7U;", {"x -= 7U;", "x += 8U;"}),
    ("x = 1'000L;", {"x = 1001L;"}),
    ("x = 0x1p-53;", {"x = (2 * 0x1p-53);"}),
    ("x = 1.5;", {"x = (1.5 + 1);"}),
    ("  reset(x);", {";"}),
    ("  a.reset(x);  // all", {";"}),
]


@pytest.mark.parametrize("text, after", CASES)
def test_every_operator_has_its_mutants(text, after):
    assert {a for _, a in changes(text)} == after


@pytest.mark.parametrize(
    "text",
    [
        "// a < b && true",
        "/* 1\n2 */",
        '#include "a/b.hpp"',
        "#define A 1",
        'x = "a < 1 && \\" 2";',
        'x = R"(1 < 2)";',
        "x = 'a';",
        "static_assert(sizeof(int) == 4);",
        "template <int n, class T>\nvoid f(std::vector<T>& a, T&& b, T* c);",
        "virtual int f() const = 0;",
        "x = y1 ? p->q : v2;",
        "Value& operator=(Value&& other);",
    ],
)
def test_what_is_no_expression_that_runs_has_none(text):
    assert changes(text) == set()


def test_a_mutant_keeps_its_name_when_lines_come_before_it():
    text = "int f() {\n  return 3;\n}\nint g() {\n  return 3;\n}\n"
    here = operators.find_mutants("a.cpp", text)
    moved = operators.find_mutants("a.cpp", "// a\n\n" + text)
    assert [m.key for m in here] == [m.key for m in moved]
    assert len({m.key for m in here}) == 2, "equal lines are told apart"
    assert [m.line for m in moved] == [m.line + 2 for m in here]


TOY = """// A toy.
int larger(int a, int b) {
  return a > b ? a : b;
}
int unread() {
  return 5;
}
int sum(int n) {
  int s = 0;
  for (int i = 1; i <= n; ++i) s += i;
  return s;
}
"""
TOY_TEST = """#include "toy.cpp"
int main() { return larger(1, 2) == 2 && larger(5, 3) == 5 && sum(4) == 10 && unread() > 0 ? 0 : 1; }
"""
PLAN = """rooms = ["room"]
endings = [".cpp"]
left_out = ["*_test.cpp"]
configure = ["mkdir", "-p", "{build}"]
build = ["sh", "-c", "g++ -O2 -w {flags} -o {build}/{target} {tree}/room/toy_test.cpp {link}"]
keep_going = []
build_limit = 20
[[tests]]
name = "toy"
target = "toy_test"
program = "{build}/toy_test"
arguments = []
limit = 1
"""


@pytest.fixture(name="toy")
def toy_project(tmp_path):
    checkout = tmp_path / "checkout"
    (checkout / "room").mkdir(parents=True)
    (checkout / "room/toy.cpp").write_text(TOY)
    (checkout / "room/toy_test.cpp").write_text(TOY_TEST)
    (tmp_path / "plan.toml").write_text(PLAN)
    subprocess.run(["git", "init", "-q", checkout], check=True)
    return tmp_path


def run(toy: pathlib.Path, *extra: str) -> subprocess.CompletedProcess:
    command = [
        sys.executable,
        HERE / "mutate.py",
        "--checkout",
        toy / "checkout",
        "--plan",
        toy / "plan.toml",
    ]
    command += [
        "--accepted",
        toy / "accepted.toml",
        "--work",
        toy / "work",
        "--sample",
        "100",
        *extra,
    ]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def entries(toy: pathlib.Path) -> dict[str, dict]:
    return {e["after"]: e for e in mutate.read_log(toy / "work/log.jsonl").values()}


def test_a_toy_project_from_survivors_to_accepted_ones(toy):
    first = run(toy)
    assert first.returncode == 1, first.stderr
    found = entries(toy)
    assert found["return a < b ? a : b;"]["outcome"] == "killed"
    assert found["int s = 1;"]["outcome"] == "killed"
    assert (
        found["for (int i = 1; i <= n; --i) s += i;"]["outcome"] == "killed"
    ), "an endless loop"
    assert found["return 6;"]["outcome"] in {"survived", "same_code"}
    assert found["return a >= b ? a : b;"]["outcome"] in {"survived", "same_code"}
    assert (toy / "checkout/room/toy.cpp").read_text() == TOY
    assert {e["way"] for e in found.values()} == {"together"}
    open_ones = [e for e in found.values() if e["outcome"] == "survived"]
    assert f"{len(open_ones)} not" in first.stdout

    again = run(toy)
    assert again.returncode == 1 and again.stderr == "", "nothing is tried twice"
    accepted = "".join(
        "[[accepted]]\n"
        + "".join(f"{k} = {json.dumps(e[k])}\n" for k in ("file", "before", "after"))
        + 'reason = "nobody reads it"\n'
        for e in open_ones
    )
    (toy / "accepted.toml").write_text(accepted)
    last = run(toy, "--report")
    assert last.returncode == 0 and ", 0 not" in last.stdout, last.stdout


def test_an_interrupted_log_goes_on(toy):
    assert run(toy, "--sample", "2").returncode in {0, 1}
    log = toy / "work/log.jsonl"
    lines = log.read_text().splitlines()
    assert len(lines) == 2
    log.write_text(lines[0] + "\n" + lines[1][:20])
    assert run(toy, "--sample", "2").returncode in {0, 1}
    assert len(mutate.read_log(log)) == 2


def test_together_and_alone_mutants_end_alike(toy):
    run(toy)
    together = {k: e["outcome"] for k, e in entries(toy).items()}
    (toy / "work/log.jsonl").unlink()
    run(toy, "--alone")
    assert (toy / "work/0/tree/room/toy.cpp").read_text() == TOY
    alone = {k: e["outcome"] for k, e in entries(toy).items()}
    assert {k: v.replace("same_code", "survived") for k, v in alone.items()} == together


@pytest.mark.parametrize(
    "text, woven",
    [
        ("int f(int a) { return a + 1; }", "return ({on} ? (a - 1) : (a + 1));"),
        ("void f() { if (a < b) g(); }", "if (({on} ? (a <= b) : (a < b))) g();"),
        ("void f() { for (;;) x += 1; }", "for (;;) ({on} ? (x -= 1) : (x += 1));"),
        ("void f() { a = {1, b}; }", "a = {({on} ? (2) : (1)), b};"),
        ("void f() {\n  g();  // all\n}", "  { if (!{on}) { g(); } }  // all"),
        ("constexpr int a = 3;", "const int a = ({on} ? (4) : (3));"),
        (
            "void f() { x = [&] { return 2; }() + y; }",
            "{ return ({on} ? (3) : (2)); }()",
        ),
    ],
)
def test_a_mutant_stands_behind_its_switch(text, woven):
    mutant = operators.find_mutants("a.cpp", text)[0]
    found = weave.weave(text, weave.place(text, [(7, mutant)]))
    assert woven.replace("{on}", "ulpgate_mutation::on(7)") in found


def test_mutants_inside_one_another_are_all_woven_and_lines_stay():
    text = "int f(int a) {\n  return g(a + 1,  // one\n           2) - 3;\n}\n"
    mutants = list(enumerate(operators.find_mutants("a.cpp", text), start=1))
    woven = weave.weave(text, weave.place(text, mutants))
    assert all(woven.count(f"on({n})") == 1 for n, _ in mutants)
    assert woven.count("\n") == text.count("\n")


CONSTANT = """template <int n> int size() { return n; }
constexpr int twice(int n) { return n * 2; }
int f() { return size<twice(4)>() + twice(2); }
int g() { constexpr int n = 3; int a[n]; return sizeof a; }
"""


def test_what_cannot_wait_for_a_switch_is_built_on_its_own(toy):
    (toy / "checkout/room/toy.cpp").write_text(CONSTANT)
    test = '#include "toy.cpp"\nint main() { return f() == 12 && g() == 12 ? 0 : 1; }\n'
    (toy / "checkout/room/toy_test.cpp").write_text(test)
    result = run(toy)
    assert result.returncode == 0, result.stdout + result.stderr
    found = entries(toy)
    ways = {k: e.get("way", "alone") for k, e in found.items()}
    assert {e["outcome"] for e in found.values()} == {"killed"}, result.stderr
    assert set(ways.values()) == {"together", "alone"}, ways


def test_tests_that_fail_without_a_mutant_are_said(toy):
    test = toy / "checkout/room/toy_test.cpp"
    test.write_text(TOY_TEST.replace("== 10", "== 11"))
    result = run(toy)
    assert result.returncode == 4
    assert "toy fails without a mutant" in result.stderr


def test_an_accepted_mutant_needs_a_reason(tmp_path):
    file = tmp_path / "accepted.toml"
    file.write_text(
        '[[accepted]]\nfile = "a"\nbefore = "b"\nafter = "c"\nreason = " "\n'
    )
    with pytest.raises(ValueError, match="no reason"):
        mutate.read_accepted(file)


def test_the_plan_and_the_accepted_ones_of_the_project():
    plan = mutate.read_plan(HERE / "plan.toml")
    files = mutate.sources(plan, HERE.parents[1], plan.rooms, [])
    assert "reference/types/rounding.cpp" in files
    assert not [f for f in files if f.endswith("_test.cpp")]
    for entry in mutate.read_accepted(HERE / "accepted.toml"):
        assert (HERE.parents[1] / entry["file"]).is_file(), entry


def test_no_source_is_bad_usage(toy):
    assert run(toy, "--only", "nothing").returncode == 2
