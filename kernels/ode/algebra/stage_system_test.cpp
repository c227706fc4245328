// Tests of the stages' linear equations: what a decomposition in long double gives, and what it refuses.
#include "kernels/ode/algebra/stage_system.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "reference/text/literal.hpp"

namespace ulpgate::ode {
namespace {

using Wide = MpfrReal<62>;
using System = StageSystem<Wide>;
using Vector = std::vector<Wide>;
using Rows = std::vector<std::vector<Wide>>;

const Rows coefficients{{Wide(5) / 12, Wide(-1) / 12}, {Wide(3) / 4, Wide(1) / 4}};  // Radau IIA of order 3

// The largest component's distance over its size.
[[nodiscard]] double distance(const Vector& a, const Vector& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, static_cast<double>(Wide(abs(Wide(a[i] - b[i])) / abs(b[i]))));
  return largest;
}

TEST(StageSystem, IsSolvedToLongDoublesDigitsAndWidenedToAllOfThem) {
  const Rows jacobian{{Wide(-1000), Wide(3), real<Wide>("0.1"), Wide(-2)}};
  System system;
  system.decompose(real<Wide>("0.7"), coefficients, jacobian, true);
  ASSERT_TRUE(system.is_narrow());
  // Corrections of the last digits of 600 are as small as this, which no long double is.
  const Vector residual{ldexp(Wide(1), -20000), ldexp(Wide(3), -20000), ldexp(Wide(-7), -20003),
                        ldexp(Wide(1), -20030)};
  const Vector narrow = system.solve(residual);
  ASSERT_TRUE(system.is_narrow());
  system.widen();
  EXPECT_FALSE(system.is_narrow());
  const Vector wide = system.solve(residual);
  EXPECT_GT(distance(narrow, wide), 1e-30);
  EXPECT_LT(distance(narrow, wide), 1e-15);
  const Vector inverse = system.inverse();
  Vector by_inverse(4, Wide(0));
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t c = 0; c < 4; ++c) by_inverse[r] += inverse[4 * r + c] * residual[c];
  }
  EXPECT_LT(distance(by_inverse, wide), 1e-57);
}

TEST(StageSystem, OfOneJacobianAStageIsThatOfOneForAllWhereTheyAreEqual) {
  const std::vector<Wide> j{Wide(-5), Wide(1), Wide(2), Wide(-8)};
  System one;
  System each;
  one.decompose(Wide(2), coefficients, {j}, false);
  each.decompose(Wide(2), coefficients, {j, j}, false);
  const Vector residual{Wide(1), Wide(-2), Wide(3), Wide(4)};
  EXPECT_EQ(one.solve(residual), each.solve(residual));
}

TEST(StageSystem, BeyondTheNarrowRangeOrWithoutANarrowSolutionIsWide) {
  System system;
  system.decompose(Wide(1), coefficients, {{ldexp(Wide(-1), 17000)}}, true);
  EXPECT_FALSE(system.is_narrow());
  const Vector residual{Wide(1), Wide(1)};
  EXPECT_TRUE(isfinite(system.solve(residual)[0]));
  // 1 - h a j of one stage is 2^-100, which long double takes for 0.
  const Rows one_stage{{Wide(1)}};
  system.decompose(Wide(1), one_stage, {{Wide(1) - ldexp(Wide(1), -100)}}, true);
  EXPECT_FALSE(system.is_narrow());
  EXPECT_EQ(system.solve({Wide(1)})[0], ldexp(Wide(1), 100));
}

TEST(LuDecomposition, OfAMatrixThatNeedsPivotsSolvesExactly) {
  // Of 3 whole unknowns, with a 0 first on the diagonal; all of it is exact in binary.
  LuDecomposition<double> lu;
  lu.decompose({0, 2, 1, 4, 8, 0, 2, 4, 0.5}, 3);
  ASSERT_TRUE(lu.is_regular());
  EXPECT_EQ(lu.solve({7, 20, 11.5}), (std::vector<double>{1, 2, 3}));
}

TEST(LuDecomposition, OfASingularMatrixOrOneOfNoNumbersIsNotRegular) {
  LuDecomposition<double> lu;
  lu.decompose({1, 2, 2, 4}, 2);
  EXPECT_FALSE(lu.is_regular());
  lu.decompose({1, HUGE_VAL, 2, 4}, 2);
  EXPECT_FALSE(lu.is_regular());
}

}  // namespace
}  // namespace ulpgate::ode
