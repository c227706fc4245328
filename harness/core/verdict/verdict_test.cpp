// Verdict: total comparisons, the order of standings and the exit code of each.
#include "harness/core/verdict/verdict.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace ulpgate {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Verdict, NothingThatIsNoNumberPasses) {
  for (const double value : {nan, infinity, -infinity}) {
    EXPECT_EQ(at_most(value, 1), Standing::not_finite) << value;
    EXPECT_EQ(at_least(value, 1), Standing::not_finite) << value;
  }
  EXPECT_EQ(at_most(0, nan), Standing::not_finite);
  EXPECT_EQ(at_least(0, nan), Standing::not_finite);
}

TEST(Verdict, LimitsAreInclusive) {
  EXPECT_EQ(at_most(0.5, 0.5), Standing::pass);
  EXPECT_EQ(at_most(0.5000001, 0.5), Standing::regression);
  EXPECT_EQ(at_least(0.5, 0.5), Standing::pass);
  EXPECT_EQ(at_least(0.4999999, 0.5), Standing::regression);
}

TEST(Verdict, ASampleTooFewIsIncompleteAndNoneIsNothing) {
  EXPECT_EQ(measured(7, 7), Standing::pass);
  EXPECT_EQ(measured(6, 7), Standing::incomplete);
  EXPECT_EQ(measured(8, 7), Standing::incomplete);
  EXPECT_EQ(measured(0, 7), Standing::nothing_measured);
  EXPECT_EQ(measured(0, 0), Standing::nothing_measured);
}

TEST(Verdict, TheGravestStands) {
  Verdict verdict;
  EXPECT_TRUE(verdict.passes());
  verdict |= Standing::incomplete;
  EXPECT_EQ(exit_code(verdict.standing()), 3);
  verdict |= Standing::regression;
  verdict.add(Standing::pass, 100);
  EXPECT_EQ(verdict.standing(), Standing::regression);
  EXPECT_EQ(exit_code(verdict.standing()), 1);
  verdict |= Standing::another_plan;
  EXPECT_EQ(exit_code(verdict.standing()), 2);
  verdict |= Standing::environment;
  EXPECT_EQ(exit_code(verdict.standing()), 4);
  EXPECT_EQ(verdict.count(Standing::pass), 100U);
  EXPECT_EQ(verdict.count(Standing::incomplete), 1U);
}

TEST(Verdict, ExitCodes) {
  EXPECT_EQ(exit_code(Standing::pass), 0);
  EXPECT_EQ(exit_code(Standing::not_finite), 1);
  EXPECT_EQ(exit_code(Standing::bad_input), 2);
  EXPECT_EQ(exit_code(Standing::another_machine), 2);
  EXPECT_EQ(exit_code(Standing::nothing_measured), 3);
}

}  // namespace
}  // namespace ulpgate
