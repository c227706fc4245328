"""Random edits of a text: what turns a scene, a record or a budget into one that is slightly wrong."""

import re

NUMBERS = [
    "0",
    "-1",
    "1",
    "-0.0",
    "nan",
    "inf",
    "-inf",
    "1e308",
    "-1e308",
    "1e-308",
    "1e-320",
    "1e300",
    "1e-60",
]
NUMBERS += [
    "18446744073709551616",
    "-9223372036854775809",
    "4294967296",
    "0x10",
    "010",
    "1e",
    "''",
    '""',
    "[]",
]
NUMBERS += [
    "true",
    "[0, 0, 0]",
    '"R"',
    '"sqrt(-1)"',
    '"1/0"',
    '"nan"',
    "1e9",
    "1000000000",
]
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w.])")


def replace_number(text, rng):
    found = list(NUMBER.finditer(text))
    if not found:
        return text + rng.choice(NUMBERS)
    m = rng.choice(found)
    return text[: m.start()] + rng.choice(NUMBERS) + text[m.end() :]


def change_digit(text, rng):
    at = [i for i, c in enumerate(text) if c.isdigit()]
    if not at:
        return text + "7"
    i = rng.choice(at)
    return (
        text[:i] + rng.choice([d for d in "0123456789" if d != text[i]]) + text[i + 1 :]
    )


def drop_line(text, rng):
    lines = text.splitlines(True)
    if lines:
        del lines[rng.randrange(len(lines))]
    return "".join(lines)


def repeat_line(text, rng):
    lines = text.splitlines(True)
    if not lines:
        return "{}\n"
    i = rng.randrange(len(lines))
    return "".join(lines[: i + 1] + lines[i:])


def cut(text, rng):
    return text[: rng.randrange(len(text) + 1)]


def insert(text, rng):
    i = rng.randrange(len(text) + 1)
    return (
        text[:i]
        + rng.choice(
            ["\0", "\x01", "]", "}", '"', "=", ",", "[[", "\u00e9", "#", "null"]
        )
        + text[i:]
    )


def rename_key(text, rng):
    keys = list(re.finditer(r'"?([A-Za-z_]\w+)"?\s*[:=]', text))
    if not keys:
        return text + "x"
    m = rng.choice(keys)
    return text[: m.start(1)] + m.group(1) + "x" + text[m.end(1) :]


def null_value(text, rng):
    values = list(re.finditer(r'(?<=":)(?:-?[\d.e+-]+|"[^"]*")', text))
    if not values:
        return replace_number(text, rng)
    m = rng.choice(values)
    other = rng.choice(["null", "-1", "[]", '""', "{}", "1e308", "true"])
    return text[: m.start()] + other + text[m.end() :]


EDITS = [
    replace_number,
    change_digit,
    drop_line,
    repeat_line,
    cut,
    insert,
    rename_key,
    null_value,
]


def edited(text, rng, edits):
    """Another text than the one given."""
    new = text
    while new == text:
        for _ in range(rng.choice([1, 1, 1, 2, 3])):
            new = rng.choice(edits)(new, rng)
    return new
