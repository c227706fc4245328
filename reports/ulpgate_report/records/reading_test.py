"""Tests that every schema is one and says what it is of."""
import pytest

from ulpgate_report.records import reading

NAMES = sorted(path.name.split(".")[0] for path in reading.SCHEMA_FOLDER.iterdir())


@pytest.mark.parametrize("name", NAMES)
def test_schemas_are_schemas(name):
    assert reading.validator(name).schema["title"]
