// Tests of rows, fronts, times, measurements of settings and the search for the cheapest one.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <set>
#include <thread>

#include "harness/core/subject/registry.hpp"
#include "harness/core/work_precision/advice_search.hpp"
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
  o.t_s = 2.45;
  o.t_s_to_the_end = true;
  o.growth_rate = -1.5;
  EXPECT_EQ(WorkOutcome::from_text(o.to_text()), o);
  o.why = "two\nlines";
  EXPECT_EQ(WorkOutcome::from_text(o.to_text()).why, "two lines");
  for (const auto* bad : {"", "-", "lost 1 2 - - - - - - - - 0", "- 1 2 - - - - - - -",
                          "- -1 2 - - - - - - - - 0", "- 1 2 x - - - - - - - 0"})
    EXPECT_THROW((void)WorkOutcome::from_text(bad), std::invalid_argument) << bad;
}

TEST(WorkPrecisionRow, KeysTellSettingsApart) {
  std::set<std::string> keys;
  for (const auto* type : {"float", "double"}) {
    for (const std::uint64_t steps : {64, 128}) {
      for (const auto* end : {"1", "2"})
        keys.insert(
            WorkSetting{WorkSubject::trajectory, "kepler", type, "leapfrog", end, "", steps, 0}.key());
    }
  }
  EXPECT_EQ(keys.size(), 8U);
  EXPECT_EQ((WorkSetting{WorkSubject::function, "sin", "double", "", "", "", 0, 0}.key()),
            "function/sin/double");
}

TEST(ParetoFront, KeepsWhatNoOtherBeats) {
  const std::vector<WorkPoint> points = {{1e-3, 1},  {1e-6, 2},    {1e-4, 3}, {1e-9, 4}, {1e-9, 5},
                                         {inf, 0.1}, {1e-12, inf}, {1e-3, 1}, {1e-2, 1}, {2, 1e-9}};
  EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{0, 1, 3}));
  EXPECT_TRUE(pareto_front({}).empty());
  EXPECT_TRUE(pareto_front({{inf, 1}, {std::nan(""), 1}}).empty());
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
                                       std::uint64_t steps, const TrajectoryOptions&,
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
    for (std::uint64_t i = 0; i < steps; ++i) x -= x / static_cast<double>(steps);
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

