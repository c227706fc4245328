"""Tests of the order of types and of how each is drawn."""
from ulpgate_report.figures import type_style
from ulpgate_report.values import type_order


def test_types_stand_in_one_order():
    found = ["mpfr40", "cpp_bin_float62", "float", "double", "float"]
    assert type_order.ordered(found) == ["float", "double", "cpp_bin_float62", "mpfr40"]
    styles = {type_style.line_style(t, found) for t in found}
    assert len(styles) == 4
