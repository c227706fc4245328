// Tests of arguments next to midpoints: how close they come, and that they are what they say.
#include "harness/core/testing/near_midpoints.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reference/types/exchange.hpp"
#include "reference/types/rounding.hpp"

namespace ulpgate {
namespace {

double median_log2(std::vector<double> distances) {
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return std::log2(*middle);
}

// Random results are a median 2^-3 ULP from what they are next to.
TEST(NearMidpoints, LieCloserThanRandomOnesByTheSizeOfTheWindow) {
  struct Case {
    FloatFormat format;
    double median;  // log2 ULP; the window is some 2^(p/3)
  };
  for (const auto& [format, median] : {Case{float_format<float>(), -8}, Case{float_format<double>(), -17},
                                       Case{float_format<long double>(), -20}}) {
    for (const FunctionInfo& f : all_functions()) {
      const std::size_t count = 60;
      const auto points = near_midpoints(f, format, count, 1);
      if (f.arity != 1 || f.function_class != FunctionClass::real || f.id == FunctionId::logb) {
        EXPECT_TRUE(points.empty()) << f.name;
        continue;
      }
      ASSERT_EQ(points.size(), count) << f.name;
      std::vector<double> distances;
      for (const NearMidpoint& p : points) {
        MpfrValue rounded(mpfr_get_prec(p.argument.get()) + 64);
        mpfr_set(rounded, p.argument, MPFR_RNDN);
        round_to_format(rounded, format);
        EXPECT_TRUE(mpfr_equal_p(rounded, p.argument)) << f.name << ": a number of the format";
        const NearMidpoint again = hardness_of(f, format, p.argument);
        EXPECT_EQ(again.distance_ulp, p.distance_ulp);
        EXPECT_EQ(again.midpoint, p.midpoint);
        distances.push_back(p.distance_ulp);
      }
      EXPECT_LT(median_log2(distances), median) << f.name;
      const auto midpoints = std::ranges::count(points, true, &NearMidpoint::midpoint);
      EXPECT_GE(midpoints, static_cast<std::ptrdiff_t>(count / 5)) << f.name;
    }
  }
}

TEST(NearMidpoints, MoreWindowsComeCloser) {
  const FunctionInfo& exp = info_of(FunctionId::exp);
  const auto median = [&](int windows) {
    std::vector<double> distances;
    for (const auto& p : near_midpoints(exp, float_format<double>(), 50, 3, windows))
      distances.push_back(p.distance_ulp);
    return median_log2(distances);
  };
  EXPECT_LT(median(64), median(1) - 4);
}

// Lefevre and Muller's worst case of exp in binary64 for |x| > 2^-30 (ARITH 2001, table 1).
TEST(NearMidpoints, HardnessIsThatOfThePublishedWorstCase) {
  MpfrValue x(53);
  mpfr_set_str(x, "-0x1.ed318efb627eap-27", 0, MPFR_RNDN);
  const NearMidpoint worst = hardness_of(info_of(FunctionId::exp), float_format<double>(), x);
  EXPECT_LT(worst.distance_ulp, 0x1p-55);
  mpfr_set_str(x, "0x1p+0", 0, MPFR_RNDN);
  EXPECT_GT(hardness_of(info_of(FunctionId::exp), float_format<double>(), x).distance_ulp, 0x1p-8);
  EXPECT_EQ(hardness_of(info_of(FunctionId::sqrt), float_format<double>(), x).distance_ulp, 0);
}

}  // namespace
}  // namespace ulpgate
