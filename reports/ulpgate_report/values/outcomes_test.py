"""Tests of the words for outcomes: every one that a record can have, and the sentence of a caption."""
import pytest

from ulpgate_report.values import outcomes


@pytest.mark.parametrize(
    "names, text",
    [
        ([], ""),
        (["nan"], " Kinds: nan (gives NaN where there is a value)."),
        (
            ["hang", "crash", "hang"],
            " Kinds: hang (does not end), crash (crashes).",
        ),
        (["never_seen"], " Kinds: never_seen (gives never seen)."),
    ],
)
def test_explained(names, text):
    assert outcomes.explained(names) == text
