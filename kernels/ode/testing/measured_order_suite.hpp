// The tests that every integrator passes in every type: included by one translation unit per type.
#pragma once

#include <gtest/gtest.h>

#include "kernels/ode/integrators/error_ladder.hpp"

namespace ulpgate::ode::testing {

template <class Real>
class MeasuredOrder : public ::testing::Test {};
TYPED_TEST_SUITE_P(MeasuredOrder);

// The order on the last rung above the floor.
TYPED_TEST_P(MeasuredOrder, ErrorFallsByTwoToTheOrderPerHalving) {
  using Real = TypeParam;
  constexpr int bits = std::numeric_limits<Real>::digits;
  const Real floor = ldexp(Real(1), 12 - bits);
  for (const IntegratorInfo& info : integrators()) {
    if (!info.order) continue;
    for (const SolvedProblem<Real>& solved : standard_problems<Real>()) {
      if (info.kind == IntegratorKind::splitting && !solved.problem.acceleration) continue;
      const std::vector<Rung> ladder = error_ladder<Real>(info.name, solved, Real(1), 2, 256, floor);
      if (ladder.size() < 2) {
        // The errors of the highest orders are at the floor of a narrow type at once.
        ASSERT_GT(7 * *info.order, bits) << info.name << " " << solved.name;
        EXPECT_LT(error_at(info.name, solved, Real(1), 16), floor) << info.name << " " << solved.name;
        continue;
      }
      // Where few halvings fit between 1 and the floor, the order is not yet asymptotic.
      // Dormand and Prince's is asymptotic a halving later.
      const std::size_t few = info.name == "dormand_prince54" ? 6 : 5;
      const double tolerance = ladder.size() > few ? 0.05 : ladder.size() > 3 ? 0.2 : 0.1 * *info.order;
      EXPECT_NEAR(ladder.back().order, *info.order, tolerance)
          << info.name << " " << solved.name << " at " << ladder.back().steps << " steps, error "
          << ladder.back().error;
    }
  }
}

TYPED_TEST_P(MeasuredOrder, BulirschStoerReachesItsTolerance) {
  using Real = TypeParam;
  for (const SolvedProblem<Real>& solved : standard_problems<Real>()) {
    for (const int sign : {1, -1}) {
      // 2^8 units of rounding a step, some hundred steps at 62 digits.
      EXPECT_LT(error_at("bulirsch_stoer", solved, Real(sign), 1),
                ldexp(std::numeric_limits<Real>::epsilon(), 18))
          << solved.name << " to t = " << sign;
    }
  }
}

// The given velocity is that of half a step earlier (physics: v(0) used as v(-h/2)); given the true one of
// then, the positions are of order 2.
TYPED_TEST_P(MeasuredOrder, LeapfrogStartedAtTheHalfStepIsOfOrderTwo) {
  using Real = TypeParam;
  using std::abs, std::log2;
  SolvedProblem<Real> solved = pendulum(Real(1), Real(Real(1) / 2));
  std::vector<Real> errors;
  for (const long steps : {128L, 256L}) {
    const Real half_step = Real(1) / static_cast<Real>(2 * steps);
    solved.problem.start[1] = solved.exact(Real(-half_step))[1];
    const std::vector<Real> y = integrate<Real>("leapfrog", solved.problem, Real(1), steps);
    errors.push_back(abs(y[0] - solved.exact(Real(1))[0]));
  }
  EXPECT_NEAR(static_cast<double>(log2(Real(errors[0] / errors[1]))), 2, 0.02);
}

REGISTER_TYPED_TEST_SUITE_P(MeasuredOrder, ErrorFallsByTwoToTheOrderPerHalving,
                            BulirschStoerReachesItsTolerance, LeapfrogStartedAtTheHalfStepIsOfOrderTwo);

}  // namespace ulpgate::ode::testing
