// Steps of a level: where they are found, and how often in simulated histories one is found or missed
// wrongly.
#include "harness/core/trend/level_steps.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <numbers>

#include "harness/core/arguments/random_words.hpp"
#include "harness/core/trend/time_noise.hpp"

namespace ulpgate {
namespace {

// Times of rows over runs of a shared machine: every run scatters by 2 % about its level, one in twenty is
// disturbed by up to 40 %, and a run as a whole is off by 0.5 %, what is left of its speed after the
// baseline.
class Simulation {
 public:
  Simulation(std::uint64_t seed, std::size_t rows, std::size_t runs) : stream_(seed, "trend", "history") {
    for (std::size_t i = 0; i < runs; ++i) of_run_.push_back(0.005 * normal(rows, i));
    for (std::size_t r = 0; r < rows; ++r) {
      std::vector<double> row;
      // Rows are not alike: the steadiest scatters half as much, the least steady one and a half times.
      const double deviation = 0.02 * (0.5 + fraction(r, 0, 3));
      for (std::size_t i = 0; i < runs; ++i) {
        const double spike = fraction(r, i, 2) < 0.05 ? 0.4 * fraction(r, i, 1) : 0;
        row.push_back(std::log(10.0 + static_cast<double>(r)) + of_run_[i] + deviation * normal(r, i) +
                      spike);
      }
      rows_.push_back(std::move(row));
    }
  }

  void slow_down(std::size_t row, std::size_t from, double factor) {
    for (std::size_t i = from; i < rows_[row].size(); ++i) rows_[row][i] += std::log(factor);
  }
  [[nodiscard]] const std::vector<std::vector<double>>& rows() const { return rows_; }

 private:
  [[nodiscard]] double fraction(std::size_t row, std::size_t run, std::size_t which) const {
    std::array<std::uint64_t, 4> words{};
    stream_.fill(row * 4096 + run, 0, words);
    return (static_cast<double>(words[which] >> 11U) + 0.5) * 0x1p-53;
  }
  [[nodiscard]] double normal(std::size_t row, std::size_t run) const {
    std::array<std::uint64_t, 2> words{};
    stream_.fill(row * 4096 + run, 1, words);
    const double u = (static_cast<double>(words[0] >> 11U) + 0.5) * 0x1p-53;
    const double v = (static_cast<double>(words[1] >> 11U) + 0.5) * 0x1p-53;
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
  }

  RandomStream stream_;
  std::vector<double> of_run_;
  std::vector<std::vector<double>> rows_;
};

struct Rates {
  std::size_t rows = 0, false_alarms = 0, histories_with_one = 0;
  std::size_t planted = 0, missed = 0, misplaced = 0;
};

// A hundred histories, in each of which one row is slower by `factor` from some run on.
Rates rates_of(std::size_t rows, std::size_t runs, double factor) {
  Rates rates;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Simulation history(seed, rows, runs);
    const std::size_t slow = seed * 7 % rows;
    const std::size_t at = 3 + seed % (runs - 5);
    history.slow_down(slow, at, factor);
    const double noise = common_scatter(history.rows());
    bool any = false;
    for (std::size_t r = 0; r < rows; ++r) {
      const auto steps = level_steps(history.rows()[r], noise);
      if (r == slow) {
        ++rates.planted;
        if (steps.empty()) ++rates.missed;
        if (!steps.empty() && steps.front().at != at) ++rates.misplaced;
        continue;
      }
      ++rates.rows;
      rates.false_alarms += steps.size();
      any = any || !steps.empty();
    }
    if (any) ++rates.histories_with_one;
  }
  std::cout << runs << " runs, slower by " << 100 * (factor - 1) << " %: " << rates.false_alarms
            << " false alarms in " << rates.rows << " rows (" << rates.histories_with_one
            << " of 100 histories), " << rates.missed << " missed and " << rates.misplaced << " misplaced of "
            << rates.planted << "\n";
  return rates;
}

TEST(LevelSteps, RatesInSimulatedHistories) {
  // A step that begins or ends with three runs beside two disturbed ones is what is missed of ten.
  const Rates ten = rates_of(200, 10, 1.2);
  EXPECT_LE(ten.histories_with_one, 2U);
  EXPECT_LE(ten.missed, 15U);
  EXPECT_LE(ten.misplaced, 5U);
  const Rates thirty = rates_of(200, 30, 1.2);
  EXPECT_LE(thirty.histories_with_one, 4U);
  EXPECT_EQ(thirty.missed, 0U);
  EXPECT_LE(thirty.misplaced, 10U);
  // What is near the noise is missed rather than seen where it is not.
  const Rates small = rates_of(50, 30, 1.1);
  EXPECT_LE(small.histories_with_one, 4U);
}

TEST(LevelSteps, WhereItIs) {
  const std::vector<double> flat(12, 3.0);
  EXPECT_TRUE(level_steps(flat, 0).empty());
  std::vector<double> two = flat;
  for (std::size_t i = 4; i < 8; ++i) two[i] = 3.5;
  const auto steps = level_steps(two, 0.01);
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].at, 4U);
  EXPECT_EQ(steps[1].at, 8U);
  EXPECT_EQ(steps[0].after, 3.5);
  // Two runs are an outlier, not a level; 4 % are less than is looked for.
  std::vector<double> brief = flat;
  brief[5] = brief[6] = 4;
  EXPECT_TRUE(level_steps(brief, 0.01).empty());
  std::vector<double> small = flat;
  for (std::size_t i = 6; i < 12; ++i) small[i] = 3.04;
  EXPECT_TRUE(level_steps(small, 0).empty());
  EXPECT_TRUE(level_steps({}, 0).empty());
}

TEST(LevelSteps, ScatterIsNotThatOfAStep) {
  std::vector<double> row;
  for (int i = 0; i < 40; ++i) row.push_back((i % 2 == 0 ? 0.01 : -0.01) + (i < 20 ? 0 : 5));
  EXPECT_NEAR(scatter(row), 1.4826 * 0.02 / std::sqrt(2.0), 1e-12);
  EXPECT_EQ(scatter({}), 0);
  EXPECT_EQ(common_scatter({}), 0);
}

TEST(TimeNoise, DisturbancesAddTime) {
  EXPECT_EQ(typical_time(std::vector<double>{5, 1, 9, 2, 1.1, 8, 7, 6}), 1.1);
  EXPECT_EQ(typical_time(std::vector<double>{4}), 4);
  EXPECT_TRUE(std::isnan(typical_time({})));
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({3, 1, 2, 10}), 2.5);
  EXPECT_EQ(baseline_noise({{1, 1, 1}}), 0);
  EXPECT_NEAR(baseline_noise({{1, 1, 1}, {1, 1, 1}, {1.1, 1.1, 1.1}}), std::log(1.1), 1e-15);
}

}  // namespace
}  // namespace ulpgate
