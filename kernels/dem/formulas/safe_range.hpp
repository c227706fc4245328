// Where products and sums of squares keep their digits, and what is done beyond.
//
// A square leaves the range of a type at the roots of its ends, long before what is made of it does: the
// distance of two points, a reduced mass.  Ordinary numbers pass one test, which no rounding depends on; the
// others are taken again from numbers scaled by a power of two, which is exact.  J. L. Blue, ACM Trans.
// Math. Softw. 4 (1978) 15.
#pragma once

#include <limits>

#include "reference/types/real_types.hpp"

namespace ulpgate::dem {

// Whether a product or a sum of squares is what rounding makes of it: not infinite, and above what gradual
// underflow could have taken a part in 2^p from.  Not so of 0 and NaN.
template <RealType Real>
[[nodiscard]] bool is_safe(const Real& product) {
  static const Real least(std::numeric_limits<Real>::min() / std::numeric_limits<Real>::epsilon());
  static const Real largest(std::numeric_limits<Real>::max());
  return product >= least && product <= largest;
}

// a b/(a + b) of numbers above 0: two masses about their centre, two springs in a row, the radii of a pair.
template <RealType Real>
[[nodiscard]] Real in_series(const Real& a, const Real& b) {
  const Real product = a * b;
  if (is_safe(product)) return product / (a + b);
  return a < b ? Real(a / (1 + a / b)) : Real(b / (1 + b / a));
}

}  // namespace ulpgate::dem
