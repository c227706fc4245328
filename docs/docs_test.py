"""Every command that is printed on a page of docs/ or in the README is run, and gives the output that stands below it."""

import os
import pathlib
import platform
import re
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "harness/app/testing"))

from smaller import smaller  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
PAGES = [ROOT / "README.md", *sorted(HERE.rglob("*.md"))]
PAGES = [p for p in PAGES if "generated" not in p.parts and p != HERE / "README.md"]
PROGRAM = pathlib.Path(os.environ["ULPGATE"]).resolve()

# The numbers on the pages are those of this C library, in its variants for processors with fused multiply-add.
# Elsewhere commands are run all the same, and what they print is not compared.
FMA = " fma " in pathlib.Path("/proc/cpuinfo").read_text()
SAME_NUMBERS = platform.libc_ver() == ("glibc", "2.36") and FMA

FENCE = re.compile(
    r"(?:^(?:% |<!-- )run by (?P<by>[^\n]*?)(?: -->)?\n)?"
    r"^```(?P<kind>\{code-block\} \w+|\w*)\n(?P<body>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)


def blocks_of(page):
    for found in FENCE.finditer(page.read_text()):
        yield found["kind"], found["body"], found["by"]


def commands_of(body):
    """Commands of a console block: (command, exit code, lines of output)."""
    commands = []
    for line in body.splitlines():
        if line.startswith("$ "):
            command, _, code = line[2:].partition("   # exit ")
            commands.append((command, int(code or 0), []))
        else:
            commands[-1][2].append(line)
    return commands


def pattern_of(lines):
    """The output that these lines stand for."""
    pattern = ""
    for line in lines:
        if line == "...":
            pattern += r"(?:.*\n)*?"
        else:
            words = [re.escape(part.rstrip()) for part in line.split("...")]
            pattern += r"[^\n]*?".join(words) + r"[^\n\S]*\n"
    return re.compile(pattern)


def run_in(folder, command):
    paths = [str(PROGRAM.parent), os.environ["PATH"]]
    return subprocess.run(
        ["bash", "-c", command],
        cwd=folder,
        capture_output=True,
        text=True,
        env=os.environ | {"PATH": ":".join(paths), "COLUMNS": "80"},
    )


def page_name(page):
    return str(page.relative_to(ROOT))


@pytest.fixture
def folder(tmp_path):
    """A checkout with nothing in it but what commands name by its place in the project."""
    for name in ("ci", "scripts", "kernels", "harness"):
        (tmp_path / name).symlink_to(ROOT / name)
    git = ["git", "-c", "user.name=reader", "-c", "user.email=reader@localhost"]
    subprocess.run([*git, "init", "--quiet"], cwd=tmp_path, check=True)
    commit = [*git, "commit", "--quiet", "--allow-empty", "--message", "mine"]
    subprocess.run(commit, cwd=tmp_path, check=True)
    return tmp_path


@pytest.mark.parametrize("page", PAGES, ids=page_name)
def test_commands_of_a_page(page, folder):
    for kind, body, by in blocks_of(page):
        if kind.startswith("{code-block}"):
            caption = re.match(r":caption: (.+)\n\n?", body)
            if caption:
                (folder / caption[1]).write_text(body[caption.end() :])
        elif kind == "console" and by is None:
            for command, code, lines in commands_of(body):
                done = run_in(folder, command)
                said = done.stdout + done.stderr
                assert done.returncode == code, f"{command}\n{said}"
                if not SAME_NUMBERS:
                    continue
                # What goes to stdout and what to stderr, a reader does not see; which comes first is not told.
                wanted = pattern_of(lines)
                streams = (
                    done.stdout,
                    done.stderr + done.stdout,
                    done.stdout + done.stderr,
                )
                assert any(
                    wanted.fullmatch(text) for text in streams
                ), f"{command}\nis said to print\n{body}\nand prints\n{said}"
        elif kind == "sh" and by is None:
            for line in body.splitlines():
                command = line.partition("  #")[0].strip()
                if command:
                    done = run_in(folder, smaller(command))
                    # Where a library is wrong a search says so.
                    codes = (0, 1) if "ulpgate search" in command else (0,)
                    assert done.returncode in codes, f"{command}\n{done.stderr}"


@pytest.mark.parametrize("page", PAGES, ids=page_name)
def test_what_another_test_runs_is_there(page):
    for _, body, by in blocks_of(page):
        if by is None or by.startswith("hand: "):
            continue
        file = (ROOT / by.split(":")[0]).resolve()
        text = file.read_text()
        for line in body.splitlines():
            words = line.partition("  #")[0].split()
            if words:
                # Of the program itself the verb, as a word of a list of options.
                name = pathlib.Path(words[0]).name
                if name == "ulpgate":
                    name = f'"{words[1]}"'
                assert name in text, f"{file} runs no {name}"


@pytest.mark.parametrize("page", PAGES, ids=page_name)
def test_a_block_of_commands_says_what_it_is(page):
    """A fence without a kind would hide its commands from this test."""
    for kind, body, _ in blocks_of(page):
        first = body.split()[0] if body.split() else ""
        hidden = kind == "" and re.match(
            r"(\$|ulpgate|scripts/|ci/|cmake|mpirun)", first
        )
        assert not hidden, f"{page}: a block that begins with '{first}' has no kind"


@pytest.mark.parametrize("page", PAGES, ids=page_name)
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)#\s]+)", page.read_text()):
        if "://" not in target:
            assert (page.parent / target).exists(), f"{page_name(page)}: {target}"


def test_the_pages_are_made_without_a_warning(tmp_path):
    python = os.environ.get("ULPGATE_DEBIAN_PYTHON", "/usr/bin/python3")
    wanted = "import sphinx, furo, myst_parser, breathe, sphinx_copybutton"
    if subprocess.run([python, "-c", wanted], capture_output=True).returncode != 0:
        pytest.skip("no Sphinx here: scripts/setup --docs installs it")
    out = tmp_path / "pages"
    done = subprocess.run(
        [ROOT / "scripts/docs", out], capture_output=True, text=True, env=os.environ
    )
    assert done.returncode == 0, done.stderr
    # A search without a server, and what was taken from the code.
    assert "Search.setIndex" in (out / "searchindex.js").read_text()
    for page, text in (
        ("reference/command_line", "--samples"),
        ("reference/c_and_cpp", "ulpgate_exact"),
        ("reference/python", "assert_max_ulp"),
    ):
        assert text in (out / f"{page}.html").read_text(), page
    # Nothing on a page comes over the network.
    for page in out.rglob("*.html"):
        for address in re.findall(r'(?:src|href)="(https?://[^"]+)"', page.read_text()):
            assert not re.search(r"\.(js|css|woff2?|png|svg)$", address), address
