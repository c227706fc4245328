// Tests of the stages' linear equations: what a decomposition in long double gives, and what it refuses.
#include "kernels/ode/algebra/stage_system.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "reference/text/literal.hpp"

namespace ulpgate::ode {
namespace {

using Wide = MpfrReal<62>;
using System = StageSystem<Wide>;
using Rows = std::vector<std::vector<Wide>>;

const Rows coefficients{{Wide(5) / 12, Wide(-1) / 12}, {Wide(3) / 4, Wide(1) / 4}};  // Radau IIA of order 3

[[nodiscard]] System::Vector vector_of(const std::vector<Wide>& values) {
  System::Vector v(static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) v(static_cast<Eigen::Index>(i)) = values[i];
  return v;
}

// The largest component's distance over its size.
[[nodiscard]] double distance(const System::Vector& a, const System::Vector& b) {
  double largest = 0;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    largest = std::max(largest, static_cast<double>(Wide(abs(Wide(a(i) - b(i))) / abs(b(i)))));
  return largest;
}

TEST(StageSystem, IsSolvedToLongDoublesDigitsAndWidenedToAllOfThem) {
  const Rows jacobian{{Wide(-1000), Wide(3), real<Wide>("0.1"), Wide(-2)}};
  System system;
  system.decompose(real<Wide>("0.7"), coefficients, jacobian, true);
  ASSERT_TRUE(system.is_narrow());
  // Corrections of the last digits of 600 are as small as this, which no long double is.
  const System::Vector residual = vector_of(
      {ldexp(Wide(1), -20000), ldexp(Wide(3), -20000), ldexp(Wide(-7), -20003), ldexp(Wide(1), -20030)});
  const System::Vector narrow = system.solve(residual);
  ASSERT_TRUE(system.is_narrow());
  system.widen();
  EXPECT_FALSE(system.is_narrow());
  const System::Vector wide = system.solve(residual);
  EXPECT_GT(distance(narrow, wide), 1e-30);
  EXPECT_LT(distance(narrow, wide), 1e-15);
  EXPECT_LT(distance(system.inverse() * residual, wide), 1e-57);
}

TEST(StageSystem, OfOneJacobianAStageIsThatOfOneForAllWhereTheyAreEqual) {
  const std::vector<Wide> j{Wide(-5), Wide(1), Wide(2), Wide(-8)};
  System one;
  System each;
  one.decompose(Wide(2), coefficients, {j}, false);
  each.decompose(Wide(2), coefficients, {j, j}, false);
  const System::Vector residual = vector_of({Wide(1), Wide(-2), Wide(3), Wide(4)});
  EXPECT_EQ(one.solve(residual), each.solve(residual));
}

TEST(StageSystem, BeyondTheNarrowRangeOrWithoutANarrowSolutionIsWide) {
  System system;
  system.decompose(Wide(1), coefficients, {{ldexp(Wide(-1), 17000)}}, true);
  EXPECT_FALSE(system.is_narrow());
  const System::Vector residual = vector_of({Wide(1), Wide(1)});
  EXPECT_TRUE(isfinite(system.solve(residual)(0)));
  // 1 - h a j of one stage is 2^-100, which long double takes for 0.
  const Rows one_stage{{Wide(1)}};
  system.decompose(Wide(1), one_stage, {{Wide(1) - ldexp(Wide(1), -100)}}, true);
  EXPECT_FALSE(system.is_narrow());
  EXPECT_EQ(system.solve(vector_of({Wide(1)}))(0), ldexp(Wide(1), 100));
}

}  // namespace
}  // namespace ulpgate::ode
