// Tests of the budgets of rows with figures: scenes first, then what all kinds share.
#include "harness/core/gate/figure_budgets.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ulpgate {
namespace {

MeasuredRow run_of_double(double t_s, double energy) {
  MeasuredRow m{RowKind::scene, "pendulum3", "double", "dt=1e-5 steps=100"};
  m.figures = {{"t_s", t_s}, {"max_energy_error", energy}, {"max_energy_error_raw", 2 * energy}};
  m.reproduce = "ulpgate scene run pendulum3";
  return m;
}

FigureBudgets budgets_of(const MeasuredRow& m) {
  FigureBudgets budgets;
  EXPECT_TRUE(update_figure_budgets(budgets, {m}, "").empty());
  return budgets;
}

TEST(FigureBudgets, WhatWasMeasuredPasses) {
  const auto m = run_of_double(2.45, 5.49e-14);
  EXPECT_TRUE(judge_figures({m}, budgets_of(m), MissingRecords::fail).empty());
}

TEST(FigureBudgets, AShorterTruthAndALargerErrorFailWorstFirst) {
  const auto budgets = budgets_of(run_of_double(2.45, 5e-14));
  EXPECT_TRUE(judge_figures({run_of_double(2.35, 5e-14)}, budgets, MissingRecords::fail).empty());
  const auto found = judge_figures({run_of_double(2.30, 5e-13)}, budgets, MissingRecords::fail);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_GT(found[0].severity, 9) << "the energy, ten times its measure";
  EXPECT_EQ(found[2].message, "true for 2.3 s, budget 2.45 s");
  for (const auto& f : found) {
    EXPECT_EQ(f.kind, FindingKind::regression);
    EXPECT_EQ(f.reproduce, "ulpgate scene run pendulum3");
    EXPECT_EQ(f.budget_key, "double dt=1e-5 steps=100");
  }
  EXPECT_EQ(judge_figures({run_of_double(NAN, NAN)}, budgets, MissingRecords::fail).size(), 3U);
}

TEST(FigureBudgets, MissingRunsBudgetsAndColumns) {
  const auto m = run_of_double(2.45, 5e-14);
  const auto budgets = budgets_of(m);
  auto other = m;
  other.type = "float";
  const auto found = judge_figures({other}, budgets, MissingRecords::fail);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].kind, FindingKind::missing_budget);
  EXPECT_EQ(found[1].kind, FindingKind::missing_record);
  EXPECT_EQ(judge_figures({other}, budgets, MissingRecords::ignore).size(), 1U);
  auto bare = m;
  bare.figures.erase("t_s");
  const auto incomplete = judge_figures({bare}, budgets, MissingRecords::fail);
  ASSERT_EQ(incomplete.size(), 1U);
  EXPECT_EQ(incomplete[0].kind, FindingKind::incomplete);
}

TEST(FigureBudgets, NoCollisionMayMakeEnergyBeyondItsConditionWhateverTheBudget) {
  auto m = run_of_double(2.45, 5e-14);
  m.figures["max_energy_created"] = 4e-9;
  const auto budgets = budgets_of(m);
  EXPECT_TRUE(judge_figures({m}, budgets, MissingRecords::fail).empty());
  auto more = m;
  more.figures["max_energy_created"] = 5e-9;
  const auto regressed = judge_figures({more}, budgets, MissingRecords::fail);
  ASSERT_EQ(regressed.size(), 1U);
  EXPECT_EQ(regressed[0].message,
            "energy made in a collision 5e-09 of the pair's, budget 4.41e-09 of the pair's");
  auto beyond = m;
  beyond.breach = "2 collisions make energy beyond their condition, furthest bodies 0-1 from step 7";
  const auto found = judge_figures({beyond}, budgets, MissingRecords::fail);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, FindingKind::regression);
  EXPECT_EQ(found[0].message,
            "2 collisions make energy beyond their condition, furthest bodies 0-1 from step 7");
  EXPECT_EQ(judge_figures({beyond}, {}, MissingRecords::fail).size(), 2U) << "and no budget";
  auto unmeasured = m;
  unmeasured.figures.erase("max_energy_created");
  const auto absent = judge_figures({unmeasured}, budgets, MissingRecords::fail);
  ASSERT_EQ(absent.size(), 1U);
  EXPECT_EQ(absent[0].kind, FindingKind::incomplete);
}

