// The rule of the verdicts, and how a row stands against what is known of its case.
#include "harness/core/stress/stress_case.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ulpgate {
namespace {

StressRow row_of(StressVerdict verdict, const std::string& why = "") {
  StressRow row;
  row.verdict = verdict;
  row.why = why;
  return row;
}

TEST(StressVerdict, ComesFromErrorConditionAndRoundoff) {
  const double u = unit_roundoff(53);
  EXPECT_EQ(u, 0x1p-53);
  struct Row {
    double error, condition;
    StressVerdict verdict;
  };
  for (const Row& r :
       {Row{0, 1, StressVerdict::stable}, Row{16 * u, 1, StressVerdict::stable},
        Row{17 * u, 1, StressVerdict::unstable}, Row{16 * u, 0, StressVerdict::stable},
        Row{16e3 * u, 1e3, StressVerdict::stable}, Row{1e-3, 1e12, StressVerdict::ill_conditioned},
        Row{1e-3, 1e10, StressVerdict::unstable}, Row{17 * u, std::nan(""), StressVerdict::unstable},
        Row{std::nan(""), 1e300, StressVerdict::diverged}, Row{HUGE_VAL, 1, StressVerdict::diverged}}) {
    EXPECT_EQ(judge_stress(r.error, r.condition, u), r.verdict) << r.error << " " << r.condition;
  }
}

TEST(StressVerdict, NamesLeadBack) {
  for (const StressVerdict v :
       {StressVerdict::stable, StressVerdict::ill_conditioned, StressVerdict::unstable,
        StressVerdict::wrong_outcome, StressVerdict::diverged, StressVerdict::refused})
    EXPECT_EQ(stress_verdict_of(to_string(v)), v);
  EXPECT_FALSE(stress_verdict_of("fine"));
}

TEST(StressStanding, IsThatOfTheFirstKnownVerdictOfTheType) {
  StressCase c;
  c.known = {{"float,double", StressVerdict::unstable, "cancels"}, {"all", StressVerdict::diverged, "grows"}};
  EXPECT_TRUE(standing_of(c, "double", row_of(StressVerdict::unstable)).as_known);
  EXPECT_EQ(standing_of(c, "double", row_of(StressVerdict::unstable)).cause, "cancels");
  EXPECT_FALSE(standing_of(c, "double", row_of(StressVerdict::diverged)).as_known);
  EXPECT_FALSE(standing_of(c, "double", row_of(StressVerdict::stable)).as_known);
  EXPECT_TRUE(standing_of(c, "long_double", row_of(StressVerdict::diverged)).as_known);
  EXPECT_EQ(standing_of(c, "mpfr62", row_of(StressVerdict::stable)).expected, "diverged");
  c.known.clear();
  EXPECT_TRUE(standing_of(c, "double", row_of(StressVerdict::stable)).as_known);
  EXPECT_TRUE(standing_of(c, "double", row_of(StressVerdict::ill_conditioned)).as_known);
  EXPECT_FALSE(standing_of(c, "double", row_of(StressVerdict::unstable)).as_known);
}

TEST(StressStanding, HoldsARefusalToItsText) {
  StressCase c;
  c.known = {{"all", StressVerdict::refused, "no direction", "centres are the same point"}};
  const auto stands = [&](const std::string& why) {
    return standing_of(c, "double", row_of(StressVerdict::refused, why)).as_known;
  };
  EXPECT_TRUE(stands("bodies 0 and 1: their centres are the same point, so that no direction"));
  EXPECT_FALSE(stands("bad_alloc"));
  EXPECT_FALSE(stands(""));
  // The right words do not excuse another verdict.
  EXPECT_FALSE(
      standing_of(c, "double", row_of(StressVerdict::diverged, "centres are the same point")).as_known);
  EXPECT_EQ(standing_of(c, "double", row_of(StressVerdict::refused)).says, "centres are the same point");
  // What is known without a text is no refusal in particular.
  c.known.front().says.clear();
  EXPECT_FALSE(stands("bodies 0 and 1: their centres are the same point"));
  // A case that threw something unforeseen is refused as well, and known to nobody.
  c.known.clear();
  EXPECT_FALSE(stands("centres are the same point"));
}

}  // namespace
}  // namespace ulpgate
