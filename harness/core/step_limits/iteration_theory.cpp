// sweep_radius() and the limits of iterations.
#include "harness/core/step_limits/iteration_theory.hpp"

#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "kernels/ode/integrators/gauss_legendre.hpp"

namespace ulpgate {

namespace {

using Complex = std::complex<double>;
using SquareMatrix = std::vector<std::vector<Complex>>;

SquareMatrix zeros(std::size_t n) {
  return SquareMatrix(n, std::vector<Complex>(n));
}

// lim |A^n|^(1/n) (I. Gelfand, Rec. Math. 9 (1941) 3), by squaring A sixty times: what the norm of a power
// has beyond the radius, a factor of a low power of n, is then below any rounding.  Eigen's solver of complex
// matrices would be a tenth of what this room takes to compile.
double spectral_radius(SquareMatrix a) {
  const std::size_t n = a.size();
  double log_of_radius = 0;
  double of_power = 1;
  for (int squarings = 0; squarings <= 60; ++squarings, of_power /= 2) {
    double norm = 0;
    for (const auto& row : a) {
      for (const Complex& x : row) {
        // What is not a number stays: no radius follows from it.
        if (!(std::abs(x) <= norm)) norm = std::abs(x);
      }
    }
    if (norm == 0) return 0;
    log_of_radius += of_power * std::log(norm);
    for (auto& row : a) {
      for (Complex& x : row) x /= norm;
    }
    SquareMatrix square = zeros(n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t j = 0; j < n; ++j) square[i][j] += a[i][k] * a[k][j];
      }
    }
    a = std::move(square);
  }
  return std::exp(log_of_radius);
}

}  // namespace

double sweep_radius(int stages, Axis axis, double z) {
  const auto& tableau = ode::gauss_tableau<double>(stages);
  const Complex mu = axis == Axis::imaginary ? Complex(0, z) : Complex(-z, 0);
  const auto n = static_cast<std::size_t>(stages);
  // k_i = mu (y + sum_{j<i} a_ij k_j + sum_{j>=i} a_ij k_j of before): row by row, what the stages before
  // have of each column is known.
  SquareMatrix sweep = zeros(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t column = 0; column < n; ++column) {
      if (column >= i) sweep[i][column] = mu * tableau.a[i][column];
      for (std::size_t j = 0; j < i; ++j) sweep[i][column] += mu * tableau.a[i][j] * sweep[j][column];
    }
  }
  return spectral_radius(std::move(sweep));
}

double sweep_limit(int stages, Axis axis, double radius) {
  double below = 0;
  double above = 0.05;
  while (sweep_radius(stages, axis, above) < radius) {
    below = above;
    above += 0.05;
  }
  while (above - below > 1e-10 * above) {
    const double middle = (below + above) / 2;
    (sweep_radius(stages, axis, middle) < radius ? below : above) = middle;
  }
  return below;
}

double jacobi_limit(int stages) {
  const auto& tableau = ode::gauss_tableau<double>(stages);
  const auto n = static_cast<std::size_t>(stages);
  SquareMatrix a = zeros(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) a[i][j] = tableau.a[i][j];
  }
  return 1 / spectral_radius(std::move(a));
}

}  // namespace ulpgate
