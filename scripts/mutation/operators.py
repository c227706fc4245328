"""Mutants: the places of a C++ source where one operator, constant, sign or call can change, and what to."""

import re
from dataclasses import dataclass

# The sources are formatted, so a binary operator stands between blanks and a template's bracket never does.
TOKEN = re.compile(
    r"""
    (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<raw>R"(?P<fence>[^()\s\\]*)\(.*?\)(?P=fence)")
  | (?P<string>"(?:\\.|[^"\\\n])*")
  | (?P<directive>^[ \t]*\#(?:\\\n|[^\n])*)
  | (?P<number>(?<![\w.])(?:0[xX][0-9a-fA-F']+(?:\.[0-9a-fA-F]*)?(?:[pP][+-]?\d+)?
               |(?:\d[\d']*)(?:\.\d*)?(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)[uUlLfF]*)
  | (?P<character>'(?:\\.|[^'\\\n])+')
  | (?P<word>[A-Za-z_]\w*)
  | (?P<attribute>\[\[.*?\]\])
  | (?P<operator><=>|<<=|>>=|->\*|->|\+\+|--|<=|>=|==|!=|&&|\|\||\+=|-=|\*=|/=|%=|<<|>>|::|[-+*/%<>=!&|^~?:;,.(){}\[\]])
    """,
    re.VERBOSE | re.DOTALL | re.MULTILINE,
)
CALL = re.compile(
    r"^[ \t]+(?!return\b|throw\b|delete\b|case\b|else\b|if\b|for\b|while\b|using\b|static_assert\b)"
    r"[A-Za-z_][\w.:>\-\[\]]*\(.*\);[ \t]*(?://[^\n]*)?$",
    re.MULTILINE,
)

BINARY = {
    "<": ("<=", ">"),
    "<=": ("<", ">"),
    ">": (">=", "<"),
    ">=": (">", "<"),
    "==": ("!=",),
    "!=": ("==",),
    "&&": ("||",),
    "||": ("&&",),
    "+": ("-",),
    "-": ("+",),
    "*": ("/",),
    "/": ("*",),
    "%": ("*",),
    "+=": ("-=",),
    "-=": ("+=",),
    "*=": ("/=",),
    "/=": ("*=",),
    "<<": (">>",),
    ">>": ("<<",),
}
KIND = {}
for kind, names in {
    "relation": "< <= > >= == !=",
    "logic": "&& ||",
    "arithmetic": "+ - * / % += -= *= /= << >>",
}.items():
    KIND |= dict.fromkeys(names.split(), kind)
# A minus after one of these is a sign.
BEFORE_A_SIGN = set("( [ { , = == != < > <= >= && || ? : ; += -= *= /= + - * /".split())
# Texts whose parts are no expressions that run.
CONSTANT_HEADS = {
    "static_assert",
    "requires",
    "alignas",
    "enum",
    "namespace",
    "noexcept",
}


@dataclass(frozen=True)
class Mutant:
    file: str
    start: int  # offsets in the text
    end: int
    operator: str
    replacement: str
    line: int  # from 1
    column: int
    before: str  # the line, without blanks around it
    after: str
    nth: int  # of the same change to the same text in the file, from 0

    @property
    def key(self) -> str:
        """Stays the same when lines elsewhere come and go."""
        return f"{self.file}: {self.before} => {self.after} #{self.nth}"

    def apply(self, text: str) -> str:
        return text[: self.start] + self.replacement + text[self.end :]


def next_number(text: str) -> str:
    """The literal plus one; a small fraction is doubled."""
    if re.fullmatch(r"\d[\d']*[uUlL]*", text):
        digits = re.match(r"[\d']+", text).group()
        return str(int(digits.replace("'", "")) + 1) + text[len(digits) :]
    if re.fullmatch(r"0[xX][0-9a-fA-F']+[uUlL]*", text):
        return f"({text} + 1)"
    exponent = re.search(r"[eEpP]([+-]?\d+)", text)
    if exponent and int(exponent.group(1)) < 0 or text.startswith("0."):
        return f"(2 * {text})"
    return f"({text} + 1)"


