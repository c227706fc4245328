// Recurrences that forget their start, or cannot.
#pragma once

#include <cmath>
#include <limits>

#include "reference/types/real_types.hpp"

namespace ulpgate::formulas {

// u_n of J.-M. Muller's u_{k+1} = 111 - 1130/u_k + 3000/(u_k u_{k-1}), n >= 1: from 2, -4 the limit is 6, and
// 100 from nearly everywhere else.
template <RealType Real>
[[nodiscard]] Real muller_recurrence(const Real& u0, const Real& u1, long n) {
  Real before(u0);
  Real u(u1);
  for (long k = 1; k < n; ++k) {
    const Real next(111 - 1130 / u + 3000 / (u * before));
    before = u;
    u = next;
  }
  return u;
}

// u_n from 2, -4: (3 6^(n+1) - 4 5^(n+1)) / (3 6^n - 4 5^n), divided by 6^n.
template <RealType Real>
[[nodiscard]] Real muller_closed_form(long n) {
  Real ratio(1);
  for (long k = 0; k < n; ++k) ratio = ratio * 5 / 6;
  return Real((18 - 20 * ratio) / (3 - 4 * ratio));
}

// a_n of a_k = k a_{k-1} - 1: from e - 1, n! (1/(n+1)! + 1/(n+2)! + ...), which tends to 0 (J.-M. Muller's
// bank account).
template <RealType Real>
[[nodiscard]] Real account_forward(const Real& start, long n) {
  Real a(start);
  for (long k = 1; k <= n; ++k) a = a * Real(k) - 1;
  return a;
}

// The same a_n from above, where every step divides the error (J. C. P. Miller): begun at 0 so far up that
// nothing of that is left.
template <RealType Real>
[[nodiscard]] Real account_backward(long n) {
  long from = n;
  for (double bits = 0; bits < std::numeric_limits<Real>::digits + 4; ++from)
    bits += std::log2(static_cast<double>(from + 1));
  Real a(0);
  for (long k = from; k > n; --k) a = (a + 1) / Real(k);
  return a;
}

// x_n of the logistic map x <- 4 x (1 - x).
template <RealType Real>
[[nodiscard]] Real logistic_map(const Real& start, long n) {
  Real x(start);
  for (long k = 0; k < n; ++k) x = 4 * x * (1 - x);
  return x;
}

// The same as sin^2(2^n asin sqrt x).
template <RealType Real>
[[nodiscard]] Real logistic_closed_form(const Real& start, long n) {
  using std::asin;
  using std::ldexp;
  using std::sin;
  using std::sqrt;
  const Real angle(ldexp(Real(asin(Real(sqrt(start)))), static_cast<int>(n)));
  const Real s(sin(angle));
  return Real(s * s);
}

// n square roots, then n squares (W. Kahan): x, if nothing were rounded.
template <RealType Real>
[[nodiscard]] Real roots_then_squares(const Real& start, long n) {
  using std::sqrt;
  Real x(start);
  for (long k = 0; k < n; ++k) x = sqrt(x);
  for (long k = 0; k < n; ++k) x = x * x;
  return x;
}

// The same on the logarithm, whose halves and doubles are exact.
template <RealType Real>
[[nodiscard]] Real roots_then_squares_by_logarithm(const Real& start, long n) {
  using std::exp;
  using std::ldexp;
  using std::log;
  Real l(log(start));
  l = ldexp(l, static_cast<int>(-n));
  l = ldexp(l, static_cast<int>(n));
  return Real(exp(l));
}

// The same on exponent and logarithm of the significand apart: the exponential has no large argument to
// multiply its error by.
template <RealType Real>
[[nodiscard]] Real roots_then_squares_by_parts(const Real& start, long n) {
  using std::exp;
  using std::frexp;
  using std::ldexp;
  using std::log;
  int e = 0;
  const Real significand(frexp(start, &e));
  Real l(log(significand));
  Real exponent(static_cast<Real>(e));
  for (const int shift : {static_cast<int>(-n), static_cast<int>(n)}) {
    l = ldexp(l, shift);
    exponent = ldexp(exponent, shift);
  }
  return Real(ldexp(Real(exp(l)), static_cast<int>(exponent)));
}

}  // namespace ulpgate::formulas
