"""Tests of the damped angle's figure: its smoothing, when types part, which runs are damped."""
import math

import numpy
import pytest

from ulpgate_report.pendulum import figure_damped_angle
from ulpgate_report.records import chain_series


def chain(times, angle, **changes):
    """A series with an angle alone."""
    made = chain_series.ChainSeries(numpy.array(times), numpy.array(angle), (), {}, {})
    return (
        made if not changes else chain_series.ChainSeries(**{**vars(made), **changes})
    )


@pytest.mark.parametrize("interval", [1e-4, 1e-3])
def test_smoothing_has_one_window_in_seconds(interval):
    times = numpy.arange(0, 1, interval)
    wave = numpy.sin(3 * times)
    ripple = 0.1 * numpy.sin(2 * numpy.pi * times / (4 * interval))
    found = figure_damped_angle.smoothed(chain(times, wave + ripple))
    inside = (times > 0.05) & (times < 0.95)
    assert numpy.abs(found[2] - wave)[inside].max() < 0.012
    assert (found[1] == wave + ripple).all(), "the raw angle stays beside it"


def test_a_run_that_broke_down_is_smoothed_up_to_there():
    angle = numpy.ones(1000)
    angle[600] = math.nan
    found = figure_damped_angle.smoothed(chain(numpy.arange(1000) * 1e-3, angle))
    assert len(found[0]) == 600 and numpy.isfinite(found[2]).all()


def test_parting_time():
    times = numpy.arange(0, 2, 1e-3)
    one, other = numpy.zeros(2000), numpy.zeros(2000)
    other[1500:] = 1.0
    lines = [(times, a, a) for a in (one, other)]
    assert figure_damped_angle.parting_time(*lines) == pytest.approx(1.5)
    assert figure_damped_angle.parting_time(lines[0], lines[0]) is None


@pytest.mark.parametrize(
    "variant, expected",
    [
        ("mass=yade,damping=5e-3", True),
        ("damping=0", False),
        ("damping=0.0,dt=1e-6", False),
        ("damping=1/200", True),
        ("mass=yade", False),
        ("", False),
    ],
)
def test_damped_variants(variant, expected):
    assert figure_damped_angle.is_damped(variant) is expected
