// Tests of measured orders and energy drift.
#include "harness/core/orders/order_engine.hpp"

#include <gtest/gtest.h>

namespace ulpgate {
namespace {

const OrderLadder& measured(LadderMeasurement& ladder) {
  while (!ladder.complete()) (void)ladder.proceed(1);
  return ladder.ladder();
}

const EnergyDrift& measured(DriftMeasurement& drift) {
  while (!drift.complete()) (void)drift.proceed(1000);
  return drift.drift();
}

TEST(OrderEngine, TheLadderReachesTheFloorWithTheOrderOfTheMethod) {
  const OrderEngine* engine = find_order_engine("double");
  ASSERT_NE(engine, nullptr);
  for (const auto& [name, order] : {std::pair("velocity_verlet", 2), {"forest_ruth", 4}, {"yoshida8", 8}}) {
    const auto measurement = engine->ladder(name, "kepler", 2048);
    const OrderLadder& ladder = measured(*measurement);
    ASSERT_TRUE(ladder.measured_order.has_value()) << name;
    EXPECT_NEAR(*ladder.measured_order, order, 0.1 * order) << name;
    EXPECT_LT(ladder.rungs.back().error, 1e-12) << name;
    EXPECT_FALSE(ladder.rungs.front().order.has_value());
    EXPECT_EQ(ladder.rungs[1].dt, ladder.t_end / 2);
  }
}

TEST(OrderEngine, SplittingNeedsAnAcceleration) {
  const OrderEngine& engine = *find_order_engine("double");
  EXPECT_TRUE(engine.applies("pefrl", "pendulum"));
  EXPECT_FALSE(engine.applies("pefrl", "rigid_body"));
  EXPECT_TRUE(engine.applies("gauss4", "rigid_body"));
  EXPECT_EQ(find_order_engine("decimal"), nullptr);
  EXPECT_THROW((void)engine.ladder("pefrl", "square", 16), std::invalid_argument);
}

// A symplectic method of an order whose truncation lies below the rounding: the energy walks by Brouwer's
// law.  One of order 2 at the same step keeps an error that the step bounds.
TEST(OrderEngine, RoundingWalksAndTruncationIsBounded) {
  const OrderEngine& engine = *find_order_engine("double");
  const auto tenth = engine.drift("sofroniou_spaletta10", "kepler", 64, 4096);
  const EnergyDrift& walk = measured(*tenth);
  EXPECT_LT(walk.largest(), 1e-12);
  ASSERT_TRUE(walk.slope().has_value());
  EXPECT_NEAR(*walk.slope(), 0.5, 0.45);
  const auto second = engine.drift("velocity_verlet", "kepler", 64, 4096);
  const EnergyDrift& bounded = measured(*second);
  EXPECT_GT(bounded.largest(), 1e-6);
  EXPECT_NEAR(bounded.slope().value_or(1), 0, 0.05);
}

}  // namespace
}  // namespace ulpgate
