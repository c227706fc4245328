// Tests of the collider's broad phase against brute force.
#include "kernels/dem/step/broad_phase.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace ulpgate::dem {
namespace {

CoarseBody ball(double x, double y, double z, double reach) {
  CoarseBody b;
  b.low = {x - reach, y - reach, z - reach};
  b.high = {x + reach, y + reach, z + reach};
  b.movable = b.sphere = true;
  b.centre = {x, y, z};
  b.reach = reach;
  return b;
}

// Every pair that may touch, by its definition.
std::vector<BodyPair> brute_force(const std::vector<CoarseBody>& bodies) {
  std::vector<BodyPair> pairs;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      const CoarseBody& a = bodies[i];
      const CoarseBody& b = bodies[j];
      bool meet = a.movable || b.movable;
      for (std::size_t k = 0; k < 3; ++k) meet = meet && a.low[k] <= b.high[k] && b.low[k] <= a.high[k];
      if (meet && a.sphere && b.sphere) {
        double d2 = 0;
        for (std::size_t k = 0; k < 3; ++k) d2 += (a.centre[k] - b.centre[k]) * (a.centre[k] - b.centre[k]);
        meet = d2 <= (a.reach + b.reach) * (a.reach + b.reach);
      }
      if (meet) pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
    }
  }
  return pairs;
}

TEST(BroadPhase, AgreesWithBruteForceWhileBodiesMove) {
  struct Case {
    int balls;
    double size, least, most;
    const char* why;
  };
  const Case cases[] = {
      {300, 1, 0.02, 0.02, "equal spheres"},
      {300, 1, 0.001, 0.2, "sizes 1 to 200: the widest are tested against all"},
      {300, 0.01, 0.02, 0.03, "all overlap"},
      {300, 1e9, 0.02, 0.03, "far apart"},
      {2, 1, 0.5, 0.5, "two"},
      {1, 1, 0.5, 0.5, "one"},
  };
  for (const Case& c : cases) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> place(-c.size, c.size);
    std::uniform_real_distribution<double> radius(c.least, std::nextafter(c.most, 1e9));
    std::vector<CoarseBody> bodies;
    for (int i = 0; i < c.balls; ++i)
      bodies.push_back(ball(place(random), place(random), place(random), radius(random)));
    CoarseBody floor;
    const double inf = std::numeric_limits<double>::infinity();
    floor.low = {-inf, -0.01, -inf};
    floor.high = {inf, 0.01, inf};
    bodies.push_back(floor);
    BroadPhase sweep;
    for (int step = 0; step < 5; ++step) {
      std::vector<BodyPair> pairs;
      ASSERT_TRUE(sweep.find(bodies, pairs, bodies.size() * bodies.size()));
      ASSERT_EQ(pairs, brute_force(bodies)) << c.why << ", step " << step;
      for (CoarseBody& b : bodies) {
        if (b.sphere)
          b = ball(b.centre[0] + place(random) / 5, b.centre[1] + place(random) / 5, b.centre[2], b.reach);
      }
    }
  }
}

CoarseBody box(std::array<double, 3> low, std::array<double, 3> high, bool movable) {
  CoarseBody b;
  b.low = low;
  b.high = high;
  b.movable = movable;
  return b;
}

// Bodies that are no spheres are tested against all: by each of their three extents, against each other once,
// and never against themselves.
TEST(BroadPhase, BoxesMeetOnlyWhereAllThreeExtentsDo) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-1, 1);
  std::vector<CoarseBody> bodies;
  for (int i = 0; i < 40; ++i) bodies.push_back(ball(place(random), place(random), place(random), 0.05));
  for (int i = 0; i < 12; ++i) {
    std::array<double, 3> low{};
    std::array<double, 3> high{};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = place(random);
      high[k] = low[k] + 0.6;
    }
    bodies.push_back(box(low, high, i % 3 != 0));
  }
  // Side by side along one axis each, and two that share a face.
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<double, 3> low = {5, 5, 5};
    low[k] = 8;
    bodies.push_back(box(low, {low[0] + 1, low[1] + 1, low[2] + 1}, true));
  }
  bodies.push_back(box({5, 5, 5}, {6, 6, 6}, true));
  bodies.push_back(box({6, 5, 5}, {7, 6, 6}, true));
  BroadPhase sweep;
  std::vector<BodyPair> pairs;
  EXPECT_TRUE(sweep.find(bodies, pairs, 10000));
  EXPECT_EQ(pairs, brute_force(bodies));
  const auto last = static_cast<std::int32_t>(bodies.size()) - 1;
  EXPECT_EQ(std::count(pairs.begin(), pairs.end(), BodyPair{last - 1, last}), 1) << "they share a face";
}

// The cells are as wide as the widest sphere wherever the spheres lie, all of them below zero here.
TEST(BroadPhase, FindsPairsOnOneSideOfTheOriginToo) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-2, 0);
  std::vector<CoarseBody> bodies;
  for (int i = 0; i < 300; ++i)
    bodies.push_back(ball(place(random), place(random) + 0.02, place(random) + 0.02, 0.06));
  BroadPhase sweep;
  std::vector<BodyPair> pairs;
  EXPECT_TRUE(sweep.find(bodies, pairs, 10000));
  EXPECT_EQ(pairs, brute_force(bodies));
  EXPECT_GT(pairs.size(), 20U);
}

TEST(BroadPhase, SpheresThatJustTouchAreCandidatesAlongEveryAxis) {
  for (const auto& centre : {std::array<double, 3>{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {-2, 0, 0}}) {
    BroadPhase sweep;
    std::vector<BodyPair> pairs;
    EXPECT_TRUE(sweep.find({ball(0, 0, 0, 1), ball(centre[0], centre[1], centre[2], 1)}, pairs, 10000));
    EXPECT_EQ(pairs, (std::vector<BodyPair>{{0, 1}}));
  }
}

}  // namespace
}  // namespace ulpgate::dem