TEST(FigureBudgets, LooserOnlyWithAReason) {
  auto budgets = budgets_of(run_of_double(2.45, 5e-14));
  const auto before = budgets;
  EXPECT_EQ(update_figure_budgets(budgets, {run_of_double(2.0, 9e-14)}, "").size(), 1U);
  EXPECT_EQ(budgets, before);
  EXPECT_TRUE(update_figure_budgets(budgets, {run_of_double(2.6, 1e-14)}, "").empty());
  EXPECT_EQ(budgets["pendulum3"].rows["double dt=1e-5 steps=100"].limits["t_s"], 2.6);
  EXPECT_EQ(update_figure_budgets(budgets, {run_of_double(2.0, 9e-14)}, "a coarser scene").size(), 1U);
  FigureBudget& raised = budgets["pendulum3"].rows["double dt=1e-5 steps=100"];
  EXPECT_EQ(raised.limits["t_s"], 2.0);
  EXPECT_EQ(raised.limits["max_energy_error"], 9.91e-14) << "a tenth above, rounded up";
  EXPECT_EQ(raised.reason, "a coarser scene");
}

TEST(FigureBudgets, CollisionsThatTheEndCutsOffAreCounted) {
  auto m = run_of_double(2.45, 5e-14);
  const auto without = budgets_of(m);
  m.figures["still_open"] = 3;
  const auto unknown = judge_figures({m}, without, MissingRecords::fail);
  ASSERT_EQ(unknown.size(), 1U) << "nobody said how many may be";
  EXPECT_EQ(unknown[0].kind, FindingKind::missing_budget);
  const auto budgets = budgets_of(m);
  EXPECT_TRUE(judge_figures({m}, budgets, MissingRecords::fail).empty());
  m.figures["still_open"] = 4;
  const auto more = judge_figures({m}, budgets, MissingRecords::fail);
  ASSERT_EQ(more.size(), 1U);
  EXPECT_EQ(more[0].kind, FindingKind::regression);
}

MeasuredRow refused_case() {
  MeasuredRow m{RowKind::stress, "formula", "float", "rump_1988/naive"};
  m.outcome = "refused";
  return m;
}

TEST(FigureBudgets, AnOutcomeIsHeldAsItIs) {
  const auto budgets = budgets_of(refused_case());
  EXPECT_TRUE(judge_figures({refused_case()}, budgets, MissingRecords::fail).empty());
  for (const char* other : {"stable", "diverged", ""}) {
    auto now = refused_case();
    now.outcome = other;
    const auto found = judge_figures({now}, budgets, MissingRecords::fail);
    ASSERT_EQ(found.size(), 1U) << other;
    EXPECT_EQ(found[0].kind, FindingKind::regression);
    auto present = budgets;
    EXPECT_EQ(update_figure_budgets(present, {now}, "").size(), 1U);
    EXPECT_EQ(present, budgets) << "another outcome needs a reason";
  }
}

TEST(FigureBudgets, AnOrderIsALeastValueAndAnErrorAGreatestOne) {
  MeasuredRow m{RowKind::order, "kepler", "double", "rk4"};
  m.figures = {{"measured_order", 4.01}, {"least_error", 1e-13}};
  const auto budgets = budgets_of(m);
  m.figures["measured_order"] = 3.97;
  EXPECT_TRUE(judge_figures({m}, budgets, MissingRecords::fail).empty()) << "within the allowance";
  m.figures["measured_order"] = 3.5;
  ASSERT_EQ(judge_figures({m}, budgets, MissingRecords::fail).size(), 1U);
  m.figures.erase("measured_order");
  EXPECT_EQ(judge_figures({m}, budgets, MissingRecords::fail)[0].kind, FindingKind::incomplete);
}

TEST(FigureBudgets, TheRatchetLowersWhatIsAboveTwiceTheMeasuredAndNothingElse) {
  const auto loose = budgets_of(run_of_double(2.45, 5e-14));
  const auto better = run_of_double(2.45, 1e-14);
  const auto notes = judge_figures({better}, loose, MissingRecords::fail);
  ASSERT_EQ(notes.size(), 2U);
  for (const auto& f : notes) EXPECT_EQ(f.kind, FindingKind::could_lower);
  auto tight = loose;
  EXPECT_EQ(tighten_figure_budgets(tight, {better}).size(), 1U);
  auto& row = tight["pendulum3"].rows["double dt=1e-5 steps=100"];
  EXPECT_EQ(row.limits["max_energy_error"], 1.1e-14);
  EXPECT_EQ(row.limits["t_s"], 2.45);
  const auto once = tight;
  EXPECT_TRUE(tighten_figure_budgets(tight, {run_of_double(2.0, 9e-14)}).empty()) << "never looser";
  EXPECT_TRUE(tighten_figure_budgets(tight, {run_of_double(NAN, NAN)}).empty());
  EXPECT_EQ(tight, once);
  auto raised = loose;
  raised["pendulum3"].rows.begin()->second.reason = "another C library";
  EXPECT_TRUE(tighten_figure_budgets(raised, {better}).empty())
      << "what it was raised for need not show here";
}

}  // namespace
}  // namespace ulpgate
