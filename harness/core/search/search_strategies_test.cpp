// Tests of two strategies of the search on planted errors: bands and pools find what single points do not
// show.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/core/search/search_bands.hpp"
#include "harness/core/search/search_pool.hpp"

namespace ulpgate {
namespace {

using Position = __int128;
using Box = SearchBox<Position>;

double noise(Position x) {
  return static_cast<double>(SearchRandom(static_cast<std::uint64_t>(x)).word() >> 11U) * 0x1p-53;
}

TEST(SearchBands, EndWhereErrorsAreLargeOnTheWhole) {
  constexpr Position width = Position(1) << 40;
  constexpr Position edge = width / 3;
  // The amplitude rises by a third up to the edge and falls there by half; the largest single errors lie
  // elsewhere.
  const auto error = [&](Position x) {
    const double t = static_cast<double>(x) / static_cast<double>(edge);
    const bool lucky = x > width / 2 && static_cast<std::uint64_t>(x) % 9973 == 0;
    return lucky ? 2.0 : (x < edge ? 0.75 + t / 4 : 0.5) * noise(x);
  };
  SearchBands<Position> bands;
  Box root;
  root.high[0] = width;
  bands.start(root, 1, 1U << 24U);
  SearchRandom random(5);
  for (int generation = 0; generation < 30 && !bands.idle(); ++generation) {
    std::vector<double> scores;
    for (const Box& box : bands.boxes()) {
      std::vector<double> errors;
      for (std::size_t i = 0; i < SearchBands<Position>::samples; ++i)
        errors.push_back(error(box.draw(random, 1)[0]));
      scores.push_back(SearchBands<Position>::score(errors));
    }
    bands.advance(scores, 1);
  }
  ASSERT_TRUE(bands.idle());
  ASSERT_FALSE(bands.empty());
  const Box& band = bands.chosen(random);
  EXPECT_LE(band.low[0], edge);
  EXPECT_GT(band.high[0], edge - edge / 20);
  EXPECT_LE(band.high[0] - band.low[0], Position(1) << 24);
}

TEST(SearchBands, LookBesideTheBestOfThem) {
  // Every box of 2^24 positions has an amplitude of its own; the beam starts in one of them.
  const auto amplitude = [](Position x) { return 1 + noise(x >> 24); };
  SearchBands<Position> bands;
  Box root;
  root.high[0] = Position(1) << 44;
  Box one;
  one.low[0] = Position(5) << 40;
  one.high[0] = one.low[0] + (Position(1) << 23);
  bands.start(one, 1, 1U << 22U);
  SearchRandom random(5);
  const auto generation = [&] {
    std::vector<double> scores;
    for (const Box& box : bands.boxes()) {
      EXPECT_GE(box.low[0], root.low[0]);
      EXPECT_LE(box.high[0], root.high[0]);
      EXPECT_LT(box.low[0], box.high[0]);
      scores.push_back(amplitude(box.low[0]));
    }
    bands.advance(scores, 1);
  };
  while (!bands.idle()) generation();
  const double first = bands.chosen(random).error;
  double best = first;
  for (int turn = 0; turn < 60; ++turn) {
    bands.start_beside(bands.chosen(random), random, root, 1);
    EXPECT_EQ(bands.boxes().size(), 16U);
    generation();
    EXPECT_TRUE(bands.idle());
    best = std::max(best, bands.chosen(random).error);
  }
  EXPECT_LT(first, 1.95);
  EXPECT_GT(best, 1.98) << "of a thousand amplitudes below 2";
}

TEST(SearchPool, DifferencesOfLargeErrorsLeadToLargerOnes) {
  // Three periods that no step of the window shares.
  const auto error = [](Position x) {
    const auto t = static_cast<double>(x);
    return std::cos(t * 0.7548776662) + std::cos(t * 1.3247179572) + std::cos(t * 2.2360679775 + 1);
  };
  Box domain;
  domain.low[0] = -(Position(1) << 40);
  domain.high[0] = Position(1) << 40;
  SearchRandom random(3);
  SearchPool<Position> pool(48);
  const int draws = 2000;
  double random_sum = 0;
  double random_most = -3;
  for (int i = 0; i < draws; ++i) {
    const SearchPoint<Position> x = {domain.near(12345, 16, 0, random)};
    pool.add(x, error(x[0]));
    random_sum += error(x[0]);
    random_most = std::max(random_most, error(x[0]));
  }
  ASSERT_TRUE(pool.is_useful());
  double combined_sum = 0;
  double combined_most = -3;
  for (int i = 0; i < draws; ++i) {
    const SearchPoint<Position> x = pool.combined(random, domain, 1);
    ASSERT_TRUE(domain.contains(x, 1));
    combined_sum += error(x[0]);
    combined_most = std::max(combined_most, error(x[0]));
    pool.add(x, error(x[0]));
  }
  EXPECT_LT(random_sum / draws, 0.2);
  EXPECT_GT(combined_sum / draws, 1.5);
  EXPECT_GT(combined_most, random_most);
}

TEST(SearchPool, KeepsEachPointOnce) {
  SearchPool<Position> pool(48);
  for (int repeat = 0; repeat < 3; ++repeat)
    for (Position x = 0; x < 7; ++x) pool.add({x}, 1.0);
  EXPECT_FALSE(pool.is_useful()) << "seven points";
  pool.add({7}, 0.5);
  EXPECT_TRUE(pool.is_useful());
}

}  // namespace
}  // namespace ulpgate
