// Differences of nearly equal numbers, and the same functions without them.
#pragma once

#include <cmath>
#include <vector>

#include "reference/types/real_types.hpp"

namespace ulpgate::formulas {

// (1 - cos x) / x^2, 1/2 at 0.
template <RealType Real>
[[nodiscard]] Real one_minus_cosine_naive(const Real& x) {
  using std::cos;
  return Real((1 - cos(x)) / (x * x));
}

// The same as 2 (sin(x/2) / x)^2.
template <RealType Real>
[[nodiscard]] Real one_minus_cosine_half_angle(const Real& x) {
  using std::sin;
  const Real q(sin(Real(x / 2)) / x);
  return Real(2 * (q * q));
}

// (e^x - 1) / x, 1 at 0.
template <RealType Real>
[[nodiscard]] Real exponential_quotient_naive(const Real& x) {
  using std::exp;
  return Real((exp(x) - 1) / x);
}

// W. Kahan's (y - 1) / log y with y = e^x rounded: the two errors cancel (Higham 2002, 1.14.1).
template <RealType Real>
[[nodiscard]] Real exponential_quotient_kahan(const Real& x) {
  using std::exp;
  using std::log;
  const Real y(exp(x));
  if (y == 1) return Real(1);
  return Real((y - 1) / log(y));
}

template <RealType Real>
[[nodiscard]] Real exponential_quotient_expm1(const Real& x) {
  using std::expm1;
  return x == 0 ? Real(1) : Real(expm1(x) / x);
}

template <RealType Real>
[[nodiscard]] Real log_of_one_plus_naive(const Real& x) {
  using std::log;
  return Real(log(Real(1 + x)));
}

// x log w / (w - 1) with w = 1 + x rounded (HP-15C Advanced Functions Handbook, 1982).
template <RealType Real>
[[nodiscard]] Real log_of_one_plus_kahan(const Real& x) {
  using std::log;
  const Real w(1 + x);
  if (w == 1) return x;
  return Real(x * log(w) / (w - 1));
}

template <RealType Real>
[[nodiscard]] Real log_of_one_plus_log1p(const Real& x) {
  using std::log1p;
  return Real(log1p(x));
}

// |x - sqrt(x^2 + 1)| - 1/(x + sqrt(x^2 + 1)): 0 for every x > 0, and rounding noise in arithmetic.
template <RealType Real>
[[nodiscard]] Real monster_noise(const Real& x) {
  using std::abs;
  using std::sqrt;
  const Real root(sqrt(Real(x * x + 1)));
  return Real(abs(Real(x - root)) - 1 / (x + root));
}

// W. Kahan's Monster, E(Q(x)^2) with E(z) = (e^z - 1)/z, E(0) = 1, and the noise Q: 1 for every x.  Squared
// noise is below every roundoff, so that e^z is 1 in every precision and the quotient 0.
template <RealType Real>
[[nodiscard]] Real monster_naive(const Real& x) {
  const Real q(monster_noise(x));
  const Real z(q * q);
  return z == 0 ? Real(1) : exponential_quotient_naive(z);
}

template <RealType Real>
[[nodiscard]] Real monster_expm1(const Real& x) {
  const Real q(monster_noise(x));
  return exponential_quotient_expm1(Real(q * q));
}

// (a + b)/2 as it stands, which overflows where the mean does not, and as two halves.
template <RealType Real>
[[nodiscard]] Real midpoint_of_sum(const Real& a, const Real& b) {
  return Real((a + b) / 2);
}
template <RealType Real>
[[nodiscard]] Real midpoint_of_halves(const Real& a, const Real& b) {
  return Real(a / 2 + b / 2);
}

}  // namespace ulpgate::formulas
