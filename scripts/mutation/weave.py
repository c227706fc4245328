"""Many mutants in one source: each stands beside the original behind a switch that the environment sets.

A mutant changes a chunk: the expression around it up to the nearest bracket, comma, semicolon or assignment.  The chunk E
becomes (on(7) ? (E mutated) : (E)); mutants of one chunk form a chain, and a chunk inside another is woven into its last
branch.  What is not an expression (a constant that a type depends on, a case label) does not compile so: see `Form`.
"""

import enum
import re
from dataclasses import dataclass

from operators import TOKEN, Mutant

OPENING, CLOSING = "([{", ")]}"
# A chunk ends at these on its own level; `:` of a range or a label, `?` and `:` of a choice too.
ENDS = {",", ";", "=", "?", ":", "+=", "-=", "*=", "/=", "%=", "<<=", ">>="}
WORDS_BEFORE = {"return", "throw", "else", "case", "co_return", "do"}


class Form(enum.IntEnum):
    """How a mutant is switched; where a form does not compile, the next one is tried."""

    RUNTIME = 0
    # constexpr before its declaration goes, so that the value can wait for the switch
    NOT_CONSTANT = 1
    # the switch is off in constant expressions, for functions that are also called in them
    OFF_IN_CONSTANTS = 2
    ALONE = 3


SWITCH = {
    Form.RUNTIME: "on",
    Form.NOT_CONSTANT: "on",
    Form.OFF_IN_CONSTANTS: "on_at_run_time",
}

# Included before all else, and so without names of its own or headers.
HEADER = """#pragma once
namespace ulpgate_mutation {
bool on(int n) noexcept;
constexpr bool on_at_run_time(int n) noexcept { return __builtin_is_constant_evaluated() ? false : on(n); }
}  // namespace ulpgate_mutation
"""
# ULPGATE_MUTANT holds the number of the mutant that is on, ULPGATE_MUTANTS_REACHED a file of a byte for each, set where its
# place was come by.
SWITCH_SOURCE = """#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
namespace ulpgate_mutation {
bool on(int n) noexcept;
namespace {
struct Switch {
  int chosen = 0;
  unsigned char* reached = nullptr;
  Switch() {
    if (const char* text = std::getenv("ULPGATE_MUTANT")) chosen = std::atoi(text);
    const char* name = std::getenv("ULPGATE_MUTANTS_REACHED");
    if (!name) return;
    const int file = open(name, O_RDWR);
    void* map = file < 0 ? MAP_FAILED : mmap(nullptr, %d, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (map == MAP_FAILED) std::abort();
    reached = static_cast<unsigned char*>(map);
  }
};
}
bool on(int n) noexcept {
  static const Switch& the_switch = *new Switch;
  if (the_switch.reached) the_switch.reached[n] = 1;
  return the_switch.chosen == n;
}
}
"""


@dataclass
class Woven:
    """One mutant of a file with its number and form, and the chunk it stands in."""

    mutant: Mutant
    number: int
    form: Form = Form.RUNTIME
    start: int = 0
    end: int = 0
    first_line: int = 0
    last_line: int = 0


def code_tokens(text: str) -> list[re.Match]:
    return [m for m in TOKEN.finditer(text) if m.lastgroup != "comment"]


def one_line(text: str) -> str:
    """The text without comments and line ends, for a copy that shifts no line."""
    pieces, last = [], 0
    for m in TOKEN.finditer(text):
        if m.lastgroup == "comment":
            pieces.append(text[last : m.start()] + " ")
            last = m.end()
    return "".join(pieces + [text[last:]]).replace("\n", " ")


def find_chunk(tokens: list[re.Match], mutant: Mutant) -> tuple[int, int]:
    """Start and end of the expression that holds the mutant's place."""
    inside = [i for i, m in enumerate(tokens) if mutant.start <= m.start() < mutant.end]
    first, last = inside[0], inside[-1]
    # An assignment is the whole statement's.
    whole = tokens[first].group() in ENDS
    ends = {",", ";"} if whole else ENDS
    i, depth = first - 1, 0
    while i >= 0:
        text = tokens[i].group()
        if text in CLOSING:
            # the closing brace of a block before a statement, unless it ends an initialiser inside the expression
            if text == "}" and depth == 0 and not _is_value(tokens, i):
                break
            depth += 1
        elif text in OPENING:
            if depth == 0:
                break
            depth -= 1
        elif depth == 0 and (text in ends or text in WORDS_BEFORE):
            break
        elif depth == 0 and tokens[i].lastgroup == "directive":
            break
        i -= 1
    j, depth = last + 1, 0
    while j < len(tokens):
        text = tokens[j].group()
        if text in OPENING:
            depth += 1
        elif text in CLOSING:
            if depth == 0:
                break
            depth -= 1
        elif depth == 0 and text in ends:
            break
        j += 1
    begin = i + 1
    # if (...) statement;  while (...) statement;  for (...) statement;
    while tokens[begin].group() in {"if", "while", "for", "else", "constexpr"}:
        if tokens[begin].group() in {"else", "constexpr"}:
            begin += 1
            continue
        k, depth = begin + 1, 0
        if k < len(tokens) and tokens[k].group() == "constexpr":
            k += 1
        while k < first:
            depth += tokens[k].group() in OPENING
            depth -= tokens[k].group() in CLOSING
            k += 1
            if depth == 0:
                break
        if k > first or depth:
            break
        begin = k
    return tokens[begin].start(), tokens[j - 1].end()


