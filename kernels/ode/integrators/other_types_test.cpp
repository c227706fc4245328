// Every integrator in the types whose order is not measured: it runs there and is as accurate as it should
// be.
#include <gtest/gtest.h>

#include "kernels/ode/integrators/error_ladder.hpp"

namespace ulpgate::ode::testing {
namespace {

template <class Real>
class OtherTypes : public ::testing::Test {};
using Types = ::testing::Types<float, long double, CppBinFloatReal<62>>;
TYPED_TEST_SUITE(OtherTypes, Types);

// In double the same errors, up to the rounding of the coarser of the two types.
TYPED_TEST(OtherTypes, HaveTheErrorsOfDouble) {
  using Real = TypeParam;
  const SolvedProblem<Real> solved = pendulum(Real(1), Real(Real(1) / 2));
  const SolvedProblem<double> in_double = pendulum(1.0, 0.5);
  const double rounding = 64 * std::max(static_cast<double>(std::numeric_limits<Real>::epsilon()), 0x1p-52);
  for (const IntegratorInfo& info : integrators()) {
    const double wanted = error_at(info.name, in_double, 1.0, 8);
    const auto got = static_cast<double>(error_at(info.name, solved, Real(1), 8));
    EXPECT_NEAR(got, wanted, rounding) << info.name;
  }
}

}  // namespace
}  // namespace ulpgate::ode::testing
