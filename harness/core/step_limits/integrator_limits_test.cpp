// Limits of the integrators: theory against the numbers computed elsewhere, measured steps against both.
#include "harness/core/step_limits/integrator_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/core/step_limits/iteration_theory.hpp"
#include "harness/core/step_limits/stability_theory.hpp"
#include "harness/core/step_limits/stable_set.hpp"
#include "kernels/ode/integrators/integrators.hpp"

namespace ulpgate {
namespace {

double tiny(double) {
  return 1e-28;
}

double figure(const StressRow& row, const std::string& name) {
  const auto found = row.figures.find(name);
  return found == row.figures.end() ? std::nan("") : found->second;
}

StressRow measured(const char* token, LinearProblem problem, std::string_view integrator) {
  const StabilityEngine* engine = find_stability_engine(token);
  EXPECT_NE(engine, nullptr) << token;
  return engine == nullptr ? StressRow{} : measure_step_limit(*engine, problem, integrator, {});
}

TEST(StabilityTheory, HasTheKnownLimits) {
  int checked = 0;
  for (const ode::IntegratorInfo& info : ode::integrators()) {
    const KnownLimit* known = known_limit(info.name);
    if (known == nullptr) continue;
    const auto theory = stability_theory(info.name);
    ASSERT_NE(theory, nullptr) << info.name;
    const StableSet oscillator =
        find_stable_set([&](double z) { return theory->oscillator_excess(z); }, tiny, 12, 0.02);
    EXPECT_NEAR(oscillator.limit().value_or(HUGE_VAL), known->oscillator.value_or(0), 6e-7) << info.name;
    if (known->decay) {
      const StableSet decay =
          find_stable_set([&](double z) { return *theory->decay_excess(z); }, tiny, 12, 0.02);
      EXPECT_NEAR(decay.limit().value_or(HUGE_VAL), *known->decay, 6e-7) << info.name;
    }
    ++checked;
  }
  EXPECT_GE(checked, 15);
}

// The half traces 1 - z^2/2 + z^4/24 - 7 z^6/3456 and 1 - z^2/2 - 637 z^4/5184 - 7 z^6/3456, written out.
TEST(StabilityTheory, OfRuthDependsOnTheArrangementOfHisCoefficients) {
  const auto own = stability_theory("ruth3");
  const auto other = theory_of_other_arrangement("ruth3");
  ASSERT_NE(own, nullptr);
  ASSERT_NE(other, nullptr);
  for (double z = 0.1; z < 4; z += 0.1) {
    const double w = z * z;
    const double common = 1 - w / 2 - 7 * w * w * w / 3456;
    EXPECT_NEAR(own->oscillator_excess(z), std::abs(common + w * w / 24) - 1, 1e-12) << z;
    EXPECT_NEAR(other->oscillator_excess(z), std::abs(common - 637 * w * w / 5184) - 1, 1e-12) << z;
  }
  const auto limit = [](const StabilityTheory& t) {
    return find_stable_set([&](double z) { return t.oscillator_excess(z); }, tiny, 12, 0.02).limit();
  };
  EXPECT_NEAR(limit(*own).value_or(0), 2.507481, 1e-6);
  EXPECT_NEAR(limit(*other).value_or(0), 1.567387, 1e-6);
  EXPECT_EQ(own->oscillator_order(), 3);
  EXPECT_EQ(other->oscillator_order(), 1);
  EXPECT_EQ(stability_theory("yoshida8")->oscillator_order(), 8);
  EXPECT_EQ(other_arrangement("yoshida8"), nullptr);
  EXPECT_EQ(theory_of_other_arrangement("rk4"), nullptr);
}

TEST(MeasuredLimit, OfRuthIsToldBesideThePrintedOne) {
  const StressRow row = measured("double", LinearProblem::oscillator, "ruth3");
  EXPECT_EQ(row.verdict, StressVerdict::stable) << row.why;
  EXPECT_NEAR(figure(row, "limit"), 2.507481, 1e-6);
  EXPECT_NEAR(figure(row, "other_arrangement_limit"), 1.567387, 1e-6);
  EXPECT_EQ(figure(row, "order"), 3);
  EXPECT_EQ(figure(row, "other_arrangement_order"), 1);
  EXPECT_NE(row.why.find("1.567387"), std::string::npos) << row.why;
}

// A-stable: below 1 on the whole real axis, not above 1 on the imaginary one; Radau vanishes at infinity and
// Gauss does not.
TEST(StabilityTheory, OfImplicitMethodsHasNoLimit) {
  for (const char* name : {"gauss1", "gauss4", "gauss10", "radau3", "radau9", "rodas3"}) {
    const auto theory = stability_theory(name);
    ASSERT_NE(theory, nullptr) << name;
    for (double z = 0.01; z < 1e4; z *= 1.3) {
      EXPECT_LT(*theory->decay_excess(z), 0) << name << " " << z;
      EXPECT_LE(theory->oscillator_excess(z), 0) << name << " " << z;
    }
    const bool l_stable = std::string_view(name).starts_with("gauss") == false;
    EXPECT_EQ(*theory->decay_excess(1e9) < -0.999, l_stable) << name;
  }
}

TEST(StabilityTheory, SweepsOverStagesConvergeForLessThanIterationOfAllAtOnce) {
  // One stage: k = mu (y + k/2) either way.
  EXPECT_NEAR(sweep_limit(1, Axis::imaginary, 1), 2, 1e-8);
  EXPECT_NEAR(sweep_limit(1, Axis::real, 1), 2, 1e-8);
  // Of two stages a conjugate pair, whose product is 1/12.
  EXPECT_NEAR(jacobi_limit(2), std::sqrt(12.0), 1e-12);
  const double all_at_once[] = {2, 3.46, 4.64, 6.05, 7.29};
  for (int stages = 1; stages <= 5; ++stages) {
    EXPECT_NEAR(jacobi_limit(stages), all_at_once[stages - 1], 0.006);
    EXPECT_LE(sweep_limit(stages, Axis::imaginary, 1), jacobi_limit(stages) + 1e-8);
    EXPECT_LE(sweep_limit(stages, Axis::real, 1), sweep_limit(stages, Axis::imaginary, 1) + 1e-8);
  }
}

class MeasuredLimits : public ::testing::TestWithParam<const char*> {};

TEST_P(MeasuredLimits, AreTheKnownOnes) {
  for (const ode::IntegratorInfo& info : ode::integrators()) {
    const KnownLimit* known = known_limit(info.name);
    if (known == nullptr) continue;
    const StressRow row = measured(GetParam(), LinearProblem::oscillator, info.name);
    if (known->oscillator) {
      EXPECT_EQ(row.verdict, StressVerdict::stable) << info.name << ": " << row.why;
      EXPECT_NEAR(figure(row, "limit"), *known->oscillator, 1e-4) << info.name;
      EXPECT_NEAR(figure(row, "growth_at_1.01_limit"), figure(row, "growth_at_1.01_limit_theory"),
                  1e-6 * (1 + figure(row, "growth_at_1.01_limit_theory")))
          << info.name;
    } else {
      EXPECT_EQ(row.verdict, StressVerdict::unstable) << info.name << ": " << row.why;
      EXPECT_FALSE(row.figures.contains("limit")) << info.name;
    }
    if (!known->decay) continue;
    const StressRow decay = measured(GetParam(), LinearProblem::decay, info.name);
    EXPECT_EQ(decay.verdict, StressVerdict::stable) << info.name << ": " << decay.why;
    EXPECT_NEAR(figure(decay, "limit"), *known->decay, 1e-4) << info.name;
  }
}
INSTANTIATE_TEST_SUITE_P(Types, MeasuredLimits, ::testing::Values("double", "mpfr62"));

TEST(MeasuredLimit, OfCashAndKarpIsNothing) {
  const StressRow row = measured("double", LinearProblem::oscillator, "cash_karp54");
  EXPECT_EQ(row.verdict, StressVerdict::unstable);
  EXPECT_EQ(figure(row, "growth_power"), 6);
  EXPECT_NEAR(figure(row, "growth_coefficient"), 1.0 / 7200, 1e-3 / 7200);
  EXPECT_NEAR(figure(row, "growth_coefficient_theory"), 1.0 / 7200, 1e-5 / 7200);
  // float sees none of it at small steps.
  EXPECT_GT(figure(measured("float", LinearProblem::oscillator, "cash_karp54"), "growth_seen_from"), 0.3);
}

// Where a whole turn takes two steps the order 10 has a gap of 8e-4, too shallow for float.
TEST(MeasuredLimit, OfOrderTenHasAGapBelowIt) {
  const StressRow row = measured("double", LinearProblem::oscillator, "sofroniou_spaletta10");
  EXPECT_NEAR(figure(row, "gap_1_from"), 3.1410819, 1e-6);
  EXPECT_NEAR(figure(row, "gap_1_to"), 3.1418426, 1e-6);
  EXPECT_NEAR(figure(row, "gap_1_growth"), 3.8e-4, 2e-5);
  EXPECT_NEAR(figure(row, "reentry_1_from"), 6.650458, 1e-5);
  const StressRow narrow = measured("float", LinearProblem::oscillator, "sofroniou_spaletta10");
  EXPECT_EQ(figure(narrow, "gaps_hidden_by_rounding"), 1);
  EXPECT_FALSE(narrow.figures.contains("gap_1_from"));
}

TEST(MeasuredLimit, OfPefrlComesBack) {
  const StressRow row = measured("double", LinearProblem::oscillator, "pefrl");
  EXPECT_NEAR(figure(row, "reentry_1_from"), 3.505423, 1e-5);
  EXPECT_NEAR(figure(row, "reentry_1_to"), 5.366461, 1e-5);
}

// The iteration of the stages refuses below where it would converge after as many sweeps as one likes.
TEST(MeasuredLimit, OfGaussIsThatOfItsIteration) {
  for (const char* name : {"gauss1", "gauss2", "gauss5"}) {
    for (const LinearProblem problem : {LinearProblem::oscillator, LinearProblem::decay}) {
      const StressRow row = measured("double", problem, name);
      EXPECT_EQ(row.verdict, StressVerdict::stable) << row.why;
      EXPECT_LT(figure(row, "iteration_limit"), figure(row, "iteration_limit_without_end"));
      EXPECT_LE(figure(row, "iteration_limit_without_end"),
                figure(row, "iteration_limit_1_over_rho_A") * (1 + 1e-9));
    }
  }
}

TEST(IntegratorLimits, AreAsKnownInNarrowTypes) {
  for (const StressCase& c : integrator_limit_cases()) {
    for (const char* token : {"float", "double"}) {
      const std::optional<StressRow> row = c.run(token, {});
      ASSERT_TRUE(row) << c.key();
      EXPECT_TRUE(standing_of(c, token, *row).as_known) << c.key() << " " << token << ": " << row->why;
      for (const auto& [name, value] : row->figures) EXPECT_TRUE(std::isfinite(value)) << c.key() << name;
    }
    EXPECT_FALSE(c.run("no_such_type", {}));
  }
}

TEST(IntegratorLimits, StopWhenTold) {
  const std::atomic<bool> raised = true;
  EXPECT_THROW((void)integrator_limit_cases().front().run("double", ode::StopFlag(raised)), ode::Stopped);
}

}  // namespace
}  // namespace ulpgate
