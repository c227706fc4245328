// Polynomials and rational functions of a few integers, and their roots.
#pragma once

#include <cmath>
#include <span>

#include "reference/types/real_types.hpp"

namespace ulpgate::formulas {

// S. M. Rump, Algorithms for verified inclusions (1988): 333.75 b^6 + a^2 (11 a^2 b^2 - b^6 - 121 b^4 - 2)
// + 5.5 b^8 + a/(2b) in the order in which it was printed; -54767/66192 at (77617, 33096), which needs 122
// bits.
template <RealType Real>
[[nodiscard]] Real rump_1988_original(const Real& a, const Real& b) {
  const Real a2(a * a);
  const Real b2(b * b);
  const Real b4(b2 * b2);
  const Real b6(b4 * b2);
  const Real b8(b4 * b4);
  const Real bracket(11 * a2 * b2 - b6 - 121 * b4 - 2);
  return Real(Real(1335) / 4 * b6 + a2 * bracket + Real(11) / 2 * b8 + a / (2 * b));
}

// E. Loh, G. W. Walster, Rump's example revisited (2002): the same polynomial in an order in which IEEE types
// of up to 113 bits agree on the wrong 1.1726...
template <RealType Real>
[[nodiscard]] Real rump_1988_reordered(const Real& a, const Real& b) {
  const Real a2(a * a);
  const Real b2(b * b);
  const Real b4(b2 * b2);
  const Real b6(b4 * b2);
  const Real b8(b4 * b4);
  return Real((Real(1335) / 4 - a2) * b6 + a2 * (11 * a2 * b2 - 121 * b4 - 2) + Real(11) / 2 * b8 +
              a / (2 * b));
}

// S. M. Rump (1983): 9 x^4 - y^4 + 2 y^2, which is 1 at (10864, 18817).
template <RealType Real>
[[nodiscard]] Real rump_1983_expanded(const Real& x, const Real& y) {
  const Real x2(x * x);
  const Real y2(y * y);
  return Real(9 * (x2 * x2) - y2 * y2 + 2 * y2);
}

// The same with 9 x^4 - y^4 factored: where 3 x^2 is a number of the type, all of it is exact but the last
// sum.
template <RealType Real>
[[nodiscard]] Real rump_1983_factored(const Real& x, const Real& y) {
  const Real x2(x * x);
  const Real y2(y * y);
  return Real((3 * x2 - y2) * (3 * x2 + y2) + 2 * y2);
}

// The root of a x^2 + b x + c of the smaller magnitude, for b < 0 and two real roots, by the school's
// formula.
template <RealType Real>
[[nodiscard]] Real small_root_textbook(const Real& a, const Real& b, const Real& c) {
  using std::sqrt;
  return Real((-b - sqrt(Real(b * b - 4 * a * c))) / (2 * a));
}

// The same root as c / (a q) of the other one, q, which does not cancel (Higham 2002, 1.8).
template <RealType Real>
[[nodiscard]] Real small_root_by_product(const Real& a, const Real& b, const Real& c) {
  using std::sqrt;
  const Real large((-b + sqrt(Real(b * b - 4 * a * c))) / (2 * a));
  return Real(c / (a * large));
}

// Newton's iteration from `start` on the polynomial with these coefficients, the highest power first; ends
// where the iterate no longer changes, after 100 steps at most.
template <RealType Real>
[[nodiscard]] Real newton_on_coefficients(std::span<const Real> coefficients, const Real& start) {
  Real x(start);
  for (int i = 0; i < 100; ++i) {
    Real value(coefficients[0]);
    Real slope(0);
    for (const Real& c : coefficients.subspan(1)) {
      slope = slope * x + value;
      value = value * x + c;
    }
    if (value == 0 || slope == 0) break;
    const Real next(x - value / slope);
    if (next == x) break;
    x = next;
  }
  return x;
}

// Newton's iteration on (x - 1)(x - 2) ... (x - degree), whose slope over value is the sum of 1/(x - k).
template <RealType Real>
[[nodiscard]] Real newton_on_product(long degree, const Real& start) {
  Real x(start);
  for (int i = 0; i < 100; ++i) {
    Real slope_over_value(0);
    for (long k = 1; k <= degree; ++k) {
      if (x == Real(k)) return x;
      slope_over_value += 1 / Real(x - Real(k));
    }
    const Real next(x - 1 / slope_over_value);
    if (next == x) break;
    x = next;
  }
  return x;
}

}  // namespace ulpgate::formulas
