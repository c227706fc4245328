"""The smoothing filter of Savitzky and Golay: in each window of an even grid, the value of the least squares polynomial.

A. Savitzky, M. J. E. Golay, Smoothing and differentiation of data by simplified least squares procedures,
Anal. Chem. 36 (1964) 1627-1639.
"""
import numpy


def _places(half):
    # On (-1, 1): powers of large integers would make the least squares ill-conditioned.
    return numpy.arange(-half, half + 1) / max(half, 1)


def _basis(half, degree):
    """An orthonormal basis (columns) of the polynomials on a window: the fit is the projection on it."""
    if half < 0 or degree < 0 or degree > 2 * half:
        raise ValueError(f"no polynomial of degree {degree} in {2 * half + 1} points")
    basis, _ = numpy.linalg.qr(numpy.vander(_places(half), degree + 1, increasing=True))
    return basis


def weights(half, degree):
    """The filter: weights of the 2 half + 1 points of a window for the fitted value at its centre."""
    basis = _basis(half, degree)
    return basis @ basis[half]


def smooth(values, half, degree):
    """The smoothed values, as many as given, with windows of 2 half + 1 points.

    Next to an end the window stays inside and its polynomial is evaluated off its centre, so that a polynomial of
    the filter's degree is reproduced up to the ends. Fewer values than a window are fitted as one window.
    """
    values = numpy.asarray(values, dtype=float)
    half = min(half, (len(values) - 1) // 2)
    if half < 1 or degree > 2 * half:
        return values.copy()
    basis, width = _basis(half, degree), 2 * half + 1
    # numpy.convolve turns its second operand round; these weights are symmetric.
    inner = numpy.convolve(values, weights(half, degree), mode="valid")
    first = basis[:half] @ (basis.T @ values[:width])
    last = basis[half + 1 :] @ (basis.T @ values[-width:])
    return numpy.concatenate([first, inner, last])
