// Tests of the ratchet over samples and of the rows that a platform lays over the base.
#include "harness/core/gate/platform_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ulpgate {
namespace {

RowRecord record(const std::string& function, double ulp, const std::string& stratum = "uniform") {
  RowRecord r;
  r.subject = function;
  r.part = "value";
  r.type = "double";
  r.stratum = stratum;
  r.planned = 10;
  r.seed = 1;
  for (std::uint64_t k = 0; k < 10; ++k) r.summary.add({Outcome::finite, {ulp}, 0, true}, k);
  r.points.argmax = {"0x1.8p+0"};
  r.points.got = "0x1p-1";
  r.points.exact = "0x1.1p-1";
  return r;
}

Budgets budgets_of(const std::vector<RowRecord>& records) {
  return measured_budgets(records, 20, 1);
}

TEST(Ratchet, LowersDrawnStrataOfTheSamePlanOnly) {
  const Budgets loose = budgets_of({record("sin", 2), record("sin", 50, "hard"), record("cos", 0.6)});
  Budgets tight = loose;
  const std::vector<RowRecord> better = {record("sin", 0.5), record("sin", 5, "hard"), record("cos", 0.5)};
  const auto changes = tighten_budgets(tight, better);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].row, "sin");
  Budget& sin = tight["double"].rows["sin"];
  EXPECT_EQ(sin.max_ulp["uniform"], 0.5);
  EXPECT_EQ(sin.max_ulp["hard"], 50) << "a list may have lost its cases";
  EXPECT_EQ(tight["double"].rows["cos"], loose.at("double").rows.at("cos")) << "not above twice";
  const Budgets once = tight;
  EXPECT_TRUE(tighten_budgets(tight, {record("sin", 9)}).empty()) << "never looser";
  RowRecord other = record("sin", 0.1);
  other.seed = 2;
  EXPECT_TRUE(tighten_budgets(tight, {other}).empty()) << "points of another plan";
  RowRecord none = record("sin", 0.1);
  none.summary.max_error.value = NAN;
  none.summary.max_error_over_condition = NAN;
  const auto of_none = tighten_budgets(tight, {none});
  EXPECT_EQ(tight["double"].rows["sin"].max_ulp["uniform"], 0.5);
  Budgets raised = loose;
  raised["double"].rows["sin"].reason = "x87 of another processor";
  EXPECT_TRUE(tighten_budgets(raised, better).empty());
}

TEST(Gate, AFindingCarriesAllThatAnOutputShows) {
  const auto found =
      judge_records({record("sin", 3)}, budgets_of({record("sin", 0.5)}), MissingRecords::fail);
  ASSERT_FALSE(found.empty());
  const auto maximum =
      std::ranges::find_if(found, [](const auto& f) { return f.what.starts_with("maximum"); });
  ASSERT_NE(maximum, found.end());
  EXPECT_EQ(maximum->of, RowKind::function);
  EXPECT_EQ(maximum->stratum, "uniform");
  EXPECT_EQ(maximum->measured, 3);
  EXPECT_EQ(maximum->budget, 0.5);
  EXPECT_EQ(maximum->got, "0x1p-1");
  EXPECT_EQ(maximum->wanted, "0x1.1p-1");
  EXPECT_EQ(maximum->reproduce, "ulpgate at sin double 0x1.8p+0");
  EXPECT_EQ(
      maximum->again,
      "ulpgate math --functions sin --types double --strata uniform,stratified --samples 20 --seed 1 --out "
      "reproduced --overwrite");
  const auto rows = judged_rows({record("sin", 3)}, budgets_of({record("sin", 0.5)}));
  ASSERT_EQ(rows.size(), 1U);
  // The largest of all limits: of the percentile, whose bucket ends at 2^(7/4).
  ASSERT_TRUE(rows[0].ratio);
  EXPECT_NEAR(*rows[0].ratio, std::exp2(1.75) / 0.5, 1e-12);
}

TEST(Gate, NumbersAreShownInBothBases) {
  EXPECT_EQ(with_decimal("0x1.8p+0"), "0x1.8p+0 (1.5)");
  EXPECT_EQ(with_decimal("-0x1p-1074"), "-0x1p-1074 (-4.9406564584124654e-324)");
  for (const char* text : {"nan", "inf", "", "a value", "0x1.8p+0 J", "1.25e-01"})
    EXPECT_EQ(with_decimal(text), text);
}

TEST(PlatformRows, HoldOnlyWhatTheBaseDoesNot) {
  const Budgets base = budgets_of({record("sin", 0.5), record("cos", 0.5), record("tan", 900, "hard")});
  // One is worse, one as it was, one list so good that its cases would count as lost, one is new.
  const std::vector<RowRecord> here = {record("sin", 0.8), record("cos", 0.4), record("tan", 1, "hard"),
                                       record("exp", 0.5)};
  const auto found = platform_rows(base, budgets_of(here), here, "as measured there");
  const auto& rows = found.rows.at("double").rows;
  EXPECT_EQ(rows.size(), 3U);
  EXPECT_FALSE(rows.contains("cos"));
  EXPECT_EQ(rows.at("sin").max_ulp.at("uniform"), 0.8);
  EXPECT_EQ(rows.at("sin").reason, "as measured there");
  EXPECT_EQ(found.changes.size(), 3U);
  const Budgets held = overlaid(base, found.rows);
  EXPECT_TRUE(judge_records(here, held, MissingRecords::fail).empty());
  EXPECT_TRUE(platform_rows(held, budgets_of(here), here, "again").rows.empty());
  EXPECT_FALSE(judge_records(here, base, MissingRecords::fail).empty()) << "the base is as it was";
}

TEST(PlatformRows, OfFiguresKeepTheLimitsThatHold) {
  MeasuredRow m{RowKind::scene, "pendulum3", "double", "leapfrog"};
  m.figures = {{"t_s", 2.45}, {"max_energy_error", 1e-14}};
  FigureBudgets base;
  EXPECT_TRUE(update_figure_budgets(base, {m}, "").empty());
  m.figures = {{"t_s", 2.0}, {"max_energy_error", 0.9e-14}};
  const auto found = platform_rows(base, {m}, "as measured there");
  ASSERT_EQ(found.rows.size(), 1U);
  const FigureBudget& row = found.rows.at("pendulum3").rows.at("double leapfrog");
  EXPECT_EQ(row.limits.at("t_s"), 2.0);
  EXPECT_EQ(row.limits.at("max_energy_error"), 1.1e-14);
  EXPECT_TRUE(judge_figures({m}, overlaid(base, found.rows), MissingRecords::fail).empty());
}

}  // namespace
}  // namespace ulpgate
