// The scan for stable steps on excesses whose edges are known.
#include "harness/core/step_limits/stable_set.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ulpgate {
namespace {

double no_rounding(double) {
  return 0;
}

TEST(StableSet, FindsTheLimitOfTheLeapfrog) {
  const StableSet set =
      find_stable_set([](double z) { return std::abs(1 - z * z / 2) - 1; }, no_rounding, 12, 0.02);
  ASSERT_TRUE(set.limit());
  EXPECT_NEAR(*set.limit(), 2, 1e-8);
  EXPECT_TRUE(set.gaps().empty());
  EXPECT_TRUE(set.reentries().empty());
}

// Unstable within 1e-5 of an odd place, a two-thousandth of the grid.
TEST(StableSet, FindsAGapMuchNarrowerThanTheGrid) {
  const double centre = 1.23456789;
  const StableSet set = find_stable_set(
      [&](double z) { return z > 3 ? z - 3 : 1e-10 - (z - centre) * (z - centre); }, no_rounding, 5, 0.02);
  ASSERT_EQ(set.gaps().size(), 1U);
  EXPECT_NEAR(set.gaps()[0].from, centre - 1e-5, 1e-8);
  EXPECT_NEAR(set.gaps()[0].to, centre + 1e-5, 1e-8);
  EXPECT_NEAR(set.gaps()[0].largest_excess, 1e-10, 1e-12);
  ASSERT_TRUE(set.limit());
  EXPECT_NEAR(*set.limit(), 3, 1e-7);
}

TEST(StableSet, HidesAGapBelowRounding) {
  const StableSet set = find_stable_set([](double z) { return 1e-10 - (z - 1.2) * (z - 1.2); },
                                        [](double) { return 1e-9; }, 2, 0.02);
  EXPECT_TRUE(set.unstable.empty());
  EXPECT_FALSE(set.limit());
}

// Narrow stable islands behind the limit as well, and to the end of the scan.
TEST(StableSet, FindsWhereStabilityComesBack) {
  const StableSet set = find_stable_set(
      [](double z) {
        if (z < 2 || z > 4.5) return -0.5;
        return (z - 3.1234) * (z - 3.1234) - 1e-8;
      },
      no_rounding, 5, 0.02);
  ASSERT_EQ(set.reentries().size(), 2U);
  EXPECT_NEAR(set.reentries()[0].from, 3.1233, 1e-7);
  EXPECT_NEAR(set.reentries()[0].to, 3.1235, 1e-7);
  EXPECT_NEAR(set.reentries()[1].from, 4.5, 1e-7);
  EXPECT_EQ(set.reentries()[1].to, 5);
}

TEST(StableSet, GrowsFromNothing) {
  const StableSet set = find_stable_set([](double z) { return z * z; }, no_rounding, 5, 0.02);
  EXPECT_EQ(set.limit(), 0);
}

TEST(StableSet, TakesWhatIsNoNumberForUnstable) {
  const StableSet set = find_stable_set(
      [](double z) { return z < 1 ? -1 : std::numeric_limits<double>::quiet_NaN(); }, no_rounding, 5, 0.02);
  ASSERT_TRUE(set.limit());
  EXPECT_NEAR(*set.limit(), 1, 1e-8);
}

}  // namespace
}  // namespace ulpgate
