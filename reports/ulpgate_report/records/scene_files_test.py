"""Tests of the scene and type that a file's name tells."""
import pytest

from ulpgate_report.records import scene_files


@pytest.mark.parametrize(
    "stem, known, expected, why",
    [
        ("deposition_double", [], ("deposition", "double"), "plain"),
        ("a_long_double", [], ("a", "long_double"), "the longest type"),
        ("a_long_double", [("a_long", "double")], ("a_long", "double"), "records tell"),
        ("p_3_cpp_bin_float62", [], ("p_3", "cpp_bin_float62"), "underscores in both"),
        ("p_mpfr40", [], ("p", "mpfr40"), "any number of digits"),
        ("angles", [], None, "no type"),
    ],
)
def test_names_of_files(stem, known, expected, why):
    assert scene_files.split_name(stem, known) == expected, why
