// Tests of rows, fronts, times and measurements of settings.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <set>
#include <thread>

#include "harness/core/subject/registry.hpp"
#include "harness/core/trend/interleaved_order.hpp"
#include "harness/core/work_precision/pareto_front.hpp"
#include "harness/core/work_precision/subject_setting.hpp"
#include "harness/core/work_precision/time_summary.hpp"
#include "harness/core/work_precision/trajectory_setting.hpp"
#include "reference/text/text.hpp"

namespace ulpgate {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

TEST(WorkPrecisionRow, AnOutcomeSurvivesItsText) {
  WorkOutcome o;
  EXPECT_EQ(WorkOutcome::from_text(o.to_text()), o);
  o.failure = WorkFailure::diverged;
  o.why = "the state is not finite behind step 3";
  o.steps = 3;
  o.evaluations = 12;
  EXPECT_EQ(WorkOutcome::from_text(o.to_text()), o);
  o.failure = WorkFailure::none;
  o.final_error = 1.0 / 3;
  o.largest_error = 0;
  o.energy_error = 0x1p-1060;
  o.instants = 16;
  o.t_s = 2.45;
  o.t_s_to_the_end = true;
  o.growth_rate = -1.5;
  EXPECT_EQ(WorkOutcome::from_text(o.to_text()), o);
  o.why = "two\nlines";
  EXPECT_EQ(WorkOutcome::from_text(o.to_text()).why, "two lines");
  for (const auto* bad :
       {"", "-", "lost 1 2 - - - - - - - - - 0", "- 1 2 - - - - - - - -", "- -1 2 - - - - - - - - - 0",
        "- 1 2 x - - - - - - - - 0", "- 1 2 - - - - - - - - x 0"})
    EXPECT_THROW((void)WorkOutcome::from_text(bad), std::invalid_argument) << bad;
}

TEST(WorkPrecisionRow, KeysTellSettingsApart) {
  std::set<std::string> keys;
  for (const auto* type : {"float", "double"}) {
    for (const std::uint64_t steps : {64U, 128U}) {
      for (const auto* end : {"1", "2"})
        keys.insert(
            WorkSetting{WorkSubject::trajectory, "kepler", type, "leapfrog", end, "", steps, 0}.key());
    }
  }
  EXPECT_EQ(keys.size(), 8U);
  const WorkSetting equal{WorkSubject::trajectory, "kepler", "double", "rk4", "1", "", 64, 0};
  const WorkSetting planned{WorkSubject::trajectory, "kepler", "double", "rk4", "1", "plan:1e-6", 64, 0};
  EXPECT_TRUE(planned.planned() && !equal.planned());
  EXPECT_NE(planned.curve(), equal.curve()) << "two curves of one integrator";
  EXPECT_NE(planned.key(), equal.key());
  EXPECT_EQ((WorkSetting{WorkSubject::function, "sin", "double", "", "", "", 0, 0}.key()),
            "function/sin/double");
}

TEST(ParetoFront, KeepsWhatNoOtherBeats) {
  const std::vector<WorkPoint> points = {{1e-3, 1},  {1e-6, 2},    {1e-4, 3}, {1e-9, 4}, {1e-9, 5},
                                         {inf, 0.1}, {1e-12, inf}, {1e-3, 1}, {1e-2, 1}, {2, 1e-9}};
  EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{0, 1, 3}));
  EXPECT_TRUE(pareto_front({}).empty());
  EXPECT_TRUE(pareto_front({{inf, 1}, {std::nan(""), 1}}).empty());
  // A gain of a hundredth is none, one of three is; an exact result always gains.
  EXPECT_EQ(pareto_front({{1e-3, 1}, {0.99e-3, 2}, {0.97e-3, 3}, {0, 4}, {0, 5}}),
            (std::vector<std::size_t>{0, 2, 3}));
}

TEST(TimeSummary, OfTimes) {
  const TimeSummary s = summarize_times({5, 1, 2, 4, 3});
  EXPECT_EQ(s.minimum_s, 1);
  EXPECT_EQ(s.median_s, 3);
  EXPECT_EQ(s.spread_s, 2);
  EXPECT_EQ(s.repeats, 5U);
  EXPECT_EQ(summarize_times({7}).spread_s, 0);
  EXPECT_DOUBLE_EQ(noise_floor({2, 2.2, 2.1}), 2.1 / 2 - 1);
  EXPECT_EQ(noise_floor({2}), 0);
}

