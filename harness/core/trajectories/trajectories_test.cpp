// Engines, step plans, true solutions and the cases of kind "trajectory".
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "harness/core/subject/registry.hpp"
#include "harness/core/trajectories/published_values.hpp"
#include "harness/core/trajectories/trajectory_cases.hpp"
#include "harness/core/trajectories/truth.hpp"

namespace ulpgate {
namespace {

double number(const std::string& text) {
  return std::strtod(text.c_str(), nullptr);
}

// Robertson's as published to the digits of a double; of E5 the closed late phase, y2 = y3.
TEST(Truth, HasTheDigitsThatArePublished) {
  const auto robertson = true_solution("robertson", "40", 25, {});
  EXPECT_EQ(robertson[0].value.substr(0, 12), "7.1582706871");
  const auto e5 = true_solution("e5", "1e13", 25, {});
  EXPECT_NE(e5[0].value.find("e-3441"), std::string::npos) << e5[0].value;
  EXPECT_EQ(e5[1].value, e5[2].value);
  const auto kepler = true_solution("kepler", "2 pi", 30, {});
  EXPECT_EQ(number(kepler[0].value), 0.01);
  EXPECT_EQ(number(kepler[3].value), std::sqrt(199.0));
}

TEST(Truth, RefusesWhatIsNone) {
  EXPECT_THROW((void)true_solution("nothing", "1", 25, {}), std::invalid_argument);
  EXPECT_THROW((void)true_solution("hires", "1", 25, {}), std::invalid_argument);
  EXPECT_THROW((void)true_solution("hires", "321.8122", 0, {}), std::invalid_argument);
  EXPECT_THROW((void)true_solution("hires", "321.8122", most_truth_digits + 1, {}), std::invalid_argument);
}

TEST(PublishedValues, AreComparedDigitByDigit) {
  const std::vector<TrueValue> truth{{"1.234567890123456789012345", 25}, {"-2.5e-3459", 25}};
  const auto agreement = [&](const std::string& value, std::size_t component = 0) {
    return agreement_with_truth({"p", "1", component, value, "print"}, truth);
  };
  using enum PublishedStanding;
  struct Row {
    const char* value;
    PublishedStanding standing;
    int printed;
    double digits;
  };
  for (const Row& r :
       {Row{"1.234567890123457", to_the_last, 16, 16}, Row{"0.1234567890123457e1", to_the_last, 16, 16},
        Row{"0.1234567890123458e+1", in_part, 16, 15}, Row{"1.234567890", to_the_last, 10, 10},
        Row{"1.234567890123456789012345678901", to_the_last, 31, 25}, Row{"1.23456789", to_the_last, 9, 9},
        Row{"1.2345000000000000", wrong, 17, 4.26}, Row{"1.5", wrong, 2, 0.67},
        Row{"-1.234567890123457", wrong, 16, 0}, Row{"1.234567890123457e-7", wrong, 16, 0}}) {
    const PublishedAgreement a = agreement(r.value);
    EXPECT_EQ(a.standing, r.standing) << r.value << " " << a.digits;
    EXPECT_EQ(a.printed, r.printed) << r.value;
    EXPECT_NEAR(a.digits, r.digits, 0.3) << r.value;
  }
  // A zero in print beside a component that underflows, and one in the place of the solution.
  EXPECT_EQ(agreement("0", 1).standing, to_the_last);
  EXPECT_EQ(agreement("0", 0).standing, wrong);
  EXPECT_EQ(agreement("0.1152903278711829e-290", 1).standing, wrong);
  EXPECT_THROW((void)agreement("1", 2), std::out_of_range);
}

// A digit that was lost on the way from print shows: of these two nothing is wrong.
TEST(PublishedValues, OfHiresAndChemakzoHoldToTheirLastDigit) {
  for (const auto& [problem, end] : {std::pair{"hires", "321.8122"}, std::pair{"chemakzo", "180"}}) {
    const auto truth = true_solution(problem, end, 20, {});
    std::size_t components = 0;
    for (const PublishedValue& p : published_values()) {
      if (p.problem != problem) continue;
      EXPECT_EQ(p.component, components++);
      EXPECT_EQ(agreement_with_truth(p, truth).standing, PublishedStanding::to_the_last)
          << problem << " " << p.component + 1;
    }
    EXPECT_EQ(components, truth.size()) << problem;
  }
}

TEST(StepPlan, LeadsEveryTypeToTheSameEnd) {
  const StepPlan& plan = step_plan("oregonator", "360", 1e-6);
  EXPECT_EQ(&plan, &step_plan("oregonator", "360", 1e-6));
  EXPECT_GT(plan.steps.size(), 100U);
  const auto& exact = reference_trajectory_engine(64);
  const Trajectory reference = exact.planned_steps("oregonator", "radau5", "360", plan, 1, {}, {});
  const Trajectory own =
      find_trajectory_engine("double")->planned_steps("oregonator", "radau5", "360", plan, 1, {}, {});
  EXPECT_LT(relative_distance(own.state, reference.state), 1e-9);
  EXPECT_NEAR(number(reference.state[0]), 1.000814870318522716, 1e-6);
  EXPECT_EQ(own.steps, plan.steps.size() + 1);
}

TEST(TrajectoryEngine, CountsAndKeepsCheckpoints) {
  const TrajectoryEngine& engine = *find_trajectory_engine("double");
  const Trajectory t =
      engine.equal_steps("kepler", "velocity_verlet", "2 pi", 1000, TrajectoryOptions{0, 0, 4}, {});
  EXPECT_EQ(t.steps, 1000U);
  EXPECT_EQ(t.evaluations, 1001U);
  ASSERT_EQ(t.checkpoints.size(), 4U);
  EXPECT_EQ(t.checkpoints.back(), t.state);
  ASSERT_TRUE(t.largest_invariant_error);
  EXPECT_GT(*t.largest_invariant_error, *t.final_invariant_error);
  // A perturbation behind every step moves the end by much more than itself on this orbit.
  const Trajectory moved =
      engine.equal_steps("kepler", "velocity_verlet", "2 pi", 1000, TrajectoryOptions{1e-10, 3, 0}, {});
  const double distance = relative_distance(moved.state, t.state);
  EXPECT_GT(distance, 1e-10);
  EXPECT_LT(distance, 1e-3);
}

TEST(TrajectoryEngine, ExplicitMethodsEndOnStiffProblems) {
  const TrajectoryEngine& engine = *find_trajectory_engine("double");
  const Trajectory t = engine.equal_steps("robertson", "fehlberg78", "40", 200, {});
  EXPECT_FALSE(t.finite);
  EXPECT_LT(t.first_not_finite, 200U);
  EXPECT_TRUE(t.state.empty());
  const Trajectory refused = engine.equal_steps("van_der_pol", "gauss4", "2", 50, {});
  EXPECT_NE(refused.refusal.find("do not converge"), std::string::npos) << refused.refusal;
  EXPECT_THROW((void)engine.equal_steps("nothing", "rk4", "2", 50, {}), std::invalid_argument);
  EXPECT_THROW((void)engine.applies("rk4", "nothing"), std::invalid_argument);
}

TEST(Distances, AreNormwiseAndComponentwise) {
  const std::vector<std::string> a{"0x1p+0", "0x1.8p-20"};
  const std::vector<std::string> b{"0x1p+0", "0x1p-20"};
  EXPECT_EQ(relative_distance(a, b), 0x1p-21);
  EXPECT_EQ(componentwise_distance(a, b, {1, 1}), 0.5);
  // What has decayed to nothing does not count.
  const std::vector<std::string> gone{"0x1p+0", "0x1p-200"};
  EXPECT_LT(componentwise_distance({"0x1p+0", "0x0p+0"}, gone, {1, 1}), 1e-29);
}

TEST(TrajectoryCases, ComeToWhatIsKnownInFloatAndDouble) {
  for (const auto& c : trajectory_cases()) {
    if (c.form.find("to_40") == std::string::npos && c.name != "arenstorf") continue;
    for (const char* token : {"float", "double"}) {
      const auto row = c.run(token, {});
      ASSERT_TRUE(row) << c.key();
      const auto standing = standing_of(c, token, *row);
      EXPECT_TRUE(standing.as_known) << c.key() << " " << token << ": " << to_string(row->verdict)
                                     << ", known is " << standing.expected << ", E " << row->error.value_or(0)
                                     << " kappa " << row->condition.value_or(0);
    }
  }
}

}  // namespace
}  // namespace ulpgate
