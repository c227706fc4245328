// Networks of contacts against the closed forms of one and two bodies, and against runs of their own
// equations.
#include "harness/core/contact_network/contact_network.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
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

// omega^2 = 2 kr/I of a relative turn, in any direction, where no shear is.
TEST(ContactNetwork, OfABondThatBends) {
  ContactNetwork network = pair_of(0, 0);
  network.springs[0].moment = 5;
  EXPECT_NEAR(largest_frequency(network), std::sqrt(2 * 5 / (0.4 * 3 * 0.25)), 1e-12);
  network.bodies[0].fixed = true;
  EXPECT_NEAR(largest_frequency(network), std::sqrt(5 / (0.4 * 3 * 0.25)), 1e-12);
  network.bodies[1].inertia = 0;
  EXPECT_EQ(largest_frequency(network), 0) << "it cannot turn";
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

using Vector3 = Eigen::Vector3d;

struct Motion {
  Vector3 moved = Vector3::Zero(), turned = Vector3::Zero();
};

// The largest displacement (m) or turn after steps of the leapfrog, force by force, from some of 1; ends
// early where it passes 1e6.
double moved_after(const ContactNetwork& network, double dt, int steps) {
  std::vector<Motion> at(network.bodies.size());
  std::vector<Motion> speed(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (network.bodies[i].fixed) continue;
    const double phase = static_cast<double>(i);
    at[i] = {{std::sin(phase), std::cos(3 * phase), 0.3}, {0.2, std::sin(5 * phase + 1), 0.7}};
  }
  double largest = 1;
  for (int n = 0; n < steps && largest < 1e6; ++n) {
    std::vector<Motion> loads(at.size());
    for (const NetworkSpring& s : network.springs) {
      const Vector3 normal(s.normal[0], s.normal[1], s.normal[2]);
      const auto slip = [&](const std::vector<Motion>& of) -> Vector3 {
        const Vector3 end1 = of[s.first].moved + of[s.first].turned.cross(s.arm1 * normal);
        return of[s.second].moved - of[s.second].turned.cross(s.arm2 * normal) - end1;
      };
      const auto split = [&](const Vector3& u, double along, double across) -> Vector3 {
        const Vector3 part = u.dot(normal) * normal;
        return along * part + across * (u - part);
      };
      const Vector3 force = split(slip(at), s.kn, s.ks) + split(slip(speed), s.cn, s.cs);
      const Vector3 moment = s.moment * (at[s.second].turned - at[s.first].turned);
      loads[s.first].moved += force;
      loads[s.first].turned += (s.arm1 * normal).cross(force) + moment;
      loads[s.second].moved -= force;
      loads[s.second].turned += (s.arm2 * normal).cross(force) - moment;
    }
    for (std::size_t i = 0; i < at.size(); ++i) {
      const NetworkBody& body = network.bodies[i];
      if (body.fixed) continue;
      speed[i].moved += dt / body.mass * loads[i].moved;
      at[i].moved += dt * speed[i].moved;
      if (body.inertia == 0) continue;
      speed[i].turned += dt / body.inertia * loads[i].turned;
      at[i].turned += dt * speed[i].turned;
    }
    largest = 0;
    for (const Motion& m : at) largest = std::fmax(largest, std::fmax(m.moved.norm(), m.turned.norm()));
  }
  return largest;
}

// Springs of every kind between unlike bodies, one of them held and one that cannot turn: its own equations
// grow above the critical step and not below.
TEST(ContactNetwork, IsWhatItsEquationsDo) {
  ContactNetwork network{{{true, 0, 0}, ball(2, 0.3), ball(5, 0.5), {false, 1, 0}}, {}};
  network.springs = {{0, 1, {0, 1, 0}, 0, 0.29, 20, 9, 0, 0},
                     {1, 2, {0.6, 0, 0.8}, 0.29, 0.48, 15, 12, 0, 0, 0.7},
                     {2, 3, {0, 0.28, 0.96}, 0.5, 0.2, 30, 11, 0, 0},
                     {3, 1, {-0.8, 0.6, 0}, 0.2, 0.3, 8, 3, 0, 0, 0.2}};
  for (const double dashpots : {0.0, 0.02, 0.5}) {
    for (NetworkSpring& s : network.springs) {
      s.cn = dashpots * s.kn;
      s.cs = dashpots * s.ks;
    }
    const double step = critical_mode(network).step;
    EXPECT_LT(moved_after(network, 0.99 * step, 3000), 1e3) << dashpots;
    EXPECT_GE(moved_after(network, 1.01 * step, 3000), 1e6) << dashpots;
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
