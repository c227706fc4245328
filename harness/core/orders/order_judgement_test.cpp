// Tests of what is said of a measured order, with errors and defects planted.
#include "harness/core/orders/order_judgement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "harness/core/orders/drift_measurement.hpp"
#include "harness/core/orders/ladder_measurement.hpp"

namespace ulpgate {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

OrderLadder ladder_of(const std::vector<double>& errors, std::optional<double> measured) {
  OrderLadder ladder;
  ladder.t_end = 1;
  long steps = 1;
  for (const double error : errors) {
    ladder.rungs.push_back({steps, 1.0 / static_cast<double>(steps), error, {}});
    steps *= 2;
  }
  ladder.measured_order = measured;
  return ladder;
}

TEST(OrderJudgement, OfLadders) {
  const std::vector<double> six = {1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5};
  const std::vector<double> five(six.begin(), six.end() - 1);
  struct Case {
    const char* why;
    std::vector<double> errors;
    std::optional<double> measured;
    std::optional<int> order;
    double tolerance;
    OrderVerdict verdict;
  };
  const std::vector<Case> cases = {
      {"the order of the method", six, 3.99, 4, 0.25, OrderVerdict::holds},
      {"symmetry gives more", six, 6.0, 4, 0.25, OrderVerdict::holds},
      {"an order lost", six, 3.0, 4, 0.25, OrderVerdict::too_low},
      {"just within the tolerance", six, 3.75, 4, 0.25, OrderVerdict::holds},
      {"just beyond it", six, 3.74, 4, 0.25, OrderVerdict::too_low},
      {"5 % of a high order are more than the tolerance", six, 19.0, 20, 0.25, OrderVerdict::holds},
      {"an order that is no number", six, nan, 4, 0.25, OrderVerdict::too_low},
      {"few rungs are not asymptotic", five, 1.0, 4, 0.25, OrderVerdict::not_judged},
      {"at the floor at once", six, std::nullopt, 4, 0.25, OrderVerdict::not_judged},
      {"no order to be held against", six, 1.0, std::nullopt, 0.25, OrderVerdict::not_judged},
      {"every error a NaN", std::vector(12, nan), std::nullopt, 4, 0.25, OrderVerdict::not_finite},
      {"every error infinite", std::vector(12, inf), std::nullopt, 4, 0.25, OrderVerdict::not_finite},
      {"two NaN, which once ended a ladder", {nan, nan}, std::nullopt, 4, 0.25, OrderVerdict::not_finite},
      {"one NaN among good ones", {1, 1e-1, nan, 1e-3, 1e-4, 1e-5}, 4.0, 4, 0.25, OrderVerdict::not_finite},
      {"a NaN where the method chooses its order", {nan}, std::nullopt, {}, 0.25, OrderVerdict::not_finite},
  };
  for (const auto& c : cases) {
    const auto judged = judge_order(ladder_of(c.errors, c.measured), c.order, c.tolerance);
    EXPECT_EQ(judged.verdict, c.verdict) << c.why << ": " << judged.why;
    EXPECT_EQ(judged.why.empty(), c.verdict == OrderVerdict::holds) << c.why;
  }
}

// Through the measurements themselves: a force that fails.
ode::SolvedProblem<double> broken(double force) {
  auto solved = ode::harmonic_oscillator(1.0);
  solved.problem.acceleration = [force](std::span<const double>, std::span<double> a) { a[0] = force; };
  solved.problem.slope = [force](const double&, std::span<const double> y, std::span<double> out) {
    out[0] = y[1];
    out[1] = force;
  };
  return solved;
}

TEST(OrderJudgement, A1APlantedNanOrInfinityIsWrong) {
  for (const double force : {nan, inf}) {
    const auto solved = broken(force);
    for (const auto* name : {"leapfrog", "yoshida6", "fehlberg78", "extrapolation8"}) {
      LadderOf<double> ladder(name, solved, 64);
      while (!ladder.complete()) (void)ladder.proceed(1);
      EXPECT_EQ(judge_order(ladder.ladder(), ode::find_integrator(name).order, 0.25).verdict,
                OrderVerdict::not_finite)
          << name;
      EXPECT_FALSE(ladder.ladder().measured_order.has_value()) << name;
      DriftOf<double> drift(name, solved, 8, 4);
      while (!drift.complete()) (void)drift.proceed(8);
      EXPECT_EQ(judge_drift(drift.drift()).verdict, OrderVerdict::not_finite) << name;
    }
    // An implicit method finds no stages.
    LadderOf<double> gauss("gauss2", solved, 64);
    while (!gauss.complete()) (void)gauss.proceed(1);
    EXPECT_TRUE(gauss.refusal().has_value());
  }
}

TEST(OrderJudgement, OfDrifts) {
  EnergyDrift drift;
  drift.add(1, 1e-3);
  EXPECT_EQ(judge_drift(drift).verdict, OrderVerdict::holds);
  drift.add(2, inf);
  EXPECT_EQ(judge_drift(drift).verdict, OrderVerdict::not_finite);
  drift.add(3, nan);
  EXPECT_EQ(judge_drift(drift).verdict, OrderVerdict::not_finite);
}

}  // namespace
}  // namespace ulpgate
