// Networks of contacts against the closed forms of one and two bodies.
#include "harness/core/step_limits/scenes/contact_network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "harness/core/step_limits/scenes/limit_scenes.hpp"

namespace ulpgate {
namespace {

NetworkBody ball(double mass, double radius) {
  return {false, mass, 2 * mass * radius * radius / 5};
}

ContactNetwork pair_of(double kn, double ks) {
  return {{ball(3, 0.5), ball(3, 0.5)}, {{0, 1, {0.6, 0, 0.8}, 0.5, 0.5, kn, ks, 0, 0}}};
}

TEST(ContactNetwork, OfTwoFreeSpheres) {
  // omega_n^2 = 2 kn/m, omega_t^2 = 7 ks/m.
  EXPECT_NEAR(undamped_critical_step(pair_of(12, 0)), 2 / std::sqrt(2 * 12 / 3.0), 1e-12);
  EXPECT_NEAR(undamped_critical_step(pair_of(0, 12)), 2 / std::sqrt(7 * 12 / 3.0), 1e-12);
  EXPECT_NEAR(undamped_critical_step(pair_of(12, 3)), 2 / std::sqrt(2 * 12 / 3.0), 1e-12);
  EXPECT_NEAR(undamped_critical_step(pair_of(12, 4)), 2 / std::sqrt(7 * 4 / 3.0), 1e-12);
  EXPECT_EQ(undamped_critical_step(pair_of(0, 0)), 0);
}

TEST(ContactNetwork, OfADampedContactOnAWall) {
  for (const double zeta : {0.0, 0.05, 0.5, 0.88, 3.0}) {
    const double omega = 7;
    const ContactNetwork network{{{true, 0, 0}, {false, 2, 0}},
                                 {{0, 1, {0, 1, 0}, 0, 0, 2 * omega * omega, 0, 2 * 2 * zeta * omega, 0}}};
    const CriticalMode mode = critical_mode(network);
    EXPECT_NEAR(mode.step * omega, 2 * (std::sqrt(1 + zeta * zeta) - zeta), 1e-9) << zeta;
    EXPECT_NEAR(std::abs(mode.shape[1][1]), 1, 1e-9);
    EXPECT_NEAR(mode.shape[1][0], 0, 1e-6);
    EXPECT_EQ(mode.shape[0][1], 0);
  }
}

// A contact of two bodies turns anywhere, and the frequency stays.
TEST(ContactNetwork, DoesNotKnowDirections) {
  ContactNetwork network = pair_of(12, 5);
  const double step = critical_mode(network).step;
  for (double angle = 0; angle < 3; angle += 0.3) {
    network.springs[0].normal = {std::cos(angle), std::sin(angle), 0};
    EXPECT_NEAR(critical_mode(network).step, step, 1e-10 * step);
    EXPECT_NEAR(block_bound_step(network), std::numbers::sqrt2 / std::sqrt(3.5 * 5 / 3.0), 1e-10);
  }
}

TEST(ContactNetwork, IsThatOfTheEngine) {
  for (const double poisson : {0.0, 0.45}) {
    const LimitScene s = free_pair(poisson, {1, 2, 3});
    const auto engine = dem::make_engine("double", dem::Level::own, s.scene, {});
    ASSERT_NE(engine, nullptr);
    engine->step(1);
    const ContactNetwork network = network_of(*engine, s.scene.law, s.walls);
    ASSERT_EQ(network.springs.size(), 1U);
    const double kn = 1e7 * 0.01;
    EXPECT_NEAR(network.springs[0].kn, kn, 1e-9 * kn);
    EXPECT_NEAR(network.springs[0].ks, poisson * kn, 1e-9 * kn);
    const double square = poisson > 0 ? 7 * poisson * kn / engine->mass(0) : 2 * kn / engine->mass(0);
    EXPECT_NEAR(undamped_critical_step(network), 2 / std::sqrt(square), 1e-6 / std::sqrt(square));
  }
}

// The bound from single bodies holds in every orientation, with dashpots too.
TEST(ContactNetwork, IsBoundedByItsBodies) {
  std::vector<LimitScene> list{boxed_packing(0.003), boxed_packing(0.9), hertz_on_wall()};
  for (const std::string& turn : packing_turns()) {
    for (const char* lattice : {"chain", "cubic", "fcc"}) list.push_back(bonded_packing(lattice, 0.3, turn));
  }
  for (const LimitScene& s : list) {
    const auto engine = dem::make_engine("double", dem::Level::own, s.scene, {});
    ASSERT_NE(engine, nullptr);
    engine->step(1);
    const ContactNetwork network = network_of(*engine, s.scene.law, s.walls);
    const double limit = critical_mode(network).step;
    EXPECT_LE(limit, undamped_critical_step(network) * (1 + 1e-9)) << s.name;
    EXPECT_LE(block_bound_step(network), limit * (1 + 1e-9)) << s.name;
    EXPECT_GE(block_bound_step(network), 0.5 * limit) << s.name;
  }
}

}  // namespace
}  // namespace ulpgate
