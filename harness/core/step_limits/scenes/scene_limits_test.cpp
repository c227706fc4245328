// Measured limits of scenes against their contacts, and the rules against both.
#include "harness/core/step_limits/scenes/scene_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "harness/core/step_limits/step_limits.hpp"

namespace ulpgate {
namespace {

std::vector<StressCase> named(std::string_view name) {
  std::vector<StressCase> list;
  for (StressCase& c : scene_limit_cases()) {
    if (c.name == name) list.push_back(std::move(c));
  }
  return list;
}

TEST(SceneLimits, AreThoseOfTheirContactsInEveryStiffness) {
  const std::vector<StressCase> rods = named("rod_pendulum");
  ASSERT_EQ(rods.size(), 11U);
  for (const StressCase& c : rods) {
    for (const char* token : {"float", "double", "mpfr62"}) {
      const std::optional<StressRow> row = c.run(token, {});
      ASSERT_TRUE(row) << c.key();
      EXPECT_EQ(row->verdict, StressVerdict::stable) << c.key() << " " << token << ": " << row->why;
      EXPECT_NEAR(row->figures.at("limit_over_theory"), 1, 0.002) << c.key() << " " << token;
      EXPECT_NEAR(row->figures.at("growth_at_1.01_limit"), 1.32658, 0.003) << c.key() << " " << token;
    }
  }
  // The chain's largest eigenvalue is (2 sin(5 pi/14))^2 k/m.
  const StressRow row = *rods[3].run("double", {});
  const double mass = 4.0 / 3 * 3.14159265358979323846 * 1e-9 * 10;
  EXPECT_NEAR(row.figures.at("omega_max"),
              2 * std::sin(5 * 3.14159265358979323846 / 14) * std::sqrt(100 / mass), 1e-3);
}

TEST(SceneLimits, OfDampedContactsFallWithTheDamping) {
  const double restitutions[] = {1, 0.8, 0.3, 0.003};
  const std::vector<StressCase> contacts = named("damped_contact");
  ASSERT_EQ(contacts.size(), 4U);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const double ln = -std::log(restitutions[i]);
    const double square = (9.869604401089358 + ln * ln) / 2;
    const double zeta = ln / (2 * std::sqrt(square));
    for (const char* token : {"float", "double"}) {
      const StressRow row = *contacts[i].run(token, {});
      const double z = row.figures.at("limit") * row.figures.at("omega_max");
      EXPECT_NEAR(row.figures.at("omega_max"), std::sqrt(square) * 1e3, 0.01) << contacts[i].key();
      EXPECT_NEAR(z / (2 * (std::sqrt(1 + zeta * zeta) - zeta)), 1, 0.005)
          << contacts[i].key() << " " << token;
      EXPECT_NEAR(row.figures.at("growth_at_1.01_limit"), row.figures.at("growth_at_1.01_limit_theory"),
                  0.003)
          << contacts[i].key() << " " << token;
    }
  }
}

TEST(SceneLimits, OfPackingsDoNotDependOnTheirOrientation) {
  std::map<std::string, std::set<long>> limits;
  for (const StressCase& c : named("packing")) {
    const StressRow row = *c.run("double", {});
    EXPECT_EQ(row.verdict, StressVerdict::stable) << c.key() << ": " << row.why;
    limits[c.form.substr(0, c.form.find('_'))].insert(std::lround(row.figures.at("theory") * 1e12));
  }
  EXPECT_EQ(limits.size(), 4U);
  for (const auto& [lattice, steps] : limits) EXPECT_EQ(steps.size(), 1U) << lattice;
}

// A rule above the limit is a wrong outcome, and no other is; runs of the scene agree on which side it is.
TEST(SceneLimits, JudgeTheRules) {
  std::map<std::string, double> limits;
  for (const StressCase& c : named("packing")) limits[c.form] = c.run("double", {})->figures.at("limit");
  for (const char* rule : {"p_wave_rule", "rayleigh_rule", "stiffness_rule"}) {
    for (const StressCase& c : named(rule)) {
      const StressRow row = *c.run("double", {});
      if (row.verdict == StressVerdict::refused) {
        EXPECT_TRUE(standing_of(c, "double", row).as_known) << c.key() << ": " << row.why;
        continue;
      }
      const double over = row.figures.at("rule_over_limit");
      EXPECT_EQ(row.verdict == StressVerdict::wrong_outcome, over > 1) << c.key();
      EXPECT_LE(row.figures.at("block_bound_over_limit"), 1 + 1e-9) << c.key();
      if (limits.contains(c.form) && std::abs(over - 1) > 0.02) {
        EXPECT_EQ(row.figures.at("rule") > limits.at(c.form), over > 1) << c.key();
      }
    }
  }
}

TEST(SceneLimits, ScanForResonances) {
  const std::vector<StressCase> scans = named("resonances");
  ASSERT_EQ(scans.size(), 1U);
  const StressRow row = *scans[0].run("double", {});
  // The error of the leapfrog falls with the square of the step.
  EXPECT_NEAR(row.figures.at("energy_error_at_0.2") / row.figures.at("energy_error_at_0.1"), 4, 0.1);
  EXPECT_GE(row.figures.at("resonances"), 1);
  EXPECT_GT(row.figures.at("resonance_1_z"), 1.4);
  EXPECT_GE(row.figures.at("resonance_1_ratio"), 10);
}

TEST(SceneLimits, StopWhenTold) {
  const std::atomic<bool> raised = true;
  EXPECT_THROW((void)named("packing").front().run("double", ode::StopFlag(raised)), ode::Stopped);
}

TEST(StepLimits, AreNamedOnce) {
  std::set<std::string> keys;
  for (const StressCase& c : step_limit_cases()) {
    EXPECT_EQ(c.kind, "step_limit");
    EXPECT_TRUE(keys.insert(c.key()).second) << c.key();
    EXPECT_FALSE(c.title.empty()) << c.key();
  }
}

}  // namespace
}  // namespace ulpgate