SharedTruth truth_of_decay() {
  return std::make_shared<Shared<TrajectoryTruth>>([](const ode::StopFlag&) {
    return TrajectoryTruth{{"0.36787944117144232159552377016146"}, 1e-30};
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
  const WorkOutcome dear = outcome_of(64, 10);
  EXPECT_EQ(dear.failure, WorkFailure::refused);
  EXPECT_NE(dear.why.find("budget"), std::string::npos);
  EXPECT_FALSE(dear.error().has_value());
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

// A curve whose error is C 2^(-p k) + floor, and whose time doubles with every level.
struct MadeCurve {
  double c, p, floor, first_s;
  int fails_below = 0;
  double guess_s = 0;
};

struct Made {
  std::vector<MadeCurve> curves;
  std::vector<int> looked = std::vector<int>(curves.size(), 0);
  double spent_s = 0;
  double search_s = inf;

  AdviceSearch search(double error, double most_s, int levels = 30) {
    std::vector<AdviceCurve> list;
    for (const auto& c : curves) list.push_back({levels, c.guess_s});
    return search_advice(list, {error, most_s, search_s}, [&](std::size_t i, int level, double run_s) {
      const MadeCurve& m = curves[i];
      ++looked[i];
      AdvicePoint point{i, level, {}, m.first_s * std::ldexp(1.0, level)};
      if (point.seconds > 2 * run_s) {
        point.cut = true;
        point.seconds = run_s;
      }
      spent_s += point.seconds;
      if (point.cut) return point;
      if (level < m.fails_below) {
        point.outcome.failure = WorkFailure::diverged;
      } else {
        point.outcome.final_error = m.c * std::pow(2, -m.p * level) + m.floor;
      }
      return point;
    });
  }
};

TEST(AdviceSearch, FindsTheCheapestOfAll) {
  // Of second order and cheap, of eighth and dear, of eighth with a floor above what is wanted.
  Made made{{{1, 2, 0, 1}, {1, 8, 0, 16}, {1, 8, 1e-3, 1}}};
  const AdviceSearch search = made.search(1e-6, 1e9);
  ASSERT_TRUE(search.best.has_value());
  // 2^-(8 k) <= 1e-6 from k = 3 at 128 s; 2^-(2 k) from k = 10 at 1024 s.
  EXPECT_EQ(search.points[*search.best].curve, 1U);
  EXPECT_EQ(search.points[*search.best].seconds, 128);
  EXPECT_EQ(search.ends, (std::vector<CurveEnd>{CurveEnd::too_dear, CurveEnd::met, CurveEnd::floor}));
  EXPECT_LT(made.spent_s, 6 * 128) << "no curve costs more than twice the best";
}

TEST(AdviceSearch, TrustsNoOrderThatItDidNotMeasure) {
  // Promises everything at its first steps and keeps nothing: an order that is lost at a kink.
  Made made{{{1, 8, 1e-5, 1}, {1, 1, 0, 1}}};
  const AdviceSearch search = made.search(1e-6, 1e9);
  ASSERT_TRUE(search.best.has_value());
  EXPECT_EQ(search.points[*search.best].curve, 1U);
  EXPECT_LE(search.points[*search.best].certain_error(), 1e-6);
  EXPECT_EQ(search.ends[0], CurveEnd::floor);
}

TEST(AdviceSearch, SaysThatNothingMeetsTheError) {
  Made made{{{1, 4, 1e-9, 1}, {1, 2, 0, 1}}};
  const AdviceSearch search = made.search(1e-12, 300);
  EXPECT_FALSE(search.best.has_value());
  ASSERT_TRUE(search.nearest.has_value());
  EXPECT_NEAR(search.points[*search.nearest].certain_error(), 1e-9, 5e-10);
  EXPECT_EQ(search.ends, (std::vector<CurveEnd>{CurveEnd::too_slow, CurveEnd::too_slow}));
  Made failing{{{1, 4, 0, 1, 99}}};
  const AdviceSearch none = failing.search(1e-3, 1e9, 5);
  EXPECT_FALSE(none.best || none.nearest);
  EXPECT_EQ(none.ends.front(), CurveEnd::finest);
  EXPECT_TRUE(search_advice({}, {1, 1, 1}, nullptr).points.empty());
}

TEST(AdviceSearch, FailuresAtCoarseStepsEndNoCurve) {
  Made made{{{1, 2, 0, 1, 5}}};
  const AdviceSearch search = made.search(1e-6, 1e9);
  ASSERT_TRUE(search.best.has_value());
  EXPECT_EQ(search.points[*search.best].level, 10);
}

TEST(AdviceSearch, LooksNoLongerThanItMay) {
  Made made{{{1, 2, 0, 1}}};
  made.search_s = 100;
  const AdviceSearch search = made.search(1e-12, 1e9);
  EXPECT_FALSE(search.best.has_value());
  EXPECT_EQ(search.ends.front(), CurveEnd::stopped);
  EXPECT_LE(made.spent_s, 100);
}

TEST(AdviceSearch, CutsWhatTakesLongerThanTheBest) {
  // The guess of the second is far too low: its first level takes a thousand times as long as the best.
  Made made{{{1, 8, 0, 1}, {1e-9, 8, 0, 1e4, 0, 8}}};
  const AdviceSearch search = made.search(1e-6, 1e9);
  ASSERT_TRUE(search.best.has_value());
  EXPECT_EQ(search.points[*search.best].curve, 0U);
  EXPECT_EQ(made.spent_s, 1 + 2 + 4 + 8 + 8);
  EXPECT_EQ(search.ends[1], CurveEnd::too_dear);
}

TEST(AdviceSearch, DoesNotBeginWhatIsFarDearer) {
  Made made{{{1, 8, 0, 1}, {1, 8, 0, 1000, 0, 1000}, {1, 8, 0, 10, 0, 10}}};
  const AdviceSearch search = made.search(1e-6, 1e9);
  ASSERT_TRUE(search.best.has_value());
  EXPECT_EQ(search.ends[1], CurveEnd::untouched);
  EXPECT_EQ(made.looked[1], 0);
  EXPECT_GT(made.looked[2], 0) << "a guess may be wrong";
}

TEST(AdviceSearch, AnUncertainTruthCounts) {
  AdvicePoint point;
  point.outcome.final_error = 1e-9;
  EXPECT_EQ(point.certain_error(), 1e-9);
  point.outcome.reference_error = 1e-6;
  EXPECT_GT(point.certain_error(), 1e-6);
  point.outcome.largest_error = 1e-3;
  EXPECT_GT(point.certain_error(), 1e-3);
  point.outcome.failure = WorkFailure::refused;
  EXPECT_EQ(point.certain_error(), inf);
}

}  // namespace
}  // namespace ulpgate
