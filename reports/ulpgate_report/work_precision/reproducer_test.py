"""Tests of the commands that measure a setting again."""
import pytest

from ulpgate_report.testing import sample_work_precision as sample
from ulpgate_report.work_precision import reproducer

RUN = sample.of_run("trajectory", "kepler", "double", "leapfrog", 10, 1e-9)
SCENE = sample.of_run("scene", "deposition", "float", "leapfrog", 10, 1e-9)
FUNCTION = sample.line("function", "sin", "double", 1e-16)


@pytest.mark.parametrize(
    "row, expected",
    [
        (FUNCTION, "--subjects sin --types double"),
        (RUN, "--cases kepler --integrators leapfrog --types double --steps 10"),
        ({**RUN, "end": "2 pi"}, "--steps 10 --until '2 pi'"),
        ({**RUN, "name": "kepler_10", "case": "kepler"}, "--cases kepler --integ"),
        ({**RUN, "dt_text": "plan:1e-6"}, "--types double --dt plan:1e-6 --until 10"),
        (SCENE, "--cases deposition --integrators leapfrog --types float --dt 10/10"),
        ({**SCENE, "dt_text": "(1e-5)/2"}, "--dt '(1e-5)/2' --until 10"),
    ],
)
def test_commands(row, expected):
    found = reproducer.command(row)
    assert found.startswith("ulpgate work-precision ") and expected in found
