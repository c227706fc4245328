// Tests of the cost model: what is measured replaces what was guessed.
#include "harness/core/plan/cost_model.hpp"

#include <gtest/gtest.h>

namespace ulpgate {
namespace {

TEST(CostModel, TakesTheBestKnownCostOfEveryRow) {
  // Rows 0 and 1 are one function and type; row 2 another that is 10 times dearer by its prior; row 3 a
  // third.
  CostModel costs({{0, 1, 1000}, {0, 1, 1000}, {1, 10, 1000}, {2, 1, 100}});
  EXPECT_FALSE(costs.is_known(0));
  EXPECT_EQ(costs.remaining_s(), 0) << "nothing is known yet";
  costs.add_trial(0, 4, 4e-3);
  EXPECT_TRUE(costs.is_known(1)) << "a trial speaks for the group";
  EXPECT_DOUBLE_EQ(costs.remaining_s(), 1 + 1 + 10 + 0.1);
  costs.add(0, 500, 1);
  EXPECT_DOUBLE_EQ(costs.spent_s(), 1);
  EXPECT_DOUBLE_EQ(costs.remaining_s(), 1 + 2 + 20 + 0.2) << "2 ms a point; the trial counts no more";
  costs.add(2, 1000, 3);
  EXPECT_DOUBLE_EQ(costs.remaining_s(), 1 + 2 + 0 + 100 * (4 / 10500.0));
  costs.add(1, 100, 1);
  EXPECT_DOUBLE_EQ(costs.remaining_s(), 500 * 2e-3 + 900 * 1e-2 + 100 * (5 / 10600.0))
      << "every row has its own";
}

}  // namespace
}  // namespace ulpgate
