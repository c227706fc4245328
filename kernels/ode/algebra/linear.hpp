// Small linear systems for coefficients, which need few of them and no library.
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "reference/types/real_types.hpp"

namespace ulpgate::ode::detail {

// x of a x = b for a small square matrix, by elimination with row pivots.  Eigen's would cost every
// translation unit some ten seconds per type.
template <RealType Real>
[[nodiscard]] std::vector<Real> solved_linear(std::vector<std::vector<Real>> a, std::vector<Real> b) {
  using std::abs;
  const std::size_t n = b.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < n; ++r) {
      if (abs(a[r][c]) > abs(a[pivot][c])) pivot = r;
    }
    std::swap(a[c], a[pivot]);
    std::swap(b[c], b[pivot]);
    for (std::size_t r = c + 1; r < n; ++r) {
      const Real factor = a[r][c] / a[c][c];
      for (std::size_t k = c; k < n; ++k) a[r][k] -= factor * a[c][k];
      b[r] -= factor * b[c];
    }
  }
  for (std::size_t c = n; c-- > 0;) {
    for (std::size_t k = c + 1; k < n; ++k) b[c] -= a[c][k] * b[k];
    b[c] /= a[c][c];
  }
  return b;
}

}  // namespace ulpgate::ode::detail
