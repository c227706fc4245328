// Tests of what a gate must not let through: figures that are none, other plans, lost cases, changes below a
// known maximum.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/core/gate/bounds.hpp"
#include "harness/core/gate/budgets.hpp"
#include "harness/core/gate/limits.hpp"

namespace ulpgate {
namespace {

RowRecord row(const std::string& stratum, const std::vector<double>& errors, std::uint64_t seed = 1) {
  RowRecord r;
  r.subject = "sin";
  r.part = "value";
  r.type = "double";
  r.stratum = stratum;
  r.planned = errors.size();
  r.seed = seed;
  for (std::uint64_t k = 0; k < errors.size(); ++k) {
    const Outcome outcome = errors[k] < 0 ? Outcome::nan : Outcome::finite;
    r.summary.add({outcome, {std::max(errors[k], 0.0)}, 0, errors[k] <= 0.5}, k);
    if (errors[k] < 0) r.points.first_mismatch[outcome] = {"0x1p+0"};
  }
  return r;
}

// Errors in (0, 1/2) as of a good library, others for another seed.
std::vector<double> good_errors(std::size_t n, std::uint64_t seed) {
  std::vector<double> errors;
  for (std::size_t k = 0; k < n; ++k) errors.push_back(0.5 * counter_fraction(1000000 * seed + k));
  return errors;
}

// The known bad ones near multiples of pi/2, and what was good.
std::vector<double> hard_errors() {
  auto errors = good_errors(500, 1);
  errors.insert(errors.end(), {3, 40, 300, 5000, 70000, 143269});
  return errors;
}

bool has(const std::vector<GateFinding>& findings, FindingKind kind) {
  return std::ranges::any_of(findings, [=](const GateFinding& f) { return f.kind == kind; });
}

std::vector<GateFinding> judged(const RowRecord& now, const Budgets& budgets, const OtherPlan& other = {}) {
  return judge_records({now}, budgets, MissingRecords::ignore, other);
}

Budgets budgets_of(const RowRecord& r) {
  return measured_budgets({r}, 20000, 1);
}

TEST(SilentPasses, A5AnotherArgumentThatIsOffFailsBelowTheKnownMaximum) {
  const auto then = hard_errors();
  const Budgets budgets = budgets_of(row("hard", then));
  EXPECT_TRUE(judged(row("hard", then), budgets).empty());
  for (const double wrong : {1.5, 20.0, 50000.0}) {
    auto now = then;
    now[7] = wrong;
    EXPECT_TRUE(has(judged(row("hard", now), budgets), FindingKind::regression)) << wrong;
  }
}

TEST(SilentPasses, A5TheMeanAndThePercentileAreGated) {
  const auto then = good_errors(1000, 1);
  const Budgets budgets = budgets_of(row("uniform", then));
  auto now = then;
  for (double& e : now) e = std::min(0.499, 1.1 * e);
  const auto findings = judged(row("uniform", now), budgets);
  EXPECT_TRUE(std::ranges::any_of(findings,
                                  [](const GateFinding& f) { return f.message.starts_with("mean error"); }));
  now = then;
  for (std::size_t k = 0; k < 30; ++k) now[k] = 0.9;
  EXPECT_TRUE(
      std::ranges::any_of(judged(row("uniform", now), budgets_of(row("uniform", then))),
                          [](const GateFinding& f) { return f.message.starts_with("99th percentile"); }));
}

TEST(SilentPasses, A5NoLimitIsInfiniteAndWhatIsBeyondMeasureIsCounted) {
  auto errors = good_errors(50, 1);
  errors.insert(errors.end(), {HUGE_VAL, HUGE_VAL});
  const Budgets budgets = budgets_of(row("edges", errors));
  const Budget& budget = budgets.at("double").rows.at("sin");
  EXPECT_FALSE(budget.max_ulp.contains("edges"));
  for (const auto& column : limit_columns())
    for (const auto& [stratum, limit] : budget.*column.limits)
      EXPECT_TRUE(std::isfinite(limit)) << column.key;
  EXPECT_EQ(budget.above.at("edges").at(beyond_measure), 2U);
  EXPECT_TRUE(judged(row("edges", errors), budgets).empty());
  errors[3] = HUGE_VAL;
  EXPECT_TRUE(has(judged(row("edges", errors), budgets), FindingKind::regression));
}

TEST(SilentPasses, A11FiguresThatAreNoneNeverPass) {
  const Budgets budgets = budgets_of(row("uniform", good_errors(100, 1)));
  for (const double figure : {-1.0, std::numeric_limits<double>::quiet_NaN(), HUGE_VAL}) {
    RowRecord r = row("uniform", good_errors(100, 1));
    r.summary.max_error.value = figure;
    EXPECT_FALSE(judged(r, budgets).empty()) << figure;
    r = row("uniform", good_errors(100, 1));
    r.summary.max_error_over_condition = figure;
    EXPECT_FALSE(judged(r, budgets).empty()) << figure;
  }
  RowRecord empty = row("uniform", {});
  EXPECT_FALSE(judged(empty, budgets).empty()) << "nothing of nothing";
}

TEST(SilentPasses, A12AnotherSeedOrSizeIsRefusedOrHeldToDerivedLimits) {
  Budgets budgets = budgets_of(row("uniform", good_errors(10000, 1)));
  const RowRecord other = row("uniform", good_errors(10000, 2), 2);
  EXPECT_TRUE(has(judged(other, budgets), FindingKind::another_plan));
  EXPECT_TRUE(has(judged(row("uniform", good_errors(5000, 1)), budgets), FindingKind::another_plan));
  EXPECT_TRUE(has(judged(other, budgets, {true, {}}), FindingKind::missing_budget)) << "no bound";
  std::vector<std::vector<RowRecord>> seeds;
  for (std::uint64_t s = 101; s <= 106; ++s) seeds.push_back({row("uniform", good_errors(20000, s), s)});
  add_bounds(budgets, seeds);
  EXPECT_TRUE(judged(other, budgets, {true, {}}).empty());
  EXPECT_TRUE(
      has(judged(row("uniform", good_errors(2, 7), 7), budgets, {true, {}}), FindingKind::incomplete));
  EXPECT_TRUE(judged(row("uniform", good_errors(2, 7), 7), budgets, {true, 2}).empty());
}

TEST(SilentPasses, A13OtherSeedsAndSizesPassAndPlantedErrorsDoNot) {
  Budgets budgets = budgets_of(row("uniform", good_errors(10000, 1)));
  std::vector<std::vector<RowRecord>> seeds;
  for (std::uint64_t s = 101; s <= 106; ++s) seeds.push_back({row("uniform", good_errors(20000, s), s)});
  add_bounds(budgets, seeds);
  for (const std::size_t n : {1000U, 2500U, 10000U, 20000U}) {
    for (std::uint64_t s = 2; s <= 13; ++s) {
      const auto errors = good_errors(n, s);
      EXPECT_TRUE(judged(row("uniform", errors, s), budgets, {true, {}}).empty()) << n << " " << s;
      auto one = errors;
      one[n / 2] = 3;
      EXPECT_TRUE(has(judged(row("uniform", one, s), budgets, {true, {}}), FindingKind::regression));
      auto nan = errors;
      nan[n / 3] = -1;
      EXPECT_TRUE(has(judged(row("uniform", nan, s), budgets, {true, {}}), FindingKind::regression));
      // A fifth worse on the whole, and still below the maximum.
      auto worse = errors;
      for (double& e : worse) e = std::min(0.499, 1.2 * e);
      // Fewer samples leave that much to chance.
      if (n < 10000) continue;
      EXPECT_TRUE(has(judged(row("uniform", worse, s), budgets, {true, {}}), FindingKind::regression)) << s;
    }
  }
}

TEST(SilentPasses, A4AnotherPlanCannotReplaceTheBudgets) {
  const RowRecord then = row("uniform", good_errors(1000, 1));
  const Budgets present = measured_budgets({then}, 2000, 1);
  EXPECT_EQ(why_another_plan(present, {then}, 2000, 1), "");
  EXPECT_NE(why_another_plan(present, {row("uniform", good_errors(1, 1))}, 2, 1), "");
  EXPECT_NE(why_another_plan(present, {row("edges", good_errors(5, 1))}, 2, 1), "");
  EXPECT_NE(why_another_plan(present, {row("uniform", good_errors(1000, 2), 2)}, 2000, 2), "");
  EXPECT_NE(why_another_plan(present, {row("uniform", good_errors(2000, 1))}, 2000, 1), "")
      << "uniform alone gets all points";
}

TEST(SilentPasses, A4NothingBecomesLooserWithoutAReason) {
  const auto errors = hard_errors();
  const Budgets first = budgets_of(row("hard", errors));
  const auto loosened = [&](const std::vector<double>& now) {
    Budgets budgets = first;
    const auto raises = update_budgets(budgets, budgets_of(row("hard", now)), "");
    EXPECT_EQ(budgets == first, !raises.empty());
    return !raises.empty();
  };
  auto now = errors;
  now[3] = -1;  // a NaN
  EXPECT_TRUE(loosened(now));
  now = errors;
  now[3] = 20;  // one more beyond a power of two
  EXPECT_TRUE(loosened(now));
  now = errors;
  now.pop_back();
  EXPECT_TRUE(loosened(now)) << "a shorter list";
  now = errors;
  now.back() = HUGE_VAL;
  EXPECT_TRUE(loosened(now)) << "a limit that would go";
  now = errors;
  now.back() = 100000;
  EXPECT_FALSE(loosened(now));
}

TEST(SilentPasses, LostHardCasesAreNoImprovement) {
  const auto errors = hard_errors();
  const Budgets budgets = budgets_of(row("hard", errors));
  EXPECT_TRUE(has(judged(row("hard", good_errors(506, 1)), budgets), FindingKind::lost_cases));
  EXPECT_TRUE(has(judged(row("hard", {errors.begin() + 1, errors.end()}), budgets), FindingKind::lost_cases));
  auto more = errors;
  more.push_back(0.1);
  EXPECT_FALSE(has(judged(row("hard", more), budgets), FindingKind::lost_cases));
}

// A limit that was raised for another machine tells nothing about the cases of this one; a shorter list does.
TEST(SilentPasses, ALimitRaisedForAReasonNeedNotBeReached) {
  const auto errors = hard_errors();
  Budgets budgets = budgets_of(row("hard", errors));
  for (auto& [type, of_type] : budgets) {
    for (auto& [name, budget] : of_type.rows) budget.reason = "instructions of another processor";
  }
  EXPECT_FALSE(has(judged(row("hard", good_errors(errors.size(), 1)), budgets), FindingKind::lost_cases));
  EXPECT_TRUE(has(judged(row("hard", {errors.begin() + 1, errors.end()}), budgets), FindingKind::lost_cases));
}

TEST(Bounds, LieAboveTheMaximaByMoreWhereTheyScatterMore) {
  const double even = exceeded_by_no_seed(std::vector<double>{0.500, 0.501, 0.502, 0.501});
  EXPECT_GT(even, 0.502);
  EXPECT_LT(even, 0.55);
  EXPECT_GT(exceeded_by_no_seed(std::vector<double>{10, 20, 100, 15}), 1e4)
      << "errors that fall off like a power";
  EXPECT_EQ(exceeded_by_no_seed(std::vector<double>{0.5, 0.5, 0.5}), 0.5);
}

TEST(Limits, CountsAboveEdgesAndWinsorizedMeans) {
  UlpHistogram h;
  for (const double e : {0.0, 0.4, 1.0, 1.1, 3.0, 16.0, 17.0}) h.add({e});
  EXPECT_EQ(count_above(h, 0), 4U) << "1 itself is not above";
  EXPECT_EQ(count_above(h, 4), 1U);
  EXPECT_EQ(count_above_edge(h, 0), 6U);
  EXPECT_EQ(count_above_edge(h, UlpHistogram::upper_edge(4)), 3U);
  UlpHistogram two;
  two.exact = 1;
  two.add({100});
  EXPECT_EQ(winsorized_mean(two, 2).mean, 1);
  EXPECT_EQ(winsorized_mean(two, 2).variance, 1);
}

TEST(SilentPasses, A4AMeanOfCutErrorsRisesOnlyWithAReason) {
  Budgets present = budgets_of(row("uniform", good_errors(1000, 1)));
  Budgets measured = present;
  double& level = measured.at("double").rows.at("sin").winsorized_ulp.at("uniform");
  level *= 2;
  const double before = present.at("double").rows.at("sin").winsorized_ulp.at("uniform");
  const auto raises = update_budgets(present, measured, "");
  ASSERT_EQ(raises.size(), 1U);
  EXPECT_NE(raises[0].what.find("winsorized_ulp"), std::string::npos) << raises[0].what;
  EXPECT_EQ(present.at("double").rows.at("sin").winsorized_ulp.at("uniform"), before);
  (void)update_budgets(present, measured, "a better estimate");
  EXPECT_EQ(present.at("double").rows.at("sin").winsorized_ulp.at("uniform"), level);
}

TEST(SilentPasses, A13OnlyWhatIsExactForEverySeedIsBoundByNothing) {
  const std::vector<double> exact(1000, 0.0);
  const auto seeds_with = [&](double last) {
    std::vector<std::vector<RowRecord>> seeds;
    for (std::uint64_t s = 101; s <= 105; ++s) seeds.push_back({row("uniform", exact, s)});
    auto other = exact;
    other[500] = last;
    seeds.push_back({row("uniform", other, 106)});
    return seeds;
  };
  const auto bounds = [](const Budgets& b) { return b.at("double").rows.at("sin").bound_ulp; };
  Budgets budgets = budgets_of(row("uniform", exact));
  add_bounds(budgets, seeds_with(0));
  ASSERT_TRUE(bounds(budgets).contains("uniform"));
  EXPECT_EQ(bounds(budgets).at("uniform"), 0);
  budgets = budgets_of(row("uniform", exact));
  add_bounds(budgets, seeds_with(0.5));
  EXPECT_FALSE(bounds(budgets).contains("uniform")) << "one seed met an error";
  budgets = budgets_of(row("uniform", good_errors(1000, 1)));
  add_bounds(budgets, seeds_with(0));
  EXPECT_FALSE(bounds(budgets).contains("uniform")) << "the budget's own seed met errors";
}

TEST(SilentPasses, AFunctionsErrorOverConditionIsReproducedAtItsLargestError) {
  RowRecord r = row("uniform", good_errors(100, 1));
  const Budgets budgets = budgets_of(r);
  r.points.argmax = {"0x1p+0"};
  r.points.normwise_argmax = {"0x1p+1"};
  r.summary.max_error_over_condition += 1;
  const auto findings = judged(r, budgets);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].at, r.points.argmax);
}

}  // namespace
}  // namespace ulpgate
