// Tests of digests: other results are told where no limit is exceeded.
#include "harness/core/gate/digest.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/core/gate/figure_budgets.hpp"
#include "harness/core/gate/platform_rows.hpp"

namespace ulpgate {
namespace {

RowRecord record(const std::vector<double>& errors, const std::string& stratum = "uniform",
                 const std::string& type = "double") {
  RowRecord r;
  r.subject = "contact_force";
  r.subject_class = kernel_class;
  r.part = "value";
  r.type = type;
  r.stratum = stratum;
  r.planned = errors.size();
  r.seed = 1;
  for (std::uint64_t k = 0; k < errors.size(); ++k) r.summary.add({Outcome::finite, {errors[k]}, 0, true}, k);
  r.summary.max_error_over_condition = 1;
  return r;
}
Budgets budgets_of(const std::vector<RowRecord>& records) {
  return measured_budgets(records, records.front().planned, 1);
}
const std::vector<double> errors = {0.4, 0.1, 0.9, 0.3};
// No error is larger, and the largest is at the same point.
const std::vector<double> others = {0.1, 0.1, 0.9, 0.3};

TEST(Digest, OtherResultsWithinEveryLimitAreToldOncePerRow) {
  const auto budgets = budgets_of({record(errors), record(errors, "far"), record(errors, "cone")});
  EXPECT_TRUE(judge_records({record(errors), record(errors, "far"), record(errors, "cone")}, budgets,
                            MissingRecords::fail)
                  .empty());
  const auto findings = judge_records({record(errors, "cone"), record(others), record(others, "far")},
                                      budgets, MissingRecords::fail);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].kind, FindingKind::other_results);
  EXPECT_TRUE(findings[0].message.ends_with("in uniform, far")) << findings[0].message;
  EXPECT_EQ(findings[0].row, "contact_force");
  EXPECT_FALSE(findings[0].reproduce.empty());
}

TEST(Digest, ARegressionComesFirst) {
  const auto findings =
      judge_records({record({0.4, 0.1, 5, 0.3})}, budgets_of({record(errors)}), MissingRecords::fail);
  ASSERT_GE(findings.size(), 2U);
  EXPECT_EQ(findings.front().kind, FindingKind::regression);
  EXPECT_EQ(findings.back().kind, FindingKind::other_results);
}

TEST(Digest, IsOfPointsNotOfTheOrderInWhichTheyCame) {
  const auto whole = record(errors);
  RowRecord first = record({errors[0], errors[1]});
  RowRecord second = record({});
  for (std::uint64_t k = 2; k < 4; ++k) second.summary.add({Outcome::finite, {errors[k]}, 0, true}, k);
  second.summary.merge(first.summary);
  EXPECT_EQ(results_digest(second), results_digest(whole));
  EXPECT_NE(results_digest(record(others)), results_digest(whole));
}

TEST(Digest, OtherPointsHaveNone) {
  const auto budgets = budgets_of({record(errors)});
  RowRecord other = record(others);
  other.seed = 2;
  for (const auto& f : judge_records({other}, budgets, MissingRecords::ignore, {true, 1}))
    EXPECT_NE(f.kind, FindingKind::other_results) << f.message;
}

TEST(Digest, IsKeptOfKernelsInTypesThatEveryProcessorComputesAlike) {
  RowRecord function = record(errors);
  function.subject_class = "real";
  EXPECT_TRUE(budgets_of({function}).at("double").rows.at("contact_force").digest.empty());
  for (const char* type : {"float", "double", "float128", "mpfr62", "mpfr150"})
    EXPECT_EQ(budgets_of({record(errors, "far", type)}).at(type).rows.at("contact_force").digest.size(), 1U);
  for (const char* type : {"long_double", "cpp_bin_float62"})
    EXPECT_TRUE(budgets_of({record(errors, "far", type)}).at(type).rows.at("contact_force").digest.empty());
}

TEST(Digest, OfSmallerErrorsComesFreelyOfLargerOnesWithAReason) {
  auto budgets = budgets_of({record(errors)});
  const auto digest = [&] { return budgets.at("double").rows.at("contact_force").digest.at("uniform"); };
  EXPECT_TRUE(update_budgets(budgets, budgets_of({record(others)}), "").empty());
  EXPECT_EQ(digest(), results_digest(record(others)));
  EXPECT_EQ(update_budgets(budgets, budgets_of({record(errors)}), "").size(), 1U);
  EXPECT_EQ(digest(), results_digest(record(others)));
  EXPECT_EQ(update_budgets(budgets, budgets_of({record(errors)}), "another law").size(), 1U);
  EXPECT_EQ(digest(), results_digest(record(errors)));
}

TEST(Digest, IsThePlatformsOwn) {
  auto budgets = budgets_of({record(errors)});
  const auto found = platform_rows(budgets, budgets_of({record(others)}), {record(others)}, "elsewhere");
  ASSERT_EQ(found.changes.size(), 1U);
  EXPECT_TRUE(judge_records({record(others)}, overlaid(budgets, found.rows), MissingRecords::fail).empty());
  forget_digests(budgets);
  EXPECT_TRUE(judge_records({record(others)}, budgets, MissingRecords::ignore).empty());
}

MeasuredRow scene_of(const std::string& digest) {
  MeasuredRow m{RowKind::scene, "packing", "float", "leapfrog dt=1e-5 steps=100"};
  m.figures = {{"max_energy_error", 1e-6}};
  m.digest = digest;
  return m;
}

TEST(Digest, OfAFinalStateIsHeldAsItIs) {
  FigureBudgets budgets;
  EXPECT_TRUE(update_figure_budgets(budgets, {scene_of("0123")}, "").empty());
  EXPECT_TRUE(judge_figures({scene_of("0123")}, budgets, MissingRecords::fail).empty());
  const auto other = judge_figures({scene_of("4567")}, budgets, MissingRecords::fail);
  ASSERT_EQ(other.size(), 1U);
  EXPECT_EQ(other[0].kind, FindingKind::other_results);
  EXPECT_EQ(other[0].got, "4567");
  EXPECT_EQ(other[0].wanted, "0123");
  const auto none = judge_figures({scene_of("")}, budgets, MissingRecords::fail);
  ASSERT_EQ(none.size(), 1U);
  EXPECT_EQ(none[0].kind, FindingKind::incomplete);
  const auto found = platform_rows(budgets, {scene_of("4567")}, "elsewhere");
  EXPECT_TRUE(judge_figures({scene_of("4567")}, overlaid(budgets, found.rows), MissingRecords::fail).empty());
  EXPECT_TRUE(update_figure_budgets(budgets, {scene_of("4567")}, "").empty()) << "with no looser limit";
  EXPECT_TRUE(judge_figures({scene_of("4567")}, budgets, MissingRecords::fail).empty());
  forget_digests(budgets);
  EXPECT_TRUE(judge_figures({scene_of("89ab")}, budgets, MissingRecords::fail).empty());
}

}  // namespace
}  // namespace ulpgate
