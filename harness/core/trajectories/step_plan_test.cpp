// Tests of planned steps, of the times at which they are compared, and of true solutions at those times.
#include "harness/core/trajectories/step_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/core/trajectories/truth.hpp"
#include "harness/core/trajectories/truth_path.hpp"
#include "kernels/ode/problems/initial_value_cases.hpp"
#include "reference/text/text.hpp"

namespace ulpgate {
namespace {

// In 150 digits every sum of doubles of this size is exact.
using Exact = MpfrReal<150>;

TEST(GradedPlan, ComesByEachOfItsTimesExactly) {
  for (const auto& problem : initial_value_problems()) {
    for (const auto& end : problem.ends) {
      const auto& times = graded_times(problem.name, end);
      EXPECT_TRUE(std::ranges::is_sorted(times)) << problem.name;
      ASSERT_EQ(times.size() + 1, graded_times_count) << problem.name << " " << end;
      EXPECT_LT(times.back(), ode::end_time<double>(end));
      for (const double tolerance : {1e-3, 1e-7}) {
        const GradedPlan& graded = graded_plan(problem.name, end, tolerance);
        ASSERT_EQ(graded.behind.size(), graded_times_count);
        EXPECT_EQ(graded.behind.back(), graded.plan.steps.size() + 1);
        Exact t(0);
        std::size_t next = 0;
        for (std::size_t i = 0; i < graded.plan.steps.size(); ++i) {
          EXPECT_GT(graded.plan.steps[i], 0);
          t += static_cast<Exact>(graded.plan.steps[i]);
          if (i + 1 != graded.behind[next]) continue;
          EXPECT_EQ(t, static_cast<Exact>(times[next])) << problem.name << " " << end << " time " << next;
          ++next;
        }
        EXPECT_EQ(next, times.size());
      }
    }
  }
}

TEST(GradedPlan, HasMoreStepsForASharperTolerance) {
  std::uint64_t before = 0;
  for (const double tolerance : {1e-3, 1e-6, 1e-9, finest_tolerance}) {
    const std::uint64_t steps = graded_plan("van_der_pol", "2", tolerance).behind.back();
    EXPECT_GT(steps, before);
    before = steps;
  }
  EXPECT_EQ(&graded_plan("robertson", "40", 1e-6), &graded_plan("robertson", "40", 1e-6));
  EXPECT_THROW((void)graded_plan("robertson", "40", 1e-2), std::invalid_argument);
  EXPECT_THROW((void)graded_plan("robertson", "40", 1e-14), std::invalid_argument);
  EXPECT_THROW((void)graded_plan("robertson", "40", std::nan("")), std::invalid_argument);
  EXPECT_THROW((void)graded_plan("nothing", "40", 1e-6), std::invalid_argument);
}

TEST(GradedPlan, IsWhatAnEngineIsComparedAt) {
  const GradedPlan& graded = graded_plan("oregonator", "360", 1e-6);
  TrajectoryOptions options;
  options.behind = graded.behind;
  const Trajectory t = find_trajectory_engine("double")->planned_steps("oregonator", "radau5", "360",
                                                                       graded.plan, 1, options, {});
  ASSERT_EQ(t.checkpoints.size(), graded_times_count);
  EXPECT_EQ(t.checkpoints.back(), t.state);
  const TruePath truth = true_path("oregonator", "360", {1, graded_times("oregonator", "360")}, 10, {});
  ASSERT_EQ(truth.states.size(), graded_times_count);
  for (std::size_t k = 0; k < graded_times_count; ++k)
    EXPECT_LT(relative_distance(t.checkpoints[k], truth.states[k]), 1e-8) << "time " << k;
}

// Two ways to the same numbers: with stops on the way and without.
TEST(TruePath, EndsInTheTrueSolution) {
  for (const auto& [problem, end] : {std::pair("robertson", "40"),
                                     {"kepler", "2 pi"},
                                     {"arenstorf", "17.0652165601579625588917206249"},
                                     {"henon_heiles_chaotic", "100"},
                                     {"chemakzo", "180"}}) {
    const auto ends = true_solution(problem, end, 15, {});
    for (const bool graded : {false, true}) {
      ComparedTimes times{16, {}};
      if (graded) times.graded = graded_times(problem, end);
      const TruePath path = true_path(problem, end, times, 15, {});
      ASSERT_EQ(path.states.size(), 16U);
      std::vector<std::string> wanted;
      for (const auto& c : ends) wanted.push_back(c.value);
      // Texts of 15 digits are rounded by up to half of the last.
      EXPECT_LT(relative_distance(path.states.back(), wanted), 7e-15) << problem;
      EXPECT_EQ(path.error, 1e-15);
    }
  }
}

// A closed form on the way: of Kepler's orbit the apocentre at half the period, (-1 - e, 0).
TEST(TruePath, KnowsTheApocentre) {
  const TruePath path = true_path("kepler", "2 pi", {2, {}}, 30, {});
  ASSERT_EQ(path.states.size(), 2U);
  EXPECT_EQ(path.norm, ErrorNorm::normwise);
  const Exact x = parse_real<Exact>(path.states[0][0]);
  const Exact y = parse_real<Exact>(path.states[0][1]);
  EXPECT_LT(abs(Exact(x + real<Exact>("1.99"))), real<Exact>("1e-29"));
  EXPECT_LT(abs(y), real<Exact>("1e-29"));
}

TEST(TruePath, ComparesConcentrationsEachForItself) {
  EXPECT_EQ(true_path("chemakzo", "180", {1, {}}, 10, {}).norm, ErrorNorm::componentwise);
  EXPECT_THROW((void)true_path("chemakzo", "181", {1, {}}, 10, {}), std::invalid_argument);
  EXPECT_THROW((void)true_path("chemakzo", "180", {0, {}}, 10, {}), std::invalid_argument);
  EXPECT_THROW((void)true_path("chemakzo", "180", {1, {}}, 0, {}), std::invalid_argument);
}

}  // namespace
}  // namespace ulpgate