def _is_value(tokens: list[re.Match], closing: int) -> bool:
    """Whether the brace ends an initialiser or a lambda that an expression goes on after."""
    following = tokens[closing + 1].group() if closing + 1 < len(tokens) else ""
    return following in {
        ")",
        ",",
        ".",
        "?",
        ":",
        "+",
        "-",
        "*",
        "/",
        "<",
        ">",
        "==",
        "!=",
        "&&",
        "||",
        "[",
    }


def constant_word(tokens: list[re.Match], start: int) -> tuple[int, int] | None:
    """Where `constexpr` of the declaration stands whose initialiser the chunk is."""
    i = max((k for k, m in enumerate(tokens) if m.start() < start), default=-1)
    while i >= 0:
        text = tokens[i].group()
        if text == ";" or tokens[i].lastgroup == "directive":
            return None
        if text == "}" and not _is_value(tokens, i):
            return None
        if (
            text == "{"
            and i
            and tokens[i - 1].group()
            in {")", "const", "noexcept", "override", "else", "do"}
        ):
            return None
        if text == "constexpr":
            return tokens[i].span()
        i -= 1
    return None


def first_form(tokens: list[re.Match], start: int) -> Form:
    """What the text suggests for a chunk; the compiler has the last word."""
    if constant_word(tokens, start):
        return Form.NOT_CONSTANT
    i = max((k for k, m in enumerate(tokens) if m.start() < start), default=-1)
    if i >= 0 and tokens[i].group() == "case":
        return Form.ALONE
    depth = 0
    while i >= 0:
        text = tokens[i].group()
        depth += (text == "}") - (text == "{")
        if depth < 0:
            depth = 0
            k = i - 1
            while k >= 0 and tokens[k].group() not in {";", "{", "}"}:
                if tokens[k].group() == "constexpr":
                    return Form.OFF_IN_CONSTANTS
                k -= 1
        i -= 1
    return Form.RUNTIME


def place(text: str, mutants: list[tuple[int, Mutant]]) -> list[Woven]:
    """The mutants of a file with their chunks."""
    tokens = code_tokens(text)
    found = []
    for number, mutant in mutants:
        if mutant.operator == "call":
            within = [m for m in tokens if mutant.start <= m.start() < mutant.end]
            start, end = within[0].start(), within[-1].end()
        else:
            start, end = find_chunk(tokens, mutant)
        lines = [text.count("\n", 0, offset) + 1 for offset in (start, end)]
        form = first_form(tokens, start)
        found.append(Woven(mutant, number, form, start, end, *lines))
    return found


def weave(text: str, woven: list[Woven]) -> str:
    """The source with all its mutants behind the switch; the lines keep their numbers."""
    tokens = code_tokens(text)
    chunks: dict[tuple[int, int], list[Woven]] = {}
    constants: set[tuple[int, int]] = set()
    for w in woven:
        if w.form is Form.ALONE:
            continue
        if w.form is Form.NOT_CONSTANT:
            word = constant_word(tokens, w.start)
            if word is None:
                w.form = Form.OFF_IN_CONSTANTS
            else:
                constants.add(word)
        chunks.setdefault((w.start, w.end), []).append(w)

    def rendered(start: int, end: int, without: tuple[int, int] | None) -> str:
        """The part of the text with all chunks inside it woven, but for one."""
        inside = [c for c in chunks if start <= c[0] and c[1] <= end and c != without]
        outer = [
            c
            for c in inside
            if not any(o != c and o[0] <= c[0] and c[1] <= o[1] for o in inside)
        ]
        changes = [(a, b, chunk_text(a, b)) for a, b in outer]
        changes += [
            (a, b, "const")
            for a, b in constants
            if start <= a and b <= end and not any(o[0] <= a < o[1] for o in outer)
        ]
        pieces, last = [], start
        for a, b, new in sorted(changes):
            pieces += [text[last:a], new]
            last = b
        return "".join(pieces + [text[last:end]])

    def chunk_text(start: int, end: int) -> str:
        original = rendered(start, end, (start, end))
        pieces = []
        for w in chunks[start, end]:
            switch = f"ulpgate_mutation::{SWITCH[w.form]}({w.number})"
            m = w.mutant
            if m.operator == "call":
                return f"{{ if (!{switch}) {{ {original} }} }}"
            changed = one_line(
                text[start : m.start] + m.replacement + text[m.end : end]
            )
            pieces.append(f"{switch} ? ({changed}) : ")
        return "(" + "".join(pieces) + f"({original}))"

    return rendered(0, len(text), None)
