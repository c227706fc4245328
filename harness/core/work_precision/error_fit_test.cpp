// Tests of the fit: parameters that are known come back from exact and from noisy points.
#include "harness/core/work_precision/error_fit.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "harness/core/arguments/random_words.hpp"

namespace ulpgate {
namespace {

constexpr double u = 0x1p-53;

struct Known {
  double c = 0;
  double p = 0;
  double b = 0;
  double d = 0;
};

// From -1 to 1.
double noise(std::uint64_t k) {
  std::array<std::uint64_t, 1> word{};
  RandomStream(1, "error_fit", "noise").fill(k, 0, word);
  return static_cast<double>(word[0] >> 11U) * 0x1p-52 - 1;
}

// Steps from 2^first to 2^last over t = 1; `decades` of noise on points of rounding, a twentieth of it on
// others.
std::vector<FitPoint> points_of(const Known& known, int first, int last, double decades) {
  std::vector<FitPoint> points;
  for (int k = first; k <= last; ++k) {
    const double n = std::ldexp(1.0, k);
    const double stepping = known.c * std::pow(1 / n, known.p);
    const double rounding = std::max(known.b * std::sqrt(n) * u, known.d * n * u);
    const double scatter = decades * (stepping > rounding ? 0.05 : 1) * noise(static_cast<std::uint64_t>(k));
    points.push_back({1 / n, n, std::max(stepping, rounding) * std::pow(10, scatter)});
  }
  return points;
}

TEST(ErrorFit, FindsWhatThePointsWereMadeOf) {
  struct Case {
    Known known;
    int first, last;
    double decades;
    double order_off, factor_off;
    const char* why;
  };
  const Case cases[] = {
      {{1, 2, 3, 0}, 2, 24, 0, 0.01, 1.05, "second order, then a walk at random"},
      {{0.3, 4, 5, 0}, 2, 20, 0.25, 0.1, 2, "fourth order with scatter of rounding"},
      {{2, 8, 0, 0.5}, 3, 18, 0.25, 0.2, 2, "eighth order, then a drift"},
      {{0.5, 4, 10, 0.005}, 3, 30, 0, 0.05, 1.3, "all three"},
      {{1, 1, 0, 0}, 4, 16, 0, 0.01, 1.05, "time-stepping alone"},
      {{0, 0, 2, 0}, 4, 16, 0.25, 0, 2, "a walk alone"},
      {{0, 0, 0, 2}, 4, 16, 0.25, 0, 2, "a drift alone"},
  };
  for (const auto& c : cases) {
    const ErrorFit fit = fit_error(points_of(c.known, c.first, c.last, c.decades), u);
    const auto near = [&](const std::optional<double>& got, double wanted, const char* what) {
      ASSERT_EQ(got.has_value(), wanted > 0) << c.why << ": " << what;
      if (!got) return;
      EXPECT_LE(std::fabs(std::log(*got / wanted)), std::log(c.factor_off)) << c.why << ": " << what;
    };
    near(fit.walk, c.known.b, "B");
    near(fit.drift, c.known.d, "D");
    ASSERT_EQ(fit.order.has_value(), c.known.c > 0) << c.why;
    EXPECT_NEAR(fit.order.value_or(0), c.known.p, c.order_off) << c.why;
    if (c.decades == 0) near(fit.constant, c.known.c, "C");
    EXPECT_FALSE(fit.bad) << c.why << ": residual " << fit.residual.value_or(-1);
  }
}

TEST(ErrorFit, SaysOfEveryPointWhatMakesIt) {
  // Exactly between: 1 n^-2 = 2^-53 sqrt(n) at n = 2^21.2.
  auto points = points_of({1, 2, 1, 0}, 1, 24, 0);
  points.insert(points.begin(), {1, 1, std::numeric_limits<double>::infinity()});
  points.push_back({0x1p-25, 0x1p25, 0});
  const ErrorFit fit = fit_error(points, u);
  ASSERT_EQ(fit.regimes.size(), points.size());
  EXPECT_EQ(fit.regimes.front(), ErrorRegime::failed);
  EXPECT_EQ(fit.regimes[1], ErrorRegime::unresolved) << "a relative error of 1/4";
  EXPECT_EQ(fit.regimes[2], ErrorRegime::stepping);
  EXPECT_EQ(fit.regimes[21], ErrorRegime::stepping) << "n = 2^21";
  EXPECT_EQ(fit.regimes[22], ErrorRegime::random_walk) << "n = 2^22";
  EXPECT_EQ(fit.regimes.back(), ErrorRegime::exact);
  ASSERT_TRUE(fit.crossing_dt.has_value());
  EXPECT_NEAR(std::log2(*fit.crossing_dt), -21.2, 0.1);
  EXPECT_EQ(fit.best_error, 0) << "no error at all is the least";
}

TEST(ErrorFit, TheBestStepIsTheMeasuredOne) {
  const auto points = points_of({1, 4, 1, 0}, 1, 20, 0);
  const ErrorFit fit = fit_error(points, u);
  for (const auto& p : points) EXPECT_GE(p.error, *fit.best_error);
  // n^-4 = 2^-53 n^(1/2) at n = 2^11.8.
  EXPECT_NEAR(std::log2(*fit.best_dt), -12, 1);
  EXPECT_NEAR(fitted_error(fit, *fit.best_dt, 1 / *fit.best_dt, u) / *fit.best_error, 1, 0.5);
}

TEST(ErrorFit, ABadFitIsAFinding) {
  // Jumps of three decades to and fro are of no order.
  std::vector<FitPoint> points;
  for (int k = 4; k < 20; ++k)
    points.push_back({std::ldexp(1.0, -k), std::ldexp(1.0, k), k % 2 == 0 ? 1e-3 : 1e-6});
  EXPECT_TRUE(fit_error(points, u).bad);
  EXPECT_FALSE(fit_error(points_of({1, 2, 1, 0}, 2, 24, 0.25), u).bad);
}

TEST(ErrorFit, WhatFallsWithMoreStepsIsNoRounding) {
  // A kink: two points by chance, then first order.
  const ErrorFit fit = fit_error({{2e-6, 1000, 2.888e-06},
                                  {1e-6, 2000, 7.938e-06},
                                  {5e-7, 4000, 7.323e-07},
                                  {2.5e-7, 8000, 3.668e-07},
                                  {1.25e-7, 16000, 1.841e-07},
                                  {6.25e-8, 32000, 9.255e-08}},
                                 u);
  EXPECT_NEAR(fit.order.value_or(0), 1, 0.2);
  EXPECT_FALSE(fit.walk || fit.drift);
  // One point behind many that are too coarse is no curve.
  std::vector<FitPoint> coarse;
  for (int k = 5; k < 15; ++k) coarse.push_back({std::ldexp(1.0, -k), std::ldexp(1.0, k), 5 - 0.1 * k});
  coarse.push_back({0x1p-15, 0x1p15, 0.09});
  const ErrorFit lone = fit_error(coarse, u);
  EXPECT_FALSE(lone.residual || lone.bad);
  EXPECT_EQ(lone.regimes.back(), ErrorRegime::unresolved);
}

TEST(ErrorFit, OfNothingSaysNothing) {
  const ErrorFit none = fit_error({}, u);
  EXPECT_TRUE(none.regimes.empty());
  EXPECT_FALSE(none.best_dt || none.order || none.residual);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ErrorFit failed = fit_error({{0.5, 2, nan}, {0.25, 4, nan}}, u);
  EXPECT_FALSE(failed.best_dt || failed.order || failed.residual || failed.bad);
  EXPECT_TRUE(std::isnan(fitted_error(failed, 0.5, 2, u)));
  // One point has no slope.
  const ErrorFit one = fit_error({{0.5, 2, 1e-3}}, u);
  EXPECT_FALSE(one.order.has_value());
  EXPECT_EQ(one.best_dt, 0.5);
}

TEST(ErrorFit, HoldsForTypesOfManyDigits) {
  const double fine = 0x1p-207;
  std::vector<FitPoint> points;
  for (int k = 2; k < 30; ++k) {
    const double n = std::ldexp(1.0, k);
    points.push_back({1 / n, n, std::max(std::pow(n, -10.0), 4 * std::sqrt(n) * fine)});
  }
  const ErrorFit fit = fit_error(points, fine);
  EXPECT_NEAR(*fit.order, 10, 0.01);
  EXPECT_NEAR(*fit.walk, 4, 0.1);
}

}  // namespace
}  // namespace ulpgate
