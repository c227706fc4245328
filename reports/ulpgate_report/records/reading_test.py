"""Tests of reading: schemas, shapes of lines, the scene and type that a file's name tells."""
import json

import pytest

from ulpgate_report.records import reading, scene_files
from ulpgate_report.records.errors import InvalidInput

NAMES = sorted(path.name.split(".")[0] for path in reading.SCHEMA_FOLDER.iterdir())


@pytest.mark.parametrize("name", NAMES)
def test_schemas_are_schemas(name):
    assert reading.validator(name).schema["title"]


@pytest.mark.parametrize(
    "value, other, alike, why",
    [
        ({"a": 1.5}, {"a": 2.5}, True, "on one side of every bound"),
        ({"a": 1.5}, {"a": -1.5}, False, "a bound between"),
        ({"a": 1.5}, {"a": 0.0}, False, "on a bound"),
        ({"a": 0}, {"a": 0.0}, True, "both whole"),
        ({"a": 2}, {"a": 2.5}, False, "whole or not"),
        ({"a": 1}, {"a": True}, False, "no number"),
        ({"a": None}, {"a": 0}, False, "likewise"),
        ({"a": "b"}, {"a": "c"}, False, "texts are compared whole"),
        ({"a": 1}, {"b": 1}, False, "another field"),
        ([1, 2], [1, 2, 3], False, "longer"),
        ([1, 2], {"a": 1}, False, "no list"),
        ([], "", False, "nor a text"),
    ],
)
def test_shapes_keep_what_a_schema_sees(value, other, alike, why):
    bounds = [0]
    found = reading.shape_of(value, bounds) == reading.shape_of(other, bounds)
    assert found is alike, why


@pytest.mark.parametrize("name", NAMES)
def test_shapes_are_enough_for_the_schema(name):
    text = json.dumps(reading.validator(name).schema)
    # The types of a context are few: it is read alone.
    allowed = ("uniqueItems",) if name == "context" else ()
    for word in reading.NO_SHAPES:
        assert word in allowed or f'"{word}"' not in text


def test_many_lines_are_each_held_to_the_schema(tmp_path):
    path = tmp_path / "timing.jsonl"
    good = {"what": "sin", "type": "double", "ns_per_eval": 5.0}
    lines = [good, {**good, "ns_per_eval": 7.0}, {**good, "ns_per_eval": -7.0}]
    path.write_text("\n".join(map(json.dumps, lines)))
    found = reading.read_many_lines(path, "timing")
    assert [next(found)[1], next(found)[1]] == lines[:2]
    with pytest.raises(InvalidInput, match="timing.jsonl:3: ns_per_eval"):
        next(found)


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
