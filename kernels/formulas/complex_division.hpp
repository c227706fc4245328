// (a + i b) / (c + i d) in three ways; the results are {real, imaginary}.
#pragma once

#include <cmath>
#include <vector>

#include "reference/types/real_types.hpp"

namespace ulpgate::formulas {

template <RealType Real>
[[nodiscard]] std::vector<Real> complex_quotient_naive(const Real& a, const Real& b, const Real& c,
                                                       const Real& d) {
  const Real divisor(c * c + d * d);
  return {Real((a * c + b * d) / divisor), Real((b * c - a * d) / divisor)};
}

// R. L. Smith, Algorithm 116 (CACM 5, 1962): divided by the larger part of the divisor.
template <RealType Real>
[[nodiscard]] std::vector<Real> complex_quotient_smith(const Real& a, const Real& b, const Real& c,
                                                       const Real& d) {
  using std::abs;
  if (abs(d) <= abs(c)) {
    const Real r(d / c);
    const Real divisor(c + d * r);
    return {Real((a + b * r) / divisor), Real((b - a * r) / divisor)};
  }
  const Real r(c / d);
  const Real divisor(c * r + d);
  return {Real((a * r + b) / divisor), Real((b * r - a) / divisor)};
}

// One part of M. Baudin, R. L. Smith, A robust complex division in Scilab (2012): (a + b r) t for r = d/c, in
// an order that survives an r or a b r that underflows.
template <RealType Real>
[[nodiscard]] Real robust_quotient_part(const Real& a, const Real& b, const Real& c, const Real& d,
                                        const Real& r, const Real& t) {
  if (r == 0) return Real((a + d * (b / c)) * t);
  const Real br(b * r);
  return br == 0 ? Real(a * t + (b * t) * r) : Real((a + br) * t);
}

// For divisors and dividends whose parts are below half of the largest number.
template <RealType Real>
[[nodiscard]] std::vector<Real> complex_quotient_robust(const Real& a, const Real& b, const Real& c,
                                                        const Real& d) {
  using std::abs;
  const bool upright = abs(d) <= abs(c);
  const Real& large = upright ? c : d;
  const Real& small = upright ? d : c;
  const Real r(small / large);
  const Real t(1 / (large + small * r));
  if (upright) {
    return {robust_quotient_part(a, b, large, small, r, t),
            robust_quotient_part(b, Real(-a), large, small, r, t)};
  }
  return {robust_quotient_part(b, a, large, small, r, t),
          Real(-robust_quotient_part(a, Real(-b), large, small, r, t))};
}

}  // namespace ulpgate::formulas
