// Where products and sums of squares keep their digits, and what is done beyond.
//
// A square leaves the range of a type at the roots of its ends, long before what is made of it does: the
// distance of two points, a reduced mass.  Ordinary numbers pass one test, which no rounding depends on; the
// others are taken again from numbers scaled by a power of two, which is exact.  J. L. Blue, ACM Trans.
// Math. Softw. 4 (1978) 15.
#pragma once

#include <cmath>
#include <limits>

#include "reference/types/format.hpp"

namespace ulpgate::dem {

// 2^e with 1 <= m < 2 in front, by the type's own format: numeric_limits of MPFR's numbers tell the range of
// whichever thread asks first, and a reference's is wider.
template <RealType Real>
[[nodiscard]] Real at_exponent(const Real& m, long e) {
  using std::ldexp;
  return ldexp(m, static_cast<int>(e));
}
template <RealType Real>
[[nodiscard]] const Real& least_normal() {
  static const Real least = at_exponent(Real(1), float_format<Real>().exponent_min);
  return least;
}
template <RealType Real>
[[nodiscard]] const Real& largest_number() {
  static const Real largest = at_exponent(Real(2 - at_exponent(Real(1), 1 - float_format<Real>().precision)),
                                          float_format<Real>().exponent_max);
  return largest;
}

// Whether a product or a sum of squares is what rounding makes of it: not infinite, and above what gradual
// underflow could have taken a part in 2^p from.  Not so of 0 and NaN.
template <RealType Real>
[[nodiscard]] bool is_safe(const Real& product) {
  if constexpr (NativeReal<Real>) {
    using Limits = std::numeric_limits<Real>;
    return product >= Limits::min() / Limits::epsilon() && product <= Limits::max();
  } else {
    static const Real least =
        at_exponent(Real(1), float_format<Real>().exponent_min + float_format<Real>().precision - 1);
    return product >= least && product <= largest_number<Real>();
  }
}

// a b/(a + b) of numbers above 0: two masses about their centre, two springs in a row, the radii of a pair.
template <RealType Real>
[[nodiscard]] Real in_series(const Real& a, const Real& b) {
  const Real product = a * b;
  if (is_safe(product)) return product / (a + b);
  return a < b ? Real(a / (1 + a / b)) : Real(b / (1 + b / a));
}

}  // namespace ulpgate::dem
