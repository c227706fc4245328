// Tests of budgets of kernels: limits of the normwise error over the condition, beside those in ULP.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/core/gate/budgets.hpp"

namespace ulpgate {
namespace {

RowRecord kernel_record(double ulp, double over_condition, const std::string& stratum = "uniform") {
  RowRecord r;
  r.subject = "sphere_sphere";
  r.subject_class = kernel_class;
  r.part = "value";
  r.type = "double";
  r.stratum = stratum;
  r.planned = 10;
  r.seed = 1;
  for (std::uint64_t k = 0; k < 10; ++k) r.summary.add({Outcome::finite, {ulp}, 0, true}, k);
  r.summary.max_error_over_condition = over_condition;
  r.points.argmax = {"0x1p+0"};
  r.points.normwise_argmax = {"0x1p+1"};
  return r;
}

Budgets budgets_of(const std::vector<RowRecord>& records) {
  return measured_budgets(records, 10, 1);
}

std::vector<FindingKind> kinds(const std::vector<GateFinding>& findings) {
  std::vector<FindingKind> out;
  out.reserve(findings.size());
  for (const auto& f : findings) out.push_back(f.kind);
  return out;
}
using Kinds = std::vector<FindingKind>;

double limit_over_condition(const Budgets& budgets, const std::string& stratum = "uniform") {
  return budgets.at("double").rows.at("sphere_sphere").over_condition.at(stratum);
}

TEST(KernelBudgets, HoldTheErrorOverConditionBesideTheUlps) {
  const auto budgets = budgets_of({kernel_record(2, 0.7)});
  EXPECT_TRUE(judge_records({kernel_record(2, 0.7)}, budgets, MissingRecords::fail).empty());
  EXPECT_EQ(kinds(judge_records({kernel_record(1.5, 0.6)}, budgets, MissingRecords::fail)),
            Kinds{FindingKind::other_results})
      << "within both limits";
  const auto findings = judge_records({kernel_record(2, 0.75)}, budgets, MissingRecords::fail);
  ASSERT_EQ(kinds(findings), Kinds{FindingKind::regression}) << "the ULPs are the same";
  EXPECT_EQ(findings[0].at, std::vector<std::string>{"0x1p+1"})
      << "the state of this error, not of the other";
  EXPECT_NEAR(findings[0].severity, 0.75 / 0.7, 1e-12);
  EXPECT_EQ(kinds(judge_records({kernel_record(2, NAN)}, budgets, MissingRecords::fail)),
            Kinds{FindingKind::regression});
  const auto both = judge_records({kernel_record(2.1, 0.75)}, budgets, MissingRecords::fail);
  for (const char* words : {"maximum error", "error over condition"}) {
    EXPECT_TRUE(std::ranges::any_of(both, [&](const auto& f) {
      return f.kind == FindingKind::regression && f.message.starts_with(words);
    })) << words;
  }
}

TEST(KernelBudgets, OverConditionFallsFreelyAndRisesWithAReasonOnly) {
  auto budgets = budgets_of({kernel_record(2, 0.7)});
  EXPECT_EQ(limit_over_condition(budgets), 0.7);
  EXPECT_TRUE(update_budgets(budgets, budgets_of({kernel_record(2, 0.7)}), "").empty()) << "as it was";
  EXPECT_TRUE(update_budgets(budgets, budgets_of({kernel_record(2, 0.6)}), "").empty());
  EXPECT_EQ(limit_over_condition(budgets), 0.6);
  EXPECT_EQ(update_budgets(budgets, budgets_of({kernel_record(2, 0.65)}), "").size(), 1U);
  EXPECT_EQ(limit_over_condition(budgets), 0.6);
  const auto raises = update_budgets(budgets, budgets_of({kernel_record(2, 0.65)}), "another law");
  ASSERT_EQ(raises.size(), 1U);
  EXPECT_NE(raises[0].what.find("over_condition"), std::string::npos) << raises[0].what;
  EXPECT_EQ(limit_over_condition(budgets), 0.65);
  // A stratum that was never measured has no limit that could rise.
  EXPECT_TRUE(update_budgets(budgets, budgets_of({kernel_record(3, 0.9, "edges")}), "").empty());
  EXPECT_EQ(limit_over_condition(budgets, "edges"), 0.9);
  EXPECT_EQ(limit_over_condition(budgets), 0.65);
}

// A thousand times the points meet what no seed of the budget's size did.  Of kernels it is another error,
// which no bound in ULP holds.
TEST(KernelBudgets, OfFunctionsTheBoundOverConditionIsOfRunsThatAreNoLarger) {
  auto budgets = budgets_of({kernel_record(2, 0.7)});
  Budget& budget = budgets.at("double").rows.at("sphere_sphere");
  budget.bound_ulp["uniform"] = 4;
  budget.bound_over_condition["uniform"] = 0.8;
  RowRecord other = kernel_record(2, 0.9);
  other.seed = 2;
  const auto judged = [&] {
    return kinds(judge_records({other}, budgets, MissingRecords::ignore, {true, 1}));
  };
  EXPECT_EQ(judged(), Kinds{FindingKind::regression});
  other.planned = 20;
  for (std::uint64_t k = 10; k < 20; ++k) other.summary.add({Outcome::finite, {2}, 0, true}, k);
  EXPECT_EQ(judged(), Kinds{FindingKind::regression}) << "of a kernel";
  other.subject_class = "real";
  EXPECT_EQ(judged(), Kinds{});
  other.summary.add({Outcome::finite, {5}, 0, true}, 20);
  other.planned = 21;
  EXPECT_FALSE(judged().empty()) << "the error itself is held";
}

TEST(KernelBudgets, FunctionsHaveTheLimitOverConditionToo) {
  RowRecord function = kernel_record(2, 0.7);
  function.subject_class = "real";
  EXPECT_EQ(limit_over_condition(budgets_of({function})), 0.7);
}

TEST(KernelBudgets, AreTheLeastNumbersOfThreeDigits) {
  const auto limit = [](double x) { return limit_over_condition(budgets_of({kernel_record(2, x)})); };
  EXPECT_EQ(limit(0.51234), 0.513);
  EXPECT_EQ(limit(0.513), 0.513);
  EXPECT_EQ(limit(0.5130001), 0.514);
  EXPECT_EQ(limit(9.991), 10);
  EXPECT_EQ(limit(123456), 124000);
  EXPECT_EQ(limit(0), 0);
}

}  // namespace
}  // namespace ulpgate
