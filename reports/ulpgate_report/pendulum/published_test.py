"""Tests of what is published of which run."""
import pytest

from ulpgate_report.pendulum import published


@pytest.mark.parametrize(
    "scene, dt, variant, expected, why",
    [
        ("pendulum3", "1e-5", "mass=yade", 2.5, "the published run"),
        ("pendulum3", "(2e-5)/2", "mass=yade,dt=(2e-5)/2", 2.5, "the same step"),
        ("pendulum3", "1e-5", "", None, "another mass"),
        ("pendulum3", "1e-6", "mass=yade", None, "another step"),
        ("pendulum3", "1e-5", "mass=yade,damping=5e-3", None, "damped"),
        ("pendulum2", "1e-5", "mass=yade", None, "another scene"),
    ],
)
def test_published(scene, dt, variant, expected, why):
    assert published.pendulum_t_s(scene, dt, variant, "double") == expected, why
