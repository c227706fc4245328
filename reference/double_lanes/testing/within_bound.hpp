// Whether a value in double is within its bound of what MPFR says.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "reference/oracle/oracle.hpp"

namespace ulpgate {

// Beyond these a result may be infinite, or zero (double_lanes.hpp).
struct RangeOfResults {
  double least_infinite = std::numeric_limits<double>::max();
  double greatest_zero = 0x1.1p-1022;
};

// Of f at `args`.  `share`, where it is given, is raised to error / bound.
inline testing::AssertionResult is_within_bound(const FunctionInfo& f, std::span<const double> args,
                                                double got, double bound, RangeOfResults range = {},
                                                double* share = nullptr) {
  if (bound < 0) return testing::AssertionSuccess();
  std::vector<MpfrValue> exact_args;
  for (const double x : args) {
    exact_args.emplace_back(53);
    mpfr_set_d(exact_args.back(), x, MPFR_RNDN);
  }
  std::vector<MpfrValue> exact;
  exact.emplace_back(160);
  exact_value(f, exact_args, exact);
  const long double value = mpfr_get_ld(exact[0], MPFR_RNDN);
  const auto told = [&](bool right) {
    if (right) return testing::AssertionSuccess();
    return testing::AssertionFailure() << f.name << "(" << std::hexfloat << args[0] << ") = " << got
                                       << ", exact " << static_cast<double>(value) << ", bound " << bound;
  };
  if (std::isnan(got) || std::isnan(value)) return told(std::isnan(got) && std::isnan(value));
  if (std::signbit(got) != std::signbit(value)) return told(false);
  if (std::isinf(got)) return told(std::fabs(value) > range.least_infinite);
  if (std::fabs(got) < std::numeric_limits<double>::min())
    return told(std::fabs(value) < range.greatest_zero);
  const long double error = std::fabs(got - value) / std::ldexp(1.0L, std::ilogb(got) - 52);
  if (share != nullptr && bound > 0) *share = std::max(*share, static_cast<double>(error) / bound);
  return told(error <= bound);
}

}  // namespace ulpgate
