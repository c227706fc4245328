"""Tests that the page's programs parse."""
import shutil
import subprocess
from pathlib import Path

import pytest

TEMPLATES = Path(__file__).resolve().parent / "templates"


@pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
@pytest.mark.parametrize("name", ["tables.js", "distribution.js"])
def test_scripts_parse(name):
    subprocess.run(["node", "--check", str(TEMPLATES / name)], check=True)