def skipped(tokens: list[re.Match]) -> set[int]:
    """Tokens inside static_assert(...), template <...> and the like, by number."""
    inside: set[int] = set()
    i = 0
    while i < len(tokens):
        word = tokens[i].group()
        following = tokens[i + 1].group() if i + 1 < len(tokens) else ""
        opening, closing = "", ""
        if word in CONSTANT_HEADS and following == "(":
            opening, closing = "(", ")"
        elif word == "template" and following == "<":
            opening, closing = "<", ">"
        elif word in {"namespace", "requires", "concept", "using"}:
            while i < len(tokens) and tokens[i].group() not in {";", "{"}:
                inside.add(i)
                i += 1
            continue
        if not opening:
            i += 1
            continue
        depth = 0
        i += 1
        while i < len(tokens):
            inside.add(i)
            text = tokens[i].group()
            depth += (text == opening) - (text == closing)
            if closing == ">" and text == ">>":
                depth -= 2
            i += 1
            if depth <= 0:
                break
    return inside


def find_mutants(file: str, text: str) -> list[Mutant]:
    """All mutants of a source, in the order of its text."""
    changes: list[tuple[int, int, str, str]] = []
    tokens = [
        m
        for m in TOKEN.finditer(text)
        if m.lastgroup not in {"comment"} and not m.group().startswith(("//", "/*"))
    ]
    hidden = [
        m.span()
        for m in TOKEN.finditer(text)
        if kind_of(m) in {"comment", "raw", "directive"}
    ]
    left_out = skipped(tokens)
    for i, token in enumerate(tokens):
        if i in left_out:
            continue
        kind, word = kind_of(token), token.group()
        start, end = token.span()
        previous = tokens[i - 1].group() if i else ";"
        spaced = text[start - 1 : start] in {" ", "\n"} and text[end : end + 1] in {
            " ",
            "\n",
        }
        if kind == "operator":
            if word in BINARY and spaced and previous != "operator":
                changes += [(start, end, KIND[word], other) for other in BINARY[word]]
            elif word == "!" and previous != "operator":
                changes.append((start, end, "negation", ""))
            elif (
                word == "-"
                and not spaced
                and (previous in BEFORE_A_SIGN or previous == "return")
            ):
                changes.append((start, end, "sign", ""))
            elif word in {"++", "--"} and previous != "operator":
                changes.append((start, end, "step", "--" if word == "++" else "++"))
        elif kind == "number":
            if (
                word == "0"
                and previous == "="
                and tokens[i - 2].group() in {")", "const", "override"}
            ):
                continue  # a pure virtual function
            changes.append((start, end, "constant", next_number(word)))
        elif word in {"true", "false"}:
            changes.append((start, end, "truth", "false" if word == "true" else "true"))
    for call in CALL.finditer(text):
        start = call.start() + len(call.group()) - len(call.group().lstrip())
        if not any(a <= start < b for a, b in hidden):
            changes.append((start, call.end(), "call", ";"))
    seen: dict[tuple[str, str], int] = {}
    mutants = []
    for start, end, operator, replacement in sorted(changes):
        first = text.rfind("\n", 0, start) + 1
        last = text.find("\n", end)
        last = len(text) if last < 0 else last
        before = text[first:last].strip()
        after = (text[first:start] + replacement + text[end:last]).strip()
        nth = seen.get((before, after), 0)
        seen[before, after] = nth + 1
        mutants.append(
            Mutant(
                file,
                start,
                end,
                operator,
                replacement,
                text.count("\n", 0, start) + 1,
                start - first + 1,
                before,
                after,
                nth,
            )
        )
    return mutants


def kind_of(token: re.Match) -> str:
    return "raw" if token.group("raw") else token.lastgroup
