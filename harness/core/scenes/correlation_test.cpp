// Tests of correlation in chunks.
#include "harness/core/scenes/correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ulpgate {
namespace {

TEST(Pearson, KnownValues) {
  const std::vector<double> up = {1, 2, 3, 4};
  const std::vector<double> down = {8, 6, 4, 2};
  const std::vector<double> flat = {5, 5, 5, 5};
  const std::vector<double> other = {1, 3, 2, 4};
  EXPECT_DOUBLE_EQ(pearson(up, up), 1);
  EXPECT_DOUBLE_EQ(pearson(up, down), -1);
  EXPECT_DOUBLE_EQ(pearson(up, other), 0.8);
  EXPECT_EQ(pearson(flat, flat), 1) << "equal, though constant";
  EXPECT_EQ(pearson(up, flat), 0) << "only one varies";
  EXPECT_EQ(pearson(up, std::vector<double>{1, 2, NAN, 4}), 0) << "left the numbers";
}

TEST(Correlation, TheFirstBadChunkEndsTheTruth) {
  std::vector<double> a;
  std::vector<double> b;
  for (int i = 0; i < 95; ++i) {
    a.push_back(std::sin(i));
    b.push_back(i < 30 ? std::sin(i) : std::cos(i));
  }
  const CorrelationRule rule{10, 0.9};
  const auto p = chunk_correlations(a, b, rule);
  EXPECT_EQ(p.size(), 9U) << "the last five records fill no chunk";
  EXPECT_EQ(true_records(p, rule), 30U);
  EXPECT_EQ(true_records(chunk_correlations(a, a, rule), rule), 90U);
  const std::vector<double> good = {1, 1, 1};
  EXPECT_EQ(true_records(std::span(good).first(2), rule), 20U) << "no chunk behind the last is looked at";
}

}  // namespace
}  // namespace ulpgate
