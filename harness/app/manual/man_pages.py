"""Man pages of ulpgate and its verbs, in man(7)."""

# Files by the verbs that a page points to.
_EXIT = "Exit codes:"


def name_of(words):
    """The page's name: ulpgate-scene-run."""
    return "-".join(("ulpgate", *words))


def escaped(text):
    """Text that troff prints as it is."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join(
        "\\&" + line if line.startswith((".", "'")) else line
        for line in text.split("\n")
    )


def _entries(title, entries):
    if not entries:
        return []
    lines = [f".SH {title}"]
    for one in entries:
        names = ", ".join(rf"\fB{escaped(name)}\fR" for name in one.names)
        takes = rf" \fI{escaped(one.takes)}\fR" if one.takes else ""
        lines += [".TP", names + takes, escaped(one.text) or "\\&"]
    return lines


def _see_also(verb, tree):
    words = verb.words
    near = [w for w in tree if len(w) == len(words) + 1 and w[: len(words)] == words]
    if words:
        near = [words[:-1], *near]
    return ", ".join(rf"\fB{escaped(name_of(w))}\fR(1)" for w in near)


def page(verb, tree, version):
    """The page of one verb."""
    name = name_of(verb.words)
    summary = verb.summary.rstrip(".")
    lines = [
        rf'.TH {name.upper()} 1 "" "ulpgate {version}" "User Commands"',
        ".SH NAME",
        rf"{escaped(name)} \- {escaped(summary)}",
        ".SH SYNOPSIS",
        rf"\fB{escaped(verb.usage or 'ulpgate')}\fR",
    ]
    lines += _entries("ARGUMENTS", verb.positionals)
    lines += _entries("VERBS", verb.verbs)
    lines += _entries("OPTIONS", verb.options)
    if verb.notes:
        lines += [".SH NOTES", ".nf", escaped(verb.notes), ".fi"]
    also = _see_also(verb, tree)
    if also:
        lines += [".SH SEE ALSO", also]
    return "\n".join(lines) + "\n"
