// Tests that every scene gives what it has given: sums over its state and its energies after some hundred
// steps, pinned. A change of a law or of the order of a step changes all trajectories: a decision, after
// which
//   ULPGATE_PRINT_PINS=1 dem_test --gtest_filter=PinnedScenes.*
// prints the numbers anew.  What is right about them is for closed forms to say; these see that nothing
// changed.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "kernels/dem/engine/engine.hpp"
#include "kernels/dem/testing/scenes.hpp"

namespace ulpgate::dem {
namespace {

using scenes::Scene;
using testing::load;

struct Pin {
  const char* what;
  double value;
};
constexpr Pin pins[] = {
#include "kernels/dem/engine/pinned_scenes.inc"
};

class PinnedScenes : public ::testing::Test {
 protected:
  // Holds the number against its pin: to 1e-8, since the C library makes cosines of the positions at the
  // start.
  void hold(const std::string& what, double value) {
    if (std::getenv("ULPGATE_PRINT_PINS") != nullptr) {
      std::printf("{\"%s\", %.12g},\n", what.c_str(), value);
      return;
    }
    const auto* const pin =
        std::find_if(std::begin(pins), std::end(pins), [&](const Pin& p) { return p.what == what; });
    ASSERT_NE(pin, std::end(pins)) << what << " is pinned nowhere";
    EXPECT_NEAR(value, pin->value, 1e-8 * std::fabs(pin->value) + 1e-300) << what;
  }

  void hold_state(const std::string& name, const DemEngine& e) {
    const auto sum = [&](BodyQuantity q, std::size_t components) {
      double total = 0;
      for (std::size_t i = 0; i < e.bodies(); ++i) {
        for (std::size_t c = 0; c < components; ++c)
          total += static_cast<double>((5 * i + 3 * c) % 7 + 1) * std::fabs(e.approximate(q, i, c));
      }
      return total;
    };
    hold(name + " position", sum(BodyQuantity::position, 3));
    hold(name + " velocity", sum(BodyQuantity::velocity, 3));
    hold(name + " angular velocity", sum(BodyQuantity::angular_velocity, 3));
    hold(name + " orientation", sum(BodyQuantity::orientation, 4));
    hold(name + " contacts", static_cast<double>(e.contacts().size()));
    for (const std::string& energy : e.energy_names()) hold(name + " " + energy, e.energy(energy));
    double mass = 0;
    for (std::size_t i = 0; i < e.bodies(); ++i) mass += static_cast<double>(i + 1) * e.mass(i);
    hold(name + " mass", mass);
    for (const char* step : {"p_wave", "rayleigh", "stiffness"}) {
      const CriticalStep critical = e.critical_step(step);
      if (critical.refusal.empty()) hold(name + " " + step, critical.step_s);
    }
  }

  static std::unique_ptr<DemEngine> made(Scene scene, const std::vector<std::string>& overrides = {}) {
    scene = testing::changed(scene, overrides);
    scene.record = {"energy"};
    return make_engine("double", Level::own, scene, {});
  }
};

TEST_F(PinnedScenes, EveryScene) {
  for (const std::string& name : testing::scene_names()) {
    const auto e = made(testing::busy(name));
    e->step(name == "deposition" ? 400 : 1500);
    hold_state(name, *e);
  }
}

TEST_F(PinnedScenes, RodsThatBreakAndMeetAgain) {
  const auto e = made(load("pendulum3"), {"material.rod.cohesion=1", "node_radius=L/6"});
  for (const char* time : {"early", "late"}) {
    e->step(40000);
    hold_state(std::string("broken ") + time, *e);
  }
}

TEST_F(PinnedScenes, CompositionOfKicksAndDrifts) {
  const auto e = made(load("pendulum3"));
  e->set_flow({{false, "0.5"}, {true, "1"}, {false, "0.5"}});
  e->step(2000);
  hold_state("flow", *e);
}

// A body that is moved along at a given velocity pulls the others behind it.
const char* const towed = R"(name = "towed"
[[material]]
name = "rod"
density = 10
young = 1e5
poisson = 0
[[sphere]]
position = [0, 0, 0]
velocity = [0.5, 0.25, 0]
radius = 0.001
fixed = true
[[sphere]]
position = [0.025, 0, 0]
radius = 0.001
[[sphere]]
position = [0.05, 0, 0]
radius = 0.001
fixed = true
[[bond]]
bodies = [0, 1]
[contacts]
law = "cohesive"
between = "bonded"
[run]
dt = 1e-5
until = 1
gravity = [0, -9.81, 0]
damping = 0
)";

TEST_F(PinnedScenes, ABodyThatIsDrivenMovesAndOneThatIsFixedDoesNot) {
  const Scene scene = testing::read(towed);
  const auto e = made(scene);
  const auto all = make_engine("double", Level::own, scene, {true, 1});
  e->step(1000);
  all->step(1000);
  EXPECT_NEAR(e->approximate(BodyQuantity::position, 0, 0), 0.005, 1e-12);
  EXPECT_NEAR(e->approximate(BodyQuantity::position, 0, 1), 0.0025, 1e-12);
  EXPECT_EQ(e->approximate(BodyQuantity::position, 2, 0), 0.05);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(e->text(BodyQuantity::position, i, c), all->text(BodyQuantity::position, i, c));
  }
  hold_state("towed", *e);
}

}  // namespace
}  // namespace ulpgate::dem