TEST(TimeSummary, RoundsShuffleDifferentlyAndRepeat) {
  const auto first = interleaved_order(50, 0);
  EXPECT_EQ(interleaved_order(50, 0), first);
  EXPECT_NE(interleaved_order(50, 1), first);
  auto sorted = first;
  std::ranges::sort(sorted);
  for (std::size_t i = 0; i < sorted.size(); ++i) EXPECT_EQ(sorted[i], i);
  EXPECT_FALSE(std::ranges::is_sorted(first));
  EXPECT_TRUE(interleaved_order(0, 0).empty());
}

TEST(Shared, IsMadeOnceAndFailsForAll) {
  std::atomic<int> made = 0;
  Shared<int> value([&](const ode::StopFlag&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return ++made;
  });
  std::vector<std::thread> pool;
  std::atomic<int> sum = 0;
  pool.reserve(4);
  for (int i = 0; i < 4; ++i) pool.emplace_back([&] { sum += value.get({}); });
  for (auto& t : pool) t.join();
  EXPECT_EQ(made, 1);
  EXPECT_EQ(sum, 4);
  Shared<int> bad([&](const ode::StopFlag&) -> int { throw std::runtime_error("no truth"); });
  for (int i = 0; i < 2; ++i) EXPECT_THROW((void)bad.get({}), std::runtime_error);
  // Who was stopped leaves it for the next.
  std::atomic<bool> raised = true;
  Shared<int> late([&](const ode::StopFlag& stop) {
    stop.check();
    return 7;
  });
  EXPECT_THROW((void)late.get(ode::StopFlag(raised)), ode::Stopped);
  EXPECT_EQ(late.get({}), 7);
}

// x' = -x from 1 to t = 1 by Euler's rule, in double; above 1000 steps it refuses, at 2 it loses the numbers.
class FakeEngine final : public TrajectoryEngine {
 public:
  [[nodiscard]] int significand_bits() const override { return 53; }
  [[nodiscard]] bool applies(std::string_view, std::string_view) const override { return true; }
  using TrajectoryEngine::equal_steps;
  [[nodiscard]] Trajectory equal_steps(std::string_view, std::string_view, std::string_view,
                                       std::uint64_t steps, const TrajectoryOptions& options,
                                       const ode::StopFlag& stop) const override {
    stop.check();
    ++runs;
    Trajectory t;
    t.steps = steps;
    t.evaluations = steps;
    if (steps > 1000) t.refusal = "no";
    if (steps == 2) {
      t.finite = false;
      t.first_not_finite = 1;
    }
    double x = 1;
    for (std::uint64_t i = 0; i < steps; ++i) {
      x -= x / static_cast<double>(steps);
      const auto wanted = static_cast<std::uint64_t>(options.checkpoints);
      if (wanted > 0 && (i + 1) % (steps / wanted) == 0) t.checkpoints.push_back({to_hexfloat(x)});
    }
    t.state = {to_hexfloat(x)};
    t.largest_invariant_error = 0.5;
    return t;
  }
  [[nodiscard]] Trajectory planned_steps(std::string_view, std::string_view, std::string_view,
                                         const StepPlan&, int, const TrajectoryOptions&,
                                         const ode::StopFlag&) const override {
    return {};
  }
  mutable int runs = 0;
};

// exp(-t) at quarters of the end.
SharedTruth truth_of_decay() {
  return std::make_shared<Shared<TruePath>>([](const ode::StopFlag&) {
    return TruePath{{{"0.77880078307140486824517026697832"},
                     {"0.60653065971263342360379953499118"},
                     {"0.47236655274101470713804655094327"},
                     {"0.36787944117144232159552377016146"}},
                    ErrorNorm::normwise,
                    1e-30};
  });
}

WorkSetting decay(std::uint64_t steps) {
  return {WorkSubject::trajectory,         "decay", "double", "leapfrog", "1", "", steps,
          1.0 / static_cast<double>(steps)};
}

