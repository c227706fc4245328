"""Sphinx: the pages of docs/, the command line as the program prints it, and headers and module as they document themselves."""

import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
GENERATED = pathlib.Path(__file__).resolve().parent / "generated"

project = "ulpgate"
author = "the developers of ulpgate"
copyright = author
version = release = re.search(
    r"project\(ulpgate VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()
)[1]

extensions = ["myst_parser", "sphinx.ext.autodoc", "breathe", "sphinx_copybutton"]
exclude_patterns = ["generated", "README.md"]
myst_heading_anchors = 3
html_theme = "furo"
html_title = "ulpgate"
html_copy_source = False
html_show_sphinx = False
# A prompt is no part of a command.
copybutton_prompt_text = "$ "
sys.path.insert(0, str(ROOT / "harness/interface/python"))
os.environ.setdefault(
    "ULPGATE_LIBRARY", str(ROOT / "build/release/harness/interface/libulpgate.so")
)
autodoc_typehints = "description"

breathe_projects = {"ulpgate": str(GENERATED / "doxygen/xml")}
breathe_default_project = "ulpgate"
breathe_domain_by_extension = {"h": "c", "hpp": "cpp"}

DOXYFILE = """
INPUT = {include}
FILE_PATTERNS = *.h *.hpp
GENERATE_XML = YES
GENERATE_HTML = NO
GENERATE_LATEX = NO
QUIET = YES
WARNINGS = NO
JAVADOC_AUTOBRIEF = NO
EXTRACT_ALL = YES
EXCLUDE_SYMBOLS = ulpgate::detail ulpgate::Parts Catch
ENABLE_PREPROCESSING = YES
MACRO_EXPANSION = YES
EXPAND_ONLY_PREDEF = YES
PREDEFINED = ULPGATE_API= __cplusplus=202002L
OUTPUT_DIRECTORY = {output}
INPUT_FILTER = "sed -E 's,^( *)/\\* ,\\1/** ,; s,^( *)// ,\\1/// ,'"
"""


def write_headers():
    """The XML that Doxygen makes of the headers; their comments become Doxygen's on the way."""
    out = GENERATED / "doxygen"
    out.mkdir(parents=True, exist_ok=True)
    include = ROOT / "harness/interface/include/ulpgate"
    file = out / "Doxyfile"
    file.write_text(DOXYFILE.format(include=include, output=out))
    subprocess.run(["doxygen", file], check=True, cwd=out)


def help_of(program, *words):
    done = subprocess.run([program, *words, "--help"], capture_output=True, text=True)
    return done.stdout.rstrip()


def subcommands(text):
    """Names that a help lists below "Subcommands:"."""
    _, _, listed = text.partition("Subcommands:\n")
    return re.findall(r"^  ([a-z-]+) +\S", listed, flags=re.M)


def write_command_line(program):
    GENERATED.mkdir(exist_ok=True)
    page = GENERATED / "command_line.md"
    if not os.access(program, os.X_OK):
        page.write_text(
            f"These pages were made without the program: there is no `{program}`.\n"
        )
        return
    text = help_of(program)
    parts = [f"```text\n{text}\n```\n"]
    for verb in subcommands(text):
        text = help_of(program, verb)
        parts.append(f"## ulpgate {verb}\n\n```text\n{text}\n```\n")
        for word in subcommands(text):
            text_of_word = help_of(program, verb, word)
            parts.append(f"### ulpgate {verb} {word}\n\n```text\n{text_of_word}\n```\n")
    page.write_text("\n".join(parts))


def setup(app):
    write_headers()
    write_command_line(
        os.environ.get("ULPGATE", str(ROOT / "build/release/harness/app/ulpgate"))
    )
