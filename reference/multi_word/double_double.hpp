// DoubleDouble: a number of about 106 bits as the unevaluated sum of two doubles.
#pragma once

#include <cmath>

namespace ulpgate {

// hi is the sum rounded to nearest: |lo| <= ulp(hi) / 2.  Made from a double without error, from an x87 long
// double as well where its exponent is one of double.
struct DoubleDouble {
  double hi = 0;
  double lo = 0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double high, double low) : hi(high), lo(low) {}
  constexpr DoubleDouble(int n) : hi(n) {}     // NOLINT(google-explicit-constructor): 0 is one
  constexpr DoubleDouble(double x) : hi(x) {}  // NOLINT(google-explicit-constructor): a double is one
  constexpr DoubleDouble(long double x)  // NOLINT(google-explicit-constructor): a number of 64 bits is one
      : hi(static_cast<double>(x)) {
    if (hi - hi == 0) lo = static_cast<double>(x - static_cast<long double>(hi));
  }
  constexpr explicit operator double() const { return hi; }
  constexpr explicit operator long double() const {
    return static_cast<long double>(hi) + static_cast<long double>(lo);
  }

  constexpr DoubleDouble operator-() const { return {-hi, -lo}; }
  constexpr bool operator==(const DoubleDouble& o) const { return hi == o.hi && lo == o.lo; }
  constexpr bool operator<(const DoubleDouble& o) const { return hi < o.hi || (hi == o.hi && lo < o.lo); }

  // Within 2^-104 of the difference: AccurateDWPlusDW of M. Joldes, J.-M. Muller, V. Popescu, "Tight and
  // rigorous error bounds for basic building blocks of double-word arithmetic", ACM TOMS 44 (2017) 15,
  // theorem 3.1 (3u^2 / (1 - 4u)).
  constexpr DoubleDouble operator-(const DoubleDouble& o) const {
    const double s = hi - o.hi;
    const double s_back = s - hi;
    const double s_error = (hi - (s - s_back)) + (-o.hi - s_back);
    const double t = lo - o.lo;
    const double t_back = t - lo;
    const double t_error = (lo - (t - t_back)) + (-o.lo - t_back);
    const double c = s_error + t;
    const double v = s + c;
    const double w = t_error + (c - (v - s));
    const double z = v + w;
    return {z, w - (z - v)};
  }
};

// One ulp of a DoubleDouble as bounds count them: 2^-99 of the power of two below the number.
inline constexpr int double_double_bits = 100;
// The binade down to which both parts of a number have all of their bits.
inline constexpr int double_double_least = -960;
// The binade below which a function's value is told as a zero with a bound that is none.
inline constexpr int double_double_zero = -1100;

}  // namespace ulpgate
