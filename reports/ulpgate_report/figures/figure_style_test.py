"""Tests of what all figures share: a label is parsed once, whichever file it is drawn in."""

import pytest
from matplotlib import mathtext

from ulpgate_report.figures import figure_style


def test_a_label_is_parsed_once():
    if not hasattr(mathtext.MathTextParser, "_parse_cached"):
        pytest.skip("this matplotlib parses in another way")
    label = figure_style.power_of_ten(-3)
    # Each file has a parser of its own; vectors and dots are parsed for themselves.
    of_one, of_another = (
        mathtext.MathTextParser("path").parse(label) for _ in range(2)
    )
    assert of_one is of_another
    assert mathtext.MathTextParser("agg").parse(label) is not of_one
    # Another label or size is another.
    assert mathtext.MathTextParser("path").parse("$10^{-4}$") is not of_one
    assert mathtext.MathTextParser("path").parse(label, dpi=100) is not of_one
