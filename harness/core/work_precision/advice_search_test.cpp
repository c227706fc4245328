// Tests of the search for the cheapest setting, on curves of known error and cost.
#include "harness/core/work_precision/advice_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace ulpgate {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// A curve whose error at level k, a whole number or quarters beyond, is C 2^(-p k) + floor, and whose time
// doubles with every level.
struct MadeCurve {
  double c, p, floor, first_s;
  int fails_below = 0;
  double guess_s = 0;
};

struct Made {
  std::vector<MadeCurve> curves;
  std::vector<int> looked = std::vector<int>(curves.size(), 0);
  double spent_s = 0;
  double search_s = infinite;
  std::map<int, double> disturbed = {};  // a quarter's run takes so many times as long

  AdviceSearch search(double error, double most_s, int levels = 30) {
    std::vector<AdviceCurve> list;
    for (const auto& c : curves) list.push_back({levels, c.guess_s, 2});
    return search_advice(list, {error, most_s, search_s}, [&](std::size_t i, int quarter, double run_s) {
      const MadeCurve& m = curves[i];
      const double level = quarter / 4.0;
      ++looked[i];
      AdvicePoint point{i, quarter, {}, m.first_s * std::exp2(level), false, AdvicePoint::Wanted::final};
      if (disturbed.contains(quarter)) point.seconds *= disturbed[quarter];
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
  // 2^-(8 k) <= 1e-6 from k = 2.49 on, at 90 s; 2^-(2 k) from k = 10 at 1024 s.
  EXPECT_EQ(search.points[*search.best].curve, 1U);
  EXPECT_EQ(search.points[*search.best].quarter, 10);
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
  EXPECT_EQ(search.points[*search.best].quarter, 40);
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
  // Levels, the cut one, and the quarters between the last two levels.
  EXPECT_NEAR(made.spent_s, 1 + 2 + 4 + 8 + 8 + 4 * (std::exp2(0.5) + std::exp2(0.25)), 1e-9);
  EXPECT_EQ(search.ends[1], CurveEnd::too_dear);
}

TEST(AdviceSearch, ADisturbedRunHidesNoCheaperOne) {
  // The error is met from level 8.05 on: 8 1/4 is the cheapest quarter.  First the level that meets it is
  // disturbed, then the quarter between, whose time is then no sign that it is dear.
  const double error = std::exp2(-8.05);
  for (const int quarter : {36, 34, 33}) {
    Made made{{{1, 1, 0, 1}}};
    made.disturbed[quarter] = 2.5;
    const AdviceSearch search = made.search(error, infinite);
    EXPECT_TRUE(std::ranges::any_of(search.points, [](const auto& p) { return p.quarter == 33 && !p.cut; }))
        << "quarter " << quarter << " disturbed";
  }
}

TEST(AdviceSearch, DoesNotBeginWhatIsFarDearer) {
  Made made{{{1, 8, 0, 1}, {1, 8, 0, 1000, 0, 1000}, {1, 8, 0, 10, 0, 10}}};
  const AdviceSearch search = made.search(1e-6, 1e9);
  ASSERT_TRUE(search.best.has_value());
  EXPECT_EQ(search.ends[1], CurveEnd::untouched);
  EXPECT_EQ(made.looked[1], 0);
  EXPECT_GT(made.looked[2], 0) << "a guess may be wrong";
}

// The cost at which a curve's error is the one wanted.
double least_cost(const MadeCurve& c, double error) {
  return c.first_s * std::pow(error / c.c, -1 / c.p);
}

TEST(AdviceSearch, IsWithinAQuarterOfTheCheapest) {
  for (const double order : {1.0, 2.0, 4.0, 8.0}) {
    for (const double error : {1e-3, 3e-5, 1e-6, 7e-8}) {
      Made made{{{1, order, 0, 1}, {1, order, 0, 1.3}}};
      const AdviceSearch search = made.search(error, 1e9);
      ASSERT_TRUE(search.best.has_value());
      const AdvicePoint& best = search.points[*search.best];
      EXPECT_LE(best.certain_error(), error);
      EXPECT_LE(best.seconds, 1.2 * least_cost(made.curves[0], error)) << order << " " << error;
    }
  }
}

TEST(AdviceSearch, LooksBetweenTheLevelsOfACurveThatWasTooDear) {
  // The first meets the error at level 7, 128 s, and nothing before; the second would take 90 s, but its
  // levels are 70 s, which fails by little, and 140 s.
  Made made{{{1, 8, 0, 1, 7}, {std::exp2(-20) * std::pow(90 / 70.0, 10), 10, 0, 70}}};
  const AdviceSearch search = made.search(std::exp2(-20), 1e9);
  ASSERT_TRUE(search.best.has_value());
  EXPECT_EQ(search.points[*search.best].curve, 1U);
  EXPECT_NEAR(search.points[*search.best].seconds, 70 * std::exp2(0.5), 1e-9);
  EXPECT_EQ(search.ends[1], CurveEnd::too_dear);
}

TEST(AdviceSearch, AnUncertainTruthCounts) {
  AdvicePoint point;
  point.outcome.final_error = 1e-9;
  EXPECT_EQ(point.certain_error(), 1e-9);
  point.outcome.reference_error = 1e-6;
  EXPECT_GT(point.certain_error(), 1e-6);
  point.outcome.largest_error = 1e-3;
  EXPECT_LT(point.certain_error(), 1e-3) << "what counts is the end";
  point.wanted = AdvicePoint::Wanted::on_the_way;
  EXPECT_GT(point.certain_error(), 1e-3);
  point.outcome.failure = WorkFailure::refused;
  EXPECT_EQ(point.certain_error(), infinite);
}

}  // namespace
}  // namespace ulpgate
