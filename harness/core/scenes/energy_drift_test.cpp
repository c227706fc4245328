// Tests of the growth of energy errors.
#include "harness/core/scenes/energy_drift.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ulpgate {
namespace {

EnergyDrift grown(double exponent, int records) {
  EnergyDrift drift;
  for (int i = 1; i <= records; ++i) {
    const double t = i * 1e-3;
    drift.add(t, (i % 2 == 0 ? -1e-9 : 1e-9) * std::pow(t, exponent));
  }
  return drift;
}

TEST(EnergyDrift, FindsTheExponentOfAPowerOfTime) {
  for (const double exponent : {0.0, 0.5, 1.0, 2.0}) {
    const auto slope = grown(exponent, 20000).slope();
    ASSERT_TRUE(slope.has_value());
    EXPECT_NEAR(*slope, exponent, 2e-3);
  }
}

TEST(EnergyDrift, ARandomWalkGrowsByBrouwersLaw) {
  // The mean slope of many walks: one walk alone scatters by some 0.3.
  std::uint64_t word = 1;
  double sum = 0;
  constexpr int walks = 200;
  for (int w = 0; w < walks; ++w) {
    EnergyDrift drift;
    double error = 0;
    for (int i = 1; i <= 4096; ++i) {
      word = word * 6364136223846793005U + 1442695040888963407U;
      error += (word >> 63) != 0 ? 1e-20 : -1e-20;
      drift.add(i, error);
    }
    sum += drift.slope().value_or(0);
  }
  EXPECT_NEAR(sum / walks, 0.5, 0.1);
}

TEST(EnergyDrift, LargestAndDegenerateRuns) {
  EXPECT_DOUBLE_EQ(grown(1, 100).largest(), 1e-10);
  EXPECT_FALSE(EnergyDrift().slope().has_value());
  EXPECT_FALSE(grown(1, 20).slope().has_value()) << "too few records";
  EnergyDrift still;
  for (int i = 1; i <= 5000; ++i) still.add(i, 0);
  EXPECT_EQ(still.largest(), 0);
  EXPECT_FALSE(still.slope().has_value()) << "an error of 0 has no logarithm";
  EnergyDrift lost;
  for (int i = 1; i <= 5000; ++i) lost.add(i, i == 3000 ? NAN : 1);
  EXPECT_TRUE(std::isnan(lost.largest()));
  EXPECT_FALSE(lost.slope().has_value());
}

}  // namespace
}  // namespace ulpgate