TEST(TrajectorySetting, MeasuresRefusesAndBreaks) {
  const FakeEngine engine;
  TrajectorySetting good(decay(64), engine, truth_of_decay(), 1e6);
  EXPECT_FALSE(good.complete());
  const std::string piece = good.proceed(1);
  ASSERT_TRUE(good.complete());
  // (1 - 1/n)^n = (1 - 1/(2n) - ...)/e.
  EXPECT_NEAR(*good.outcome().final_error, 1.0 / 128, 1e-4);
  // At t the error is t/(2n): the end has the largest.
  EXPECT_EQ(good.outcome().largest_error, good.outcome().final_error);
  EXPECT_EQ(good.outcome().instants, 4U);
  EXPECT_EQ(good.outcome().energy_error, 0.5);
  EXPECT_NEAR(*good.outcome().correct_digits, 2.1, 0.1);
  TrajectorySetting again(decay(64), engine, truth_of_decay(), 1e6);
  const int runs = engine.runs;
  EXPECT_TRUE(again.take(piece));
  EXPECT_EQ(again.outcome(), good.outcome());
  EXPECT_EQ(engine.runs, runs) << "what is kept is not measured again";
  EXPECT_FALSE(again.take(piece)) << "it is complete";

  const auto outcome_of = [&](std::uint64_t steps, double budget) {
    TrajectorySetting s(decay(steps), engine, truth_of_decay(), budget);
    const std::string text = s.proceed(1);
    TrajectorySetting resumed(decay(steps), engine, truth_of_decay(), budget);
    EXPECT_TRUE(resumed.take(text));
    EXPECT_EQ(resumed.outcome(), s.outcome());
    return s.outcome();
  };
  EXPECT_EQ(outcome_of(2, 1e6).failure, WorkFailure::diverged);
  EXPECT_EQ(outcome_of(2, 1e6).steps, 1U);
  EXPECT_EQ(outcome_of(2000, 1e6).failure, WorkFailure::refused);
  EXPECT_EQ(outcome_of(2000, 1e6).why, "no");
  EXPECT_EQ(outcome_of(66, 1e6).instants, 2U) << "steps end at the half and at the end alone";
  EXPECT_EQ(outcome_of(65, 1e6).instants, 1U);
  const WorkOutcome dear = outcome_of(64, 10);
  EXPECT_EQ(dear.failure, WorkFailure::refused);
  EXPECT_NE(dear.why.find("budget"), std::string::npos);
  EXPECT_FALSE(dear.error().has_value());
}

WorkOutcome outcome_of(const WorkSetting& s, const ProblemTruths& truths) {
  TrajectorySetting m(s, *find_trajectory_engine(s.type), truths.of(s), default_evaluation_budget);
  static_cast<void>(m.proceed(1));
  return m.outcome();
}

// Equal steps of a stiff problem waste theirs; explicit methods end for good with either.
TEST(TrajectorySetting, PlannedStepsFollowAStiffProblem) {
  const ProblemTruths truths = shared_truths("robertson", "40", 15);
  const WorkSetting planned = planned_setting("robertson", "double", "radau3", "40", 1e-6);
  EXPECT_EQ(planned.dt, "plan:1e-6");
  const WorkOutcome graded = outcome_of(planned, truths);
  EXPECT_EQ(graded.steps, planned.steps);
  EXPECT_EQ(graded.instants, 16U);
  EXPECT_LT(*graded.final_error, 1e-8);
  EXPECT_GE(*graded.largest_error, *graded.final_error);
  EXPECT_LT(*graded.largest_error, 1e-5);
  const WorkOutcome equal =
      outcome_of(equal_setting("robertson", "double", "radau3", "40", planned.steps / 16 * 16), truths);
  EXPECT_EQ(equal.failure, WorkFailure::refused) << "as many equal steps are too long for the first phase";
  const WorkOutcome lost = outcome_of(planned_setting("robertson", "double", "rk4", "40", 1e-6), truths);
  EXPECT_EQ(lost.failure, WorkFailure::diverged);
  EXPECT_FALSE(lost.largest_error || lost.instants);
  EXPECT_THROW((void)planned_setting("robertson", "double", "rk4", "40", 1e-20), std::invalid_argument);
}

TEST(SubjectSetting, FunctionsAndKernelsHaveErrorsThatAreRelative) {
  SubjectSetting sine(*find_subject("sin", "float"), 500);
  (void)sine.proceed(1);
  const WorkOutcome o = sine.outcome();
  EXPECT_EQ(o.failure, WorkFailure::none);
  EXPECT_GT(*o.largest_error_ulp, 0.4);
  EXPECT_LT(*o.largest_error_ulp, 0.57);
  EXPECT_EQ(*o.largest_error, std::ldexp(*o.largest_error_ulp, -23));
  EXPECT_NEAR(*o.correct_digits, 7.2, 0.2);
  sine.prepare()({});
  EXPECT_EQ(sine.parts_of_repeat(), 512U);
  SubjectSetting kernel(*find_subject("sphere_sphere", "double"), 40);
  (void)kernel.proceed(1);
  EXPECT_GT(*kernel.outcome().largest_error, 0);
  EXPECT_LT(*kernel.outcome().largest_error, 1e-8);
}

}  // namespace
}  // namespace ulpgate
