// Tests of the budgets of scenes.
#include "harness/core/gate/scene_budgets.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ulpgate {
namespace {

SceneMeasurement run_of_double(double t_s, double energy) {
  return {"pendulum3", "double", "dt=1e-5 steps=100", t_s, energy, 2 * energy, "ulpgate scene run pendulum3"};
}

SceneBudgets budgets_of(const SceneMeasurement& m) {
  SceneBudgets budgets;
  EXPECT_TRUE(update_scene_budgets(budgets, {m}, "").empty());
  return budgets;
}

TEST(SceneBudgets, WhatWasMeasuredPasses) {
  const auto m = run_of_double(2.45, 5.49e-14);
  EXPECT_TRUE(judge_scenes({m}, budgets_of(m), MissingRecords::fail).empty());
}

TEST(SceneBudgets, AShorterTruthAndALargerErrorFailWorstFirst) {
  const auto budgets = budgets_of(run_of_double(2.45, 5e-14));
  EXPECT_TRUE(judge_scenes({run_of_double(2.35, 5e-14)}, budgets, MissingRecords::fail).empty());
  const auto found = judge_scenes({run_of_double(2.30, 5e-13)}, budgets, MissingRecords::fail);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_GT(found[0].severity, 9) << "the energy, ten times its measure";
  EXPECT_EQ(found[2].message, "true for 2.3 s, budget 2.45 s");
  for (const auto& f : found) {
    EXPECT_EQ(f.kind, FindingKind::regression);
    EXPECT_EQ(f.at, std::vector<std::string>{"ulpgate scene run pendulum3"});
  }
  EXPECT_EQ(judge_scenes({run_of_double(NAN, NAN)}, budgets, MissingRecords::fail).size(), 3U);
}

TEST(SceneBudgets, MissingRunsBudgetsAndColumns) {
  const auto m = run_of_double(2.45, 5e-14);
  const auto budgets = budgets_of(m);
  auto other = m;
  other.type = "float";
  const auto found = judge_scenes({other}, budgets, MissingRecords::fail);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].kind, FindingKind::missing_budget);
  EXPECT_EQ(found[1].kind, FindingKind::missing_record);
  EXPECT_EQ(judge_scenes({other}, budgets, MissingRecords::ignore).size(), 1U);
  auto bare = m;
  bare.t_s.reset();
  const auto incomplete = judge_scenes({bare}, budgets, MissingRecords::fail);
  ASSERT_EQ(incomplete.size(), 1U);
  EXPECT_EQ(incomplete[0].kind, FindingKind::incomplete);
}

TEST(SceneBudgets, NoCollisionMayMakeEnergyBeyondItsConditionWhateverTheBudget) {
  auto m = run_of_double(2.45, 5e-14);
  m.energy_created = 4e-9;
  const auto budgets = budgets_of(m);
  EXPECT_TRUE(judge_scenes({m}, budgets, MissingRecords::fail).empty());
  auto more = m;
  more.energy_created = 5e-9;
  const auto regressed = judge_scenes({more}, budgets, MissingRecords::fail);
  ASSERT_EQ(regressed.size(), 1U);
  EXPECT_EQ(regressed[0].message,
            "energy made in a collision 5e-09 of the pair's, budget 4.41e-09 of the pair's");
  auto beyond = m;
  beyond.collisions_beyond = 2;
  beyond.furthest_beyond = "bodies 0-1 from step 7";
  const auto found = judge_scenes({beyond}, budgets, MissingRecords::fail);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, FindingKind::regression);
  EXPECT_EQ(found[0].message,
            "2 collisions make energy beyond their condition, furthest bodies 0-1 from step 7");
  EXPECT_EQ(judge_scenes({beyond}, {}, MissingRecords::fail).size(), 2U) << "and no budget";
  auto unmeasured = m;
  unmeasured.energy_created.reset();
  const auto absent = judge_scenes({unmeasured}, budgets, MissingRecords::fail);
  ASSERT_EQ(absent.size(), 1U);
  EXPECT_EQ(absent[0].kind, FindingKind::incomplete);
}

TEST(SceneBudgets, LooserOnlyWithAReason) {
  auto budgets = budgets_of(run_of_double(2.45, 5e-14));
  const auto before = budgets;
  EXPECT_EQ(update_scene_budgets(budgets, {run_of_double(2.0, 9e-14)}, "").size(), 1U);
  EXPECT_EQ(budgets, before);
  EXPECT_TRUE(update_scene_budgets(budgets, {run_of_double(2.6, 1e-14)}, "").empty());
  EXPECT_EQ(budgets["pendulum3"]["double dt=1e-5 steps=100"].t_s, 2.6);
  EXPECT_EQ(update_scene_budgets(budgets, {run_of_double(2.0, 9e-14)}, "a coarser scene").size(), 1U);
  const SceneBudget& raised = budgets["pendulum3"]["double dt=1e-5 steps=100"];
  EXPECT_EQ(raised.t_s, 2.0);
  EXPECT_EQ(raised.max_energy_error, 9.91e-14) << "a tenth above, rounded up";
  EXPECT_EQ(raised.reason, "a coarser scene");
}

}  // namespace
}  // namespace ulpgate
