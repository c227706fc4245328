"""Tests of man pages and completions: every verb and option is there, and a shell completes what a user begins."""

import os
import pathlib
import shutil
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import help_tree
import make_manual
import man_pages

ROOT = pathlib.Path(__file__).resolve().parents[3]
ULPGATE = os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))


@pytest.fixture(scope="module")
def share(tmp_path_factory):
    """All files of this program."""
    place = tmp_path_factory.mktemp("share")
    assert make_manual.main([ULPGATE, str(place)]) == 0
    return place


@pytest.fixture(scope="module")
def tree():
    """What its help says."""
    return help_tree.read(ULPGATE)


def test_the_help_is_read_whole(tree):
    assert ("scene", "run") in tree and ("math",) in tree
    options = {name: o for o in tree[("math",)].options for name in o.names}
    assert options["--timing"].choices == ("auto", "on", "off", "repeats")
    assert options["--samples"].valued and not options["--resume"].valued
    assert tree[("list",)].positionals[0].choices[0] == "functions"
    assert "hexfloat" in tree[("at",)].notes


def test_every_verb_has_a_page_with_all_its_options(share, tree):
    for words, verb in tree.items():
        text = (share / f"man/man1/{man_pages.name_of(words)}.1").read_text()
        for option in verb.options:
            for name in option.names:
                assert man_pages.escaped(name) in text, (words, name)


@pytest.mark.skipif(shutil.which("groff") is None, reason="no groff")
def test_troff_has_nothing_to_say(share):
    for page in sorted((share / "man/man1").iterdir()):
        words = ["groff", "-man", "-Tutf8", "-ww", str(page)]
        done = subprocess.run(words, capture_output=True, text=True)
        assert done.returncode == 0 and not done.stderr, done.stderr[:500]


# What is typed, ending with the word that is completed; what must be offered, and what must not.
TYPED = [
    ("ulpgate ma", {"math"}, {"merge"}),
    ("ulpgate scene co", {"compare", "correlate"}, {"run"}),
    ("ulpgate math --ty", {"--types"}, {"--samples"}),
    ("ulpgate math --types flo", {"float", "float128"}, {"double"}),
    ("ulpgate math --types float,dou", {"float,double"}, {"double"}),
    ("ulpgate math --timing rep", {"repeats"}, {"auto"}),
    ("ulpgate at tga", {"tgamma"}, {"math"}),
    ("ulpgate at sphere_s", {"sphere_sphere"}, set()),
    ("ulpgate at tgamma dou", {"double"}, {"float"}),
    ("ulpgate at --library libm.so.6 tga", {"tgamma"}, set()),
    ("ulpgate scene run pen", {"pendulum3"}, {"deposition"}),
    ("ulpgate list func", {"functions"}, {"types"}),
    ("ulpgate gate --budgets x --js", {"--json"}, {"--junit"}),
]


@pytest.mark.parametrize("typed, offered, not_offered", TYPED)
def test_bash_completes(share, typed, offered, not_offered):
    words = typed.split(" ")
    script = f"""source {share}/bash-completion/completions/ulpgate
COMP_WORDS=({' '.join(words)}); COMP_CWORD={len(words) - 1}
_ulpgate; printf '%s\\n' "${{COMPREPLY[@]}}"
"""
    done = subprocess.run(["bash", "-c", script], capture_output=True, text=True)
    found = set(done.stdout.split())
    assert not done.stderr
    assert offered <= found and not found & not_offered, found


@pytest.mark.skipif(shutil.which("zsh") is None, reason="no zsh")
def test_zsh_reads_its_file(share):
    file = share / "zsh/site-functions/_ulpgate"
    subprocess.run(["zsh", "-n", file], check=True)


@pytest.mark.skipif(shutil.which("fish") is None, reason="no fish")
def test_fish_completes(share):
    file = share / "fish/vendor_completions.d/ulpgate.fish"
    for typed, offered, not_offered in TYPED:
        if "," in typed or typed.startswith("ulpgate at tgamma"):
            continue  # fish completes whole words, and first arguments alone here
        words = ["fish", "-c", f"source {file}; complete -C '{typed}'"]
        done = subprocess.run(words, capture_output=True, text=True, check=True)
        found = {line.split("\t")[0] for line in done.stdout.splitlines()}
        assert offered <= found, (typed, found)


@pytest.mark.parametrize("words", [[], ["a"], ["a", "b", "c"]])
def test_bad_usage(words, capsys):
    assert make_manual.main(words) == 2
    assert "PROGRAM SHARE" in capsys.readouterr().err


def test_a_program_that_does_not_run_is_named(tmp_path, capsys):
    assert make_manual.main(["/nowhere/ulpgate", str(tmp_path)]) == 4
    assert "/nowhere/ulpgate" in capsys.readouterr().err
