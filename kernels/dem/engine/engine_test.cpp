// Tests of whole simulations: the same bits with all parts, on any threads and after a restart; facts of the
// scenes.
#include "kernels/dem/engine/engine.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/dem/step/archive.hpp"
#include "kernels/dem/testing/scenes.hpp"

namespace ulpgate::dem {
namespace {

using scenes::Scene;
using testing::busy;
using testing::load;
using testing::scene_names;

std::unique_ptr<DemEngine> engine(const Scene& scene, EngineOptions options = {},
                                  std::string_view token = "double", Level level = Level::own) {
  auto e = make_engine(token, level, scene, options);
  EXPECT_NE(e, nullptr) << token;
  return e;
}

// Positions, velocities and contacts as exact text.
std::string trajectory(const DemEngine& e) {
  std::string text;
  for (std::size_t i = 0; i < e.bodies(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      text += e.text(BodyQuantity::position, i, c) + ' ' + e.text(BodyQuantity::velocity, i, c) + ' ' +
              e.text(BodyQuantity::angular_velocity, i, c) + '\n';
    }
  }
  for (const BodyPair& p : e.contacts())
    text += std::to_string(p.first) + '-' + std::to_string(p.second) + ' ';
  return text;
}

std::uint64_t steps_of(const std::string& name) {
  return name == "collision" || name == "cradle" ? 9000 : 3000;
}

TEST(Engine, AllPartsGiveTheSameBits) {
  for (const std::string& name : scene_names()) {
    const Scene scene = busy(name);
    auto lean = engine(scene);
    auto full = engine(scene, {true, 1});
    EXPECT_FALSE(lean->explain().left_out.empty()) << name;
    EXPECT_TRUE(full->explain().left_out.empty()) << name;
    lean->step(steps_of(name));
    full->step(steps_of(name));
    EXPECT_EQ(trajectory(*lean), trajectory(*full)) << name;
    EXPECT_LE(lean->memory_bytes(), full->memory_bytes()) << name;
  }
}

// Rods alone have a step of their own, in the plane and in space.
TEST(Engine, RodsInSpaceGiveTheSameBitsWithAllParts) {
  Scene scene = load("pendulum3");
  scene.gravity[2] = "-5";
  auto lean = engine(scene);
  auto full = engine(scene, {true, 1});
  lean->step(3000);
  full->step(3000);
  EXPECT_LT(lean->approximate(BodyQuantity::position, 3, 2), -1e-4) << "out of the plane";
  EXPECT_EQ(trajectory(*lean), trajectory(*full));
}

TEST(Engine, AnyNumberOfThreadsGivesTheSameBits) {
  for (const std::string& name : scene_names()) {
    const Scene scene = busy(name);
    auto serial = engine(scene, {true, 1});
    serial->step(steps_of(name) / 9);
    const std::string expected = trajectory(*serial);
    for (const int threads : {2, 4}) {
      auto threaded = engine(scene, {true, threads});
      threaded->step(steps_of(name) / 9);
      EXPECT_EQ(trajectory(*threaded), expected) << name << ", " << threads << " threads";
      for (const std::string& e : serial->energy_names())
        EXPECT_EQ(threaded->energy(e), serial->energy(e)) << e;
    }
  }
}

TEST(Engine, TellsThatItGetsOnAndKeepsTheBits) {
  const auto counted = [](const std::string& name, int threads, std::uint64_t steps) {
    std::atomic<std::uint64_t> progress{0};
    auto watched = engine(busy(name), {false, threads, false, &progress});
    auto alone = engine(busy(name));
    watched->step(steps);
    alone->step(steps);
    EXPECT_EQ(trajectory(*watched), trajectory(*alone)) << name;
    return progress.load();
  };
  // Bonds alone: three of them, 4096/(3 + 1) steps at once.
  EXPECT_EQ(counted("pendulum3", 1, 10000), 10U);
  EXPECT_EQ(counted("pendulum3", 1, 1), 1U);
  // Two bodies, and one pair once the first steps have found it: 4096/(2 + 1) = 1365 steps, then 1024 at
  // once.
  EXPECT_EQ(counted("rolling", 1, 1365 + 3 * 1024 + 1), 5U);
  EXPECT_EQ(counted("rolling", 2, 1365 + 3 * 1024), 4U);
  EXPECT_EQ(counted("rolling", 1, 1), 1U);
  // More than 4096 bodies count in every step.
  std::atomic<std::uint64_t> progress{0};
  auto large = engine(load("deposition"), {false, 2, false, &progress});
  large->step(3);
  EXPECT_GE(progress.load(), 3U);
}

TEST(Engine, EveryTypeKeepsBitsWithPartsAndThreads) {
  for (const std::string& token : engine_tokens()) {
    for (const Level level : {Level::own, Level::reference}) {
      for (const char* name : {"packing", "rolling", "pendulum3"}) {
        const Scene scene = busy(name);
        auto lean = engine(scene, {false, 1}, token, level);
        auto full = engine(scene, {true, 2}, token, level);
        lean->step(60);
        full->step(60);
        EXPECT_EQ(trajectory(*lean), trajectory(*full)) << token << ' ' << name;
      }
    }
  }
}

TEST(Engine, RestoringContinuesWithTheSameBits) {
  for (const std::string& name : scene_names()) {
    const Scene scene = busy(name);
    auto straight = engine(scene);
    straight->step(steps_of(name) / 2);
    const std::string state = straight->save();
    straight->step(300);
    auto resumed = engine(scene, {false, 2});
    resumed->restore(state, Constants::from_text);
    EXPECT_EQ(resumed->save(), state) << name;
    resumed->step(300);
    EXPECT_EQ(trajectory(*resumed), trajectory(*straight)) << name;
    EXPECT_EQ(resumed->iteration(), straight->iteration());
  }
}

TEST(Engine, WidenedStateIsExact) {
  const Scene scene = busy("packing");
  auto narrow = engine(scene);
  narrow->step(1000);
  auto wide = engine(scene, {}, "double", Level::reference);
  wide->restore(narrow->save(), Constants::from_text);
  EXPECT_EQ(trajectory(*wide), trajectory(*narrow));
  EXPECT_EQ(wide->mass_text(5), narrow->mass_text(5)) << "constants are widened as well";
  auto own = engine(scene, {}, "double", Level::reference);
  own->restore(narrow->save(), Constants::own);
  EXPECT_EQ(trajectory(*own), trajectory(*narrow));
  EXPECT_NE(own->mass_text(5), narrow->mass_text(5)) << "or kept in full precision";
  wide->step(10);
  narrow->step(10);
  double difference = 0;
  for (std::size_t i = 0; i < narrow->bodies(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      difference = std::max(difference, std::abs(wide->approximate(BodyQuantity::position, i, c) -
                                                 narrow->approximate(BodyQuantity::position, i, c)));
    }
  }
  EXPECT_LT(difference, 1e-15);
}

TEST(Engine, OtherLawsAndShapesKeepBitsToo) {
  for (const std::string law : {"hertz_mindlin", "frictional", "viscoelastic"}) {
    const Scene scene = testing::everything(law);
    auto lean = engine(scene);
    auto full = engine(scene, {true, 2});
    lean->step(1);
    const double start = lean->energy("sum");
    lean->step(4999);
    const std::string state = lean->save();
    lean->step(5000);
    full->step(10000);
    EXPECT_EQ(trajectory(*lean), trajectory(*full)) << law;
    EXPECT_GT(lean->energy("friction"), 0) << law << ": bodies met";
    auto resumed = engine(scene);
    resumed->restore(state, Constants::from_text);
    resumed->step(5000);
    EXPECT_EQ(trajectory(*resumed), trajectory(*lean)) << law;
    if (law != "viscoelastic") {
      // The shear springs' account is good to overlap/radius: their velocity is free of ratcheting, not the
      // true one.
      EXPECT_NEAR(lean->energy("sum"), start, 3e-3 * start) << law;
    }
  }
}

TEST(Engine, BrokenRodsStayBrokenThroughARestart) {
  Scene scene = load("pendulum3");
  ASSERT_FALSE(apply_override(scene, "material.rod.cohesion=1"));
  scene.record = {"energy"};
  auto lean = engine(scene);
  auto full = engine(scene, {true, 1});
  lean->step(100000);
  full->step(100000);
  EXPECT_GT(lean->energy("broken"), 0);
  EXPECT_EQ(trajectory(*lean), trajectory(*full));
  auto resumed = engine(scene);
  resumed->restore(lean->save(), Constants::from_text);
  lean->step(1000);
  resumed->step(1000);
  EXPECT_EQ(trajectory(*resumed), trajectory(*lean));
}

TEST(Engine, BadStatesAreRefused) {
  const Scene scene = load("collision");
  auto e = engine(scene);
  const std::string state = e->save();
  for (const std::string& text : {std::string(), std::string("nonsense"), state.substr(0, state.size() / 2),
                                  state + "more 1\n", engine(load("cradle"))->save()}) {
    EXPECT_THROW(engine(scene)->restore(text, Constants::from_text), ArchiveError);
  }
}

TEST(Deposition, Facts) {
  auto e = engine(load("deposition"));
  EXPECT_EQ(e->bodies(), 10009U + 12U);
  std::size_t spheres = 0;
  for (std::size_t i = 0; i < e->bodies(); ++i) {
    if (e->shape(i) != scenes::Shape::sphere) continue;
    ++spheres;
    ASSERT_NEAR(e->mass(i), 0.04133747731443931, 2e-17);
  }
  EXPECT_EQ(spheres, 10009U);
}

TEST(Pendulum, MassAndEnergyAtTheStart) {
  Scene scene = load("pendulum3");
  scene.record.push_back("energy");
  auto e = engine(scene);
  EXPECT_EQ(e->mass(1), 4.1887902047863912e-08);
  e->step(1);
  EXPECT_NEAR(e->energy("potential") + e->energy("elastic"), 2.108145396e-8, 5e-18);
  const double start = e->energy("sum");
  double worst = 0;
  for (int i = 0; i < 1600; ++i) {
    e->step(1000);
    worst = std::max(worst, std::abs(e->energy("sum") - start));
  }
  EXPECT_LT(worst, 6e-14) << "largest |E - E0| over 16 s; sampled more often it is 5.49e-14";
  EXPECT_GT(worst, 1e-15);
}

// Section 4 of the physics notes as a plain loop.
void straight_pendulum(long steps, double lambda, double (&p)[4][2], double (&v)[4][2]) {
  const double pi = std::acos(-1.0);
  const double L = 0.1, inclination = 20 * pi / 180, r = L / 100, density = 10, dt = 1e-5, g = -9.81;
  const double volume = (4. / 3) * pi * r * r * r, m = volume * density;
  const double E = 1e5, kn = 2.0 * E * r * E * r / (E * r + E * r);
  for (int i = 0; i < 4; ++i) {
    p[i][0] = ((i * L) / 4) * std::cos(inclination);
    p[i][1] = ((i * L) / 4) * std::sin(inclination);
    v[i][0] = v[i][1] = 0;
  }
  double unp[3];
  for (int k = 0; k < 3; ++k) {
    const double dx = p[k + 1][0] - p[k][0], dy = p[k + 1][1] - p[k][1];
    unp[k] = -std::sqrt(dx * dx + dy * dy) + r + r;
  }
  for (long s = 0; s < steps; ++s) {
    double f[4][2] = {};
    for (int k = 0; k < 3; ++k) {
      const double dx = p[k + 1][0] - p[k][0], dy = p[k + 1][1] - p[k][1];
      const double len = std::sqrt(dx * dx + dy * dy), nx = dx / len, ny = dy / len;
      const double un = (r + r) - len, fn = kn * (un - unp[k]), fx = fn * nx, fy = fn * ny;
      f[k][0] += -fx;
      f[k][1] += -fy;
      f[k + 1][0] += fx;
      f[k + 1][1] += fy;
    }
    for (int i = 1; i < 4; ++i) {
      for (int c = 0; c < 2; ++c) {
        double a = f[i][c] / m + (c == 1 ? g : 0);
        const double x = a * (v[i][c] + dt * a / 2);
        a *= 1 - lambda * (x > 0 ? 1 : x < 0 ? -1 : 0);
        v[i][c] = v[i][c] + dt * a;
        p[i][c] = p[i][c] + v[i][c] * dt;
      }
    }
  }
}

TEST(Pendulum, BitsOfTheStraightLoop) {
  struct Case {
    const char* damping;
    double lambda;
    const char* mass;
  };
  for (const Case& c : {Case{"damping=0", 0, "mass=full"}, Case{"damping=5e-3", 5e-3, "mass=full"},
                        Case{"damping=0", 0, "mass=yade"}}) {
    Scene scene = load("pendulum3");
    ASSERT_FALSE(apply_override(scene, c.damping));
    ASSERT_FALSE(apply_override(scene, c.mass));
    double p[4][2];
    double v[4][2];
    straight_pendulum(200000, c.lambda, p, v);
    for (const bool all_parts : {false, true}) {
      auto e = engine(scene, {all_parts, 1});
      e->step(200000);
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k < 2; ++k) {
          EXPECT_EQ(e->approximate(BodyQuantity::position, i, k), p[i][k]) << c.damping << " body " << i;
          EXPECT_EQ(e->approximate(BodyQuantity::velocity, i, k), v[i][k]) << c.damping << " body " << i;
        }
      }
    }
  }
}

// 4/3 pi as a product of doubles is off by 1.0966e-16, at any precision of the rest.
TEST(Pendulum, ContaminatedMassIsGoodToADouble) {
  Scene scene = load("pendulum3");
  auto full = engine(scene, {}, "double", Level::reference);
  ASSERT_FALSE(apply_override(scene, "mass=yade"));
  auto yade = engine(scene, {}, "double", Level::reference);
  using Wide = MpfrReal<60>;
  const Wide error = parse_real<Wide>(yade->mass_text(1)) / parse_real<Wide>(full->mass_text(1)) - Wide(1);
  EXPECT_NEAR(static_cast<double>(error), -1.0966071124660523e-16, 1e-26);
}

TEST(Explain, PendulumNeedsOnlyItsRods) {
  std::string left_out;
  const auto e = engine(load("pendulum3"));
  for (const auto& part : e->explain().left_out) {
    left_out += part.part + ';';
    EXPECT_FALSE(part.why.empty());
  }
  EXPECT_EQ(left_out,
            "collider;shear;moments;rotation;orientation;viscosity;damping;flats;energy;third axis;");
}

}  // namespace
}  // namespace ulpgate::dem
