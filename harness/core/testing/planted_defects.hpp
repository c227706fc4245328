// Planted defects: functions that are wrong on purpose, to prove that the harness turns red.
#pragma once

#include <cmath>
#include <limits>

#include "kernels/math/function_table.hpp"

namespace ulpgate::testing {

// exp by reduction to |r| <= ln2/2 and a Taylor polynomial of degree 13 in Horner form, as libraries do it;
// the coefficient 1/5! is off by one part in 10^5.
inline double wrong_exp(double x) {
  if (!(x > -700 && x < 700)) return std::exp(x);
  const double n = std::nearbyint(x / 0.69314718055994530942);
  const double r = std::fma(-n, 0x1.62e42fefa39efp-1, x) - n * 0x1.abc9e3b39803fp-56;
  double factorial[14] = {1};
  for (int i = 1; i < 14; ++i) factorial[i] = factorial[i - 1] * i;
  factorial[5] *= 1.00001;
  double sum = 0;
  for (int i = 13; i >= 0; --i) sum = sum * r + 1 / factorial[i];
  return std::ldexp(sum, static_cast<int>(n));
}

// sqrt that is right but for one argument.
inline double sqrt_with_a_hole(double x) {
  return x == 40.0 ? std::numeric_limits<double>::quiet_NaN() : std::sqrt(x);
}

template <double (*F)(double)>
void batch_of(const double* args, double* results, std::uint8_t*, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) results[i] = F(args[i]);
}

}  // namespace ulpgate::testing
