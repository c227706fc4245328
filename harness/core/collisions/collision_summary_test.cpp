// Tests of the totals of a ledger.
#include "harness/core/collisions/collision_summary.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ulpgate {
namespace {

dem::CollisionRecord ended(std::int32_t first, double gained, double bound, double restitution,
                           std::uint64_t steps) {
  dem::CollisionRecord r;
  r.first = first;
  r.second = first + 1;
  r.begin_step = 10;
  r.steps_inside = steps;
  r.energy_before = 2;
  r.energy_gained = gained;
  r.energy_created = gained > 0 ? gained / 2 : 0;
  r.step_bound = bound / 2;
  r.rounding_bound = bound / 4;
  r.law_bound = bound / 4;
  r.beyond_condition = !(gained <= bound);
  r.restitution = restitution;
  return r;
}

TEST(CollisionSummary, CountsWhatCreatesAndWhatGoesBeyond) {
  CollisionSummary s;
  EXPECT_TRUE(std::isnan(s.mean_restitution()));
  s.add(ended(0, -1, 0.1, 0.5, 30));
  s.add(ended(2, 0.01, 0.1, 1.0, 20));
  s.add(ended(4, 0.3, 0.1, NAN, 40));
  dem::CollisionRecord open;
  open.open = true;
  open.omega_dt = 0.7;
  s.add(open);
  EXPECT_EQ(s.ended, 3U);
  EXPECT_EQ(s.open, 1U);
  EXPECT_EQ(s.creating, 2U);
  EXPECT_EQ(s.beyond, 1U);
  EXPECT_EQ(s.largest_created, 0.15);
  EXPECT_EQ(s.largest_at.first, 4);
  EXPECT_DOUBLE_EQ(s.largest_part_of_bound, 3);
  EXPECT_EQ(s.nearest_at.first, 4);
  EXPECT_DOUBLE_EQ(s.mean_restitution(), 0.75) << "of the two that have one";
  EXPECT_EQ(s.shortest, 20U);
  EXPECT_EQ(s.largest_omega_dt, 0.7);
}

TEST(CollisionSummary, AnEnergyThatIsNoNumberIsBeyondEverything) {
  CollisionSummary s;
  s.add(ended(0, NAN, 0.1, 1, 3));
  EXPECT_EQ(s.beyond, 1U);
  EXPECT_EQ(s.largest_part_of_bound, HUGE_VAL);
}

TEST(CollisionSummary, AGainWithoutAnyBoundIsBeyond) {
  EXPECT_EQ(part_of_bound(ended(0, 1e-30, 0, 1, 3)), HUGE_VAL);
  EXPECT_EQ(part_of_bound(ended(0, 0, 0, 1, 3)), 0);
}

}  // namespace
}  // namespace ulpgate
