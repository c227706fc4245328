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
      sweep.find(bodies, pairs);
      ASSERT_EQ(pairs, brute_force(bodies)) << c.why << ", step " << step;
      for (CoarseBody& b : bodies) {
        if (b.sphere)
          b = ball(b.centre[0] + place(random) / 5, b.centre[1] + place(random) / 5, b.centre[2], b.reach);
      }
    }
  }
}

}  // namespace
}  // namespace ulpgate::dem
