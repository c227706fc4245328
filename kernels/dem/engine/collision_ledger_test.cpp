// Tests of the ledger of collisions: closed forms of restitution, duration and energy, the same bits beside
// it, on any threads and after a restart.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kernels/dem/engine/engine.hpp"
#include "kernels/dem/step/archive.hpp"
#include "kernels/dem/testing/scenes.hpp"

namespace ulpgate::dem {
namespace {

using scenes::Scene;
using testing::busy;
using testing::changed;
using testing::load;
using testing::read;

std::unique_ptr<DemEngine> with_ledger(const Scene& scene, int threads = 1,
                                       std::string_view token = "double") {
  EngineOptions options;
  options.threads = threads;
  options.collisions = true;
  return make_engine(token, Level::own, scene, options);
}

std::vector<CollisionRecord> collisions_of(const Scene& scene, std::uint64_t steps,
                                           std::string_view token = "double") {
  const auto e = with_ledger(scene, 1, token);
  e->step(steps);
  return e->take_collisions();
}

// Every number of the records, exactly.
std::string text_of(const std::vector<CollisionRecord>& records) {
  std::string text;
  for (const CollisionRecord& r : records) {
    text += std::to_string(r.first) + '-' + std::to_string(r.second) + ' ' + std::to_string(r.begin_step) +
            ' ' + std::to_string(r.end_step) + ' ' + std::to_string(r.steps_inside) + ' ' +
            std::to_string(r.open) + std::to_string(r.beyond_condition);
    for (const double x :
         {r.begin_s, r.end_s, r.duration_s, r.normal_velocity_before, r.normal_velocity_after, r.restitution,
          r.largest_overlap_m, r.energy_before, r.energy_after, r.energy_gained, r.energy_created, r.omega_dt,
          r.condition, r.rounding_bound, r.step_bound, r.law_bound}) {
      text += ' ' + to_hexfloat(x);
    }
    text += '\n';
  }
  return text;
}

std::string gain_of(const CollisionRecord& r) {
  std::ostringstream text;
  text << ": bodies " << r.first << '-' << r.second << " from step " << r.begin_step << " gained "
       << r.energy_gained << " J, bounds " << r.rounding_bound << ' ' << r.step_bound << ' ' << r.law_bound;
  return text.str();
}

std::string positions(const DemEngine& e) {
  std::string text;
  for (std::size_t i = 0; i < e.bodies(); ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      text += e.text(BodyQuantity::position, i, c) + ' ' + e.text(BodyQuantity::velocity, i, c) + ' ';
  }
  return text;
}

// A damped spring that never pulls, of damping ratio zeta < 1/sqrt 2 and t_c = pi/omega_d: force 0 at omega_d
// t = pi - atan(2 zeta w/(1 - 2 zeta^2)), w = sqrt(1 - zeta^2), with e = exp(-(zeta/w) omega_d t) there (T.
// Schwager & T. Poeschel, Granular Matter 9 (2007) 465); then the bodies fly free out of the rest of the
// overlap.
struct Rebound {
  double restitution, duration;
};
Rebound rebound_without_tension(double zeta, double tc) {
  const double w = std::sqrt(1 - zeta * zeta);
  const double angle = std::numbers::pi - std::atan(2 * zeta * w / (1 - 2 * zeta * zeta));
  const double omega = std::numbers::pi / tc;
  const double decay = std::exp(-zeta / w * angle);
  const double overlap = decay * std::sin(angle) / omega;  // for a closing speed of 1
  return {decay, angle / omega + overlap / decay};
}

TEST(CollisionLedger, RestitutionWithoutTensionOfTheClosedForm) {
  const double zeta = 0.3;
  const double with_tension = std::exp(-std::numbers::pi * zeta / std::sqrt(1 - zeta * zeta));
  EXPECT_NEAR(with_tension, 0.3723, 5e-5);
  const Rebound exact = rebound_without_tension(zeta, 1e-3);
  EXPECT_NEAR(exact.restitution, 0.4510, 5e-5);
  double before = 0;
  for (const auto& [dt, steps] :
       {std::pair<const char*, std::uint64_t>{"dt=1e-6", 2000}, {"dt=1e-7", 20000}}) {
    // The law takes the restitution of the spring with tension.
    const Scene scene =
        changed(load("collision"), {dt, "material.ball.restitution_normal=" + std::to_string(with_tension)});
    const auto list = collisions_of(scene, steps);
    ASSERT_EQ(list.size(), 1U);
    const CollisionRecord& r = list.front();
    EXPECT_EQ(r.normal_velocity_before, -2);
    const double error = std::abs(r.restitution - exact.restitution);
    EXPECT_LT(error, before > 0 ? before / 5 : 2e-3) << dt;
    before = error;
    EXPECT_NEAR(r.duration_s, exact.duration, 2e-3 * exact.duration) << dt;
    EXPECT_NEAR(r.energy_after / r.energy_before, r.restitution * r.restitution, 1e-12);
    EXPECT_NEAR(r.energy_gained, r.energy_after - r.energy_before, 1e-15) << "nothing else acts";
    EXPECT_EQ(r.energy_created, 0);
    EXPECT_FALSE(r.beyond_condition);
  }
  EXPECT_LT(before, 2e-4);
}

// Two balls, z = pi dt/tc, and half a step more in a collision than whole ones.  Of an elastic collision the
// leapfrog's rule holds exactly: (v+/v-)^2 = (1 - z^2 s (1 - s))/(1 - z^2 t (1 - t)), s and t the parts of a
// step before and behind.
TEST(CollisionLedger, AnElasticCollisionMakesWhatTheStepMakes) {
  double most = 0;
  double least = 0;
  for (int k = 0; k < 40; ++k) {
    const std::string gap = std::to_string(1.0001 + 0.0007 * k);
    const Scene scene = read(R"(name = "two"
[[material]]
name = "m"
density = 1000
collision_time = 0.0105
[[sphere]]
position = [0, 0, 0]
velocity = [1, 0, 0]
radius = 0.5
[[sphere]]
position = [")" + gap + R"(", 0, 0]
radius = 0.5
[contacts]
law = "viscoelastic"
[run]
dt = 1e-3
until = 1
)");
    const auto list = collisions_of(scene, 60);
    ASSERT_EQ(list.size(), 1U);
    const CollisionRecord& r = list.front();
    const double z2 = r.omega_dt * r.omega_dt;
    EXPECT_NEAR(r.omega_dt, std::numbers::pi / 10.5, 1e-12);
    const double s = static_cast<double>(r.begin_step) - r.begin_s / 1e-3;
    const double t = r.end_s / 1e-3 - static_cast<double>(r.end_step - 1);
    const double ratio = (1 - z2 * s * (1 - s)) / (1 - z2 * t * (1 - t));
    EXPECT_NEAR(r.energy_gained / r.energy_before, ratio - 1, 1e-10);
    EXPECT_NEAR(r.restitution, std::sqrt(ratio), 1e-10);
    const double largest = z2 / 4 / (1 - z2 / 4);
    EXPECT_LE(std::abs(r.energy_gained), largest * r.energy_before);
    EXPECT_LE(r.energy_gained, r.step_bound + r.rounding_bound);
    EXPECT_FALSE(r.beyond_condition);
    most = std::max(most, r.energy_gained / r.energy_before / largest);
    least = std::min(least, r.energy_gained / r.energy_before / largest);
  }
  EXPECT_GT(most, 0.8) << "the bound is reached";
  EXPECT_LT(least, -0.8);
}

TEST(CollisionLedger, AStepBeyondTheStableOneIsBeyondItsCondition) {
  // A wall counts as a second ball in the law, though not in the motion: z = pi/sqrt 2 dt/tc = 2.2.  The ball
  // leaves with more than it came with, which no bound excuses.
  const auto list =
      collisions_of(changed(load("bouncing"), {"dt=1e-3", "material.ball.collision_time=1.0097e-3"}), 600);
  ASSERT_FALSE(list.empty());
  std::size_t beyond = 0;
  for (const auto& r : list) {
    EXPECT_GT(r.omega_dt, 2);
    if (r.beyond_condition) ++beyond;
  }
  EXPECT_GT(beyond, 0U);
}

TEST(CollisionLedger, NoSceneMakesEnergyBeyondItsCondition) {
  struct Case {
    const char* scene;
    std::uint64_t steps;
    std::size_t least;
  };
  for (const Case& c : {Case{"cradle", 150000, 4}, Case{"bouncing", 320000, 2}, Case{"packing", 3000, 20},
                        Case{"deposition", 800, 20}}) {
    for (const char* token : {"float", "double"}) {
      const auto list = collisions_of(busy(c.scene), c.steps, token);
      EXPECT_GE(list.size(), c.least) << c.scene << ' ' << token;
      for (const auto& r : list) {
        EXPECT_FALSE(r.beyond_condition) << c.scene << ' ' << token << gain_of(r);
      }
    }
  }
}

// Friction, spin, facets, edges of a box and a body of three moments, in every law.
TEST(CollisionLedger, NoLawMakesEnergyBeyondItsCondition) {
  for (const std::string law : {"hertz_mindlin", "frictional", "viscoelastic"}) {
    Scene scene = testing::everything(law);
    scene.record.clear();
    scene.materials[0].collision_time = "5e-4";
    scene.generators[0].counts = {3, 4, 3};
    scene.spheres[0].position = {"0.001", "0.13", "0.002"};
    scene.boxes[0].half_size = {"0.02", "0.02", "0.02"};
    scene.gravity = {"1", "-40", "0"};
    for (const char* token : {"float", "double"}) {
      const auto list = collisions_of(scene, 20000, token);
      EXPECT_GT(list.size(), 50U) << law;
      std::size_t slid = 0;
      for (const auto& r : list) {
        if (r.law_bound > 0) ++slid;
        EXPECT_FALSE(r.beyond_condition) << law << ' ' << token << gain_of(r);
      }
      EXPECT_GT(slid, 5U) << law;
    }
  }
}

TEST(CollisionLedger, BodiesThatBeginInsideBringTheirSpring) {
  const Scene scene = read(R"(name = "inside"
[[material]]
name = "m"
density = 1000
young = 1e6
[[sphere]]
position = [0, 0, 0]
radius = 0.5
[[sphere]]
position = [0.99, 0, 0]
radius = 0.5
[contacts]
law = "frictional"
[run]
dt = 1e-5
until = 1
)");
  const auto list = collisions_of(scene, 100000);
  ASSERT_EQ(list.size(), 1U);
  const CollisionRecord& r = list.front();
  EXPECT_EQ(r.begin_step, 0U);
  EXPECT_TRUE(std::isnan(r.restitution)) << "they did not come from anywhere";
  EXPECT_NEAR(r.energy_before, 5e5 * 0.01 * 0.01 / 2, 1e-9)
      << "kn u^2/2 of two springs of 5e5 N/m, times two";
  EXPECT_NEAR(r.energy_after, r.energy_before, 1e-5 * r.energy_before);
  EXPECT_FALSE(r.beyond_condition);
}

TEST(CollisionLedger, ChangesNoBitAndIsTheSameOnAnyThreads) {
  for (const char* name : {"packing", "deposition", "cradle", "beam", "pendulum3"}) {
    const std::uint64_t steps = std::string(name) == "cradle" ? 120000 : 1000;
    const auto alone = make_engine("double", Level::own, busy(name), {});
    alone->step(steps);
    EXPECT_TRUE(alone->take_collisions().empty());
    EXPECT_TRUE(alone->open_collisions().empty());
    const auto one = with_ledger(busy(name));
    one->step(steps);
    EXPECT_EQ(positions(*one), positions(*alone)) << name;
    const auto list = one->take_collisions();
    EXPECT_TRUE(one->take_collisions().empty()) << "they have been taken";
    if (std::string(name) != "packing") continue;
    const std::string ended = text_of(list);
    const std::string open = text_of(one->open_collisions());
    EXPECT_FALSE(ended.empty());
    EXPECT_FALSE(open.empty());
    const auto two = with_ledger(busy(name), 2);
    two->step(steps);
    EXPECT_EQ(text_of(two->take_collisions()), ended);
    EXPECT_EQ(text_of(two->open_collisions()), open);
  }
}

TEST(CollisionLedger, BondsAreNoCollisionsUntilTheyBreak) {
  const auto rods = with_ledger(load("pendulum3"));
  rods->step(5000);
  EXPECT_TRUE(rods->take_collisions().empty());
  EXPECT_TRUE(rods->open_collisions().empty());
}

TEST(CollisionLedger, GoesOnBehindARestart) {
  // In the middle of collisions, with some that nobody has taken.
  for (const char* name : {"packing", "deposition"}) {
    const auto straight = with_ledger(busy(name));
    straight->step(900);
    EXPECT_FALSE(straight->take_collisions().empty()) << name;
    straight->step(20);
    EXPECT_FALSE(straight->open_collisions().empty()) << name;
    const std::string state = straight->save();
    straight->step(80);
    const auto resumed = with_ledger(busy(name));
    resumed->step(7);
    resumed->restore(state, Constants::from_text);
    EXPECT_EQ(resumed->save(), state) << name;
    resumed->step(80);
    const auto list = straight->take_collisions();
    EXPECT_GT(list.size(), 3U) << name;
    EXPECT_EQ(text_of(resumed->take_collisions()), text_of(list)) << name;
    EXPECT_EQ(text_of(resumed->open_collisions()), text_of(straight->open_collisions())) << name;
    const auto without = make_engine("double", Level::own, busy(name), {});
    EXPECT_THROW(without->restore(state, Constants::from_text), ArchiveError) << "it has no ledger";
    EXPECT_THROW(
        with_ledger(busy(name))
            ->restore(make_engine("double", Level::own, busy(name), {})->save(), Constants::from_text),
        ArchiveError);
  }
}

TEST(CollisionLedger, AStateWithACollisionOfNoBodiesIsRefused) {
  const auto e = with_ledger(load("bouncing"));
  e->step(101500);
  std::string state = e->save();
  const auto at = state.find("\none 1\n");
  ASSERT_NE(at, std::string::npos);
  state.replace(at, 7, "\none 9\n");
  EXPECT_THROW(with_ledger(load("bouncing"))->restore(state, Constants::from_text), ArchiveError);
}

TEST(CollisionLedger, TheTypesAgreeOnACollision) {
  const auto narrow = collisions_of(load("collision"), 2000);
  const auto wide = collisions_of(load("collision"), 2000, "mpfr62");
  ASSERT_EQ(narrow.size(), 1U);
  ASSERT_EQ(wide.size(), 1U);
  EXPECT_NEAR(narrow[0].restitution, wide[0].restitution, 2e-3) << "to a step";
  EXPECT_LT(wide[0].rounding_bound, 1e-50);
  EXPECT_GT(narrow[0].rounding_bound, 1e-14);
}

}  // namespace
}  // namespace ulpgate::dem
