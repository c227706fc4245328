// EXPECT_ULP_LE(got, exact, limit) and ASSERT_ULP_LE(...) for GoogleTest; `exact` is a number of the type of
// `got` or ulpgate::call().
#pragma once

#include <gtest/gtest.h>

#include "ulpgate/matchers.hpp"

namespace ulpgate {
template <class Real, class Exact>
::testing::AssertionResult ulp_le(const char* got_words, const char* exact_words, const char* /*limit_words*/,
                                  const Real& got, const Exact& exact, double limit) {
  UlpResult r;
  if constexpr (std::is_arithmetic_v<Exact>) {
    r = ulp_of(got, static_cast<Real>(exact), limit);
  } else {
    r = ulp_of(got, exact, limit);
  }
  if (r.good) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << got_words << " is not " << exact_words << ": " << r.text;
}
}  // namespace ulpgate

#define EXPECT_ULP_LE(got, exact, limit) EXPECT_PRED_FORMAT3(::ulpgate::ulp_le, got, exact, limit)
#define ASSERT_ULP_LE(got, exact, limit) ASSERT_PRED_FORMAT3(::ulpgate::ulp_le, got, exact, limit)
