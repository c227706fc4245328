"""Tests that the schemas are schemas."""
import pytest

from ulpgate_report.records import reading


@pytest.mark.parametrize(
    "name",
    ["context", "math", "timing", "summary", "scenes", "correlation", "orders"],
)
def test_schemas_are_schemas(name):
    assert reading.validator(name).schema["title"]
