"""Tests of the smoothing filter: the published weights, polynomials reproduced up to the ends, noise that falls."""
import numpy
import pytest

from ulpgate_report.pendulum import savitzky_golay


@pytest.mark.parametrize(
    "half, degree, expected, norm",
    [
        (2, 2, (-3, 12, 17, 12, -3), 35),
        (2, 3, (-3, 12, 17, 12, -3), 35),
        (3, 2, (-2, 3, 6, 7, 6, 3, -2), 21),
        (4, 2, (-21, 14, 39, 54, 59, 54, 39, 14, -21), 231),
        (4, 4, (15, -55, 30, 135, 179, 135, 30, -55, 15), 429),
        (1, 0, (1, 1, 1), 3),
    ],
)
def test_published_weights(half, degree, expected, norm):
    """Tables of Savitzky and Golay 1964, as corrected by Steinier, Termonia, Deltour 1972."""
    found = savitzky_golay.weights(half, degree) * norm
    assert found == pytest.approx(expected, abs=1e-11 * norm)


@pytest.mark.parametrize(
    "half, degree",
    [(h, d) for h in (1, 2, 5, 50, 250) for d in range(6) if d <= 2 * h],
)
def test_polynomials_of_its_degree_are_reproduced(half, degree):
    x = numpy.linspace(-1, 1, 600)
    for power in range(degree + 1):
        given = 1 + (x - 0.2) ** power
        found = savitzky_golay.smooth(given, half, degree)
        assert numpy.abs(found - given).max() < 1e-13, "the ends too"


def test_a_higher_degree_is_smoothed_away():
    x = numpy.linspace(-1, 1, 101)
    assert numpy.abs(savitzky_golay.smooth(x**4, 10, 3) - x**4).max() > 1e-4


def test_noise_falls_as_the_weights_say():
    noise = numpy.random.default_rng(1).standard_normal(200000)
    found = savitzky_golay.smooth(noise, 25, 3)[25:-25]
    expected = numpy.sqrt((savitzky_golay.weights(25, 3) ** 2).sum())
    assert found.std() == pytest.approx(expected, rel=0.03)
    assert expected == pytest.approx(savitzky_golay.weights(25, 3)[25] ** 0.5)


@pytest.mark.parametrize(
    "count, why",
    [(0, "nothing"), (1, "one point"), (2, "fewer than a window"), (3, "one window")],
)
def test_short_series(count, why):
    given = numpy.arange(count, dtype=float)
    assert savitzky_golay.smooth(given, 50, 1) == pytest.approx(given), why


def test_a_degree_that_cannot_be_fitted():
    with pytest.raises(ValueError, match="degree 5 in 5 points"):
        savitzky_golay.weights(2, 5)
