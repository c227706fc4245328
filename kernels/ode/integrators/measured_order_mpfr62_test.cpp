// Measured orders of all integrators in mpfr62.
#include "kernels/ode/testing/measured_order_suite.hpp"
#include "reference/text/literal.hpp"

namespace ulpgate::ode::testing {
namespace {

INSTANTIATE_TYPED_TEST_SUITE_P(Mpfr62, MeasuredOrder, MpfrReal<62>);

// The high orders down to the rounding floor of 62 digits, on an interval short enough for that many steps.
TEST(HighOrder, HoldsDownToTheRoundingFloor) {
  using Real = MpfrReal<62>;
  const SolvedProblem<Real> solved = pendulum(Real(1), Real(Real(1) / 2));
  const Real floor = real<Real>("1e-57");
  for (const IntegratorInfo& info : integrators()) {
    if (!info.order || *info.order < 8) continue;
    const Real t = ldexp(Real(1), *info.order < 10 ? -9 : -3);
    const std::vector<Rung> ladder = error_ladder<Real>(info.name, solved, t, 1, 1L << 14, floor);
    ASSERT_GE(ladder.size(), 2U) << info.name;
    EXPECT_LT(ladder.back().error, std::ldexp(1e-57, *info.order + 1)) << info.name;
    for (std::size_t i = 2; i < ladder.size(); ++i) {
      EXPECT_NEAR(ladder[i].order, *info.order, 0.1)
          << info.name << " at " << ladder[i].steps << " steps, error " << ladder[i].error;
    }
  }
}

}  // namespace
}  // namespace ulpgate::ode::testing
