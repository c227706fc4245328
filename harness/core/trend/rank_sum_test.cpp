// Mann and Whitney's test against counted orders, printed tables and the normal approximation.
#include "harness/core/trend/rank_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ulpgate {
namespace {

// Every way to choose which ranks are the second sample's: the definition of p.
double counted_p_value(double u, std::size_t n, std::size_t m) {
  std::vector<int> second(n + m, 0);
  std::fill(second.end() - static_cast<std::ptrdiff_t>(m), second.end(), 1);
  const double middle = static_cast<double>(n * m) / 2;
  double extreme = 0;
  double all = 0;
  do {
    double pairs = 0;
    double seen = 0;
    for (const int is_second : second) {
      if (is_second == 1) pairs += seen;
      if (is_second == 0) ++seen;
    }
    ++all;
    if (std::fabs(pairs - middle) >= std::fabs(u - middle)) ++extreme;
  } while (std::ranges::next_permutation(second).found);
  return extreme / all;
}

TEST(RankSum, EveryOrderOfSmallSamplesIsCounted) {
  for (const auto& [first, second] : std::vector<std::pair<std::vector<double>, std::vector<double>>>{
           {{1, 2, 3}, {4, 5, 6}},
           {{1, 4, 6}, {2, 3, 5}},
           {{1, 2, 3, 7}, {4, 5, 6}},
           {{9}, {1, 2, 3, 4}},
           {{5, 1, 8, 2, 11}, {3, 12, 7, 9, 10, 6}}}) {
    const RankSum found = rank_sum(first, second);
    EXPECT_NEAR(found.p_value, counted_p_value(found.u, first.size(), second.size()), 1e-14);
  }
}

TEST(RankSum, TheMiceOfMannAndWhitney) {
  // Critical values of U at 5 % of both sides: 23 of 10 and 10, 127 of 20 and 20 (Siegel, Nonparametric
  // Statistics, 1956, table K): the p of that U is at most 5 %, of the next one more.
  for (const auto& [n, critical] : std::vector<std::pair<std::size_t, std::size_t>>{{10, 23}, {20, 127}}) {
    for (const bool next : {false, true}) {
      // The second sample's values 0.5 + place of u, spread so that exactly u pairs are in order.
      std::vector<double> first;
      std::vector<double> second;
      std::size_t left = critical + (next ? 1 : 0);
      for (std::size_t i = 0; i < n; ++i) first.push_back(static_cast<double>(i));
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t below = std::min(left, n);
        second.push_back(static_cast<double>(below) - 0.5 + 1e-3 * static_cast<double>(i));
        left -= below;
      }
      const RankSum found = rank_sum(first, second);
      EXPECT_EQ(found.u, static_cast<double>(critical + (next ? 1 : 0)));
      EXPECT_EQ(found.p_value > 0.05, next) << found.p_value;
    }
  }
}

TEST(RankSum, TheApproximationContinuesTheExactDistribution) {
  std::vector<double> first;
  std::vector<double> second;
  for (int i = 0; i < 20; ++i) first.push_back(i * 1.0);
  for (int i = 0; i < 20; ++i) second.push_back(i * 1.0 + 4.3);
  const double exact = rank_sum(first, second).p_value;
  second.push_back(13.35);  // 420 pairs
  const double approximate = rank_sum(first, second).p_value;
  EXPECT_NEAR(approximate, exact, 0.15 * exact);
}

TEST(RankSum, TiesAndNothing) {
  const std::vector<double> same(8, 1.0);
  EXPECT_EQ(rank_sum(same, same).p_value, 1);
  EXPECT_EQ(rank_sum(same, same).u, 32);
  EXPECT_EQ(rank_sum(same, {}).p_value, 1);
  EXPECT_NEAR(least_p_value(3, 3), 0.1, 1e-15);
  EXPECT_NEAR(least_p_value(15, 15), 2.0 / 155117520, 1e-16);
  EXPECT_EQ(least_p_value(0, 3), 1);
}

TEST(RankSum, TheShiftIsThatOfTheSamples) {
  const std::vector<double> first = {1, 2, 3, 4, 100};
  const std::vector<double> second = {3.5, 4.5, 5.5, 6.5, 2.5};
  EXPECT_NEAR(rank_sum(first, second).shift, 1.5, 1.1);
  EXPECT_EQ(rank_sum(first, second).shift, -rank_sum(second, first).shift);
}

}  // namespace
}  // namespace ulpgate
