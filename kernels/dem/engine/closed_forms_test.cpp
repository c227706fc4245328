// Tests of scenes against their closed forms, and of the energy account.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kernels/dem/engine/engine.hpp"
#include "kernels/dem/testing/scenes.hpp"

namespace ulpgate::dem {
namespace {

using scenes::Scene;
using testing::load;

std::unique_ptr<DemEngine> run(const Scene& scene, const std::vector<std::string>& overrides, double until) {
  auto e = make_engine("double", Level::own, testing::changed(scene, overrides), {});
  double dt = 0;
  e->step(1);
  dt = e->time_s();
  const auto steps = static_cast<std::uint64_t>(std::llround(until / dt));
  if (steps > 1) e->step(steps - 1);
  return e;
}

double velocity(const DemEngine& e, std::size_t body, std::size_t axis) {
  return e.approximate(BodyQuantity::velocity, body, axis);
}

// Restitution of a linear spring and dashpot that never pulls: T. Schwager & T. Poeschel, Granular Matter 9
// (2007) 465. The scene's law is made for a contact of duration tc with restitution en; cut where the force
// would pull, the ball comes out a little faster.
double restitution(double en, double tc) {
  const double beta = -std::log(en) / tc;
  const double omega = std::numbers::pi / tc;
  // Force k u + c u' = 0 at t = (pi - 2 atan(beta/omega)...)/omega; from there the ball flies free.
  const double angle = std::numbers::pi - std::atan2(2 * beta * omega, omega * omega - beta * beta);
  const double t = angle / omega;
  return -std::exp(-beta * t) * (std::cos(omega * t) - beta / omega * std::sin(omega * t));
}

TEST(Collision, RestitutionConvergesWithTheStep) {
  for (const char* en : {"0.9", "0.5"}) {
    const double exact = restitution(std::stod(en), 1e-3);
    double before = 0;
    for (const char* dt : {"dt=4e-6", "dt=1e-6", "dt=2.5e-7"}) {
      const auto e =
          run(load("collision"), {dt, std::string("material.ball.restitution_normal=") + en}, 2e-3);
      const double error = std::abs((velocity(*e, 1, 0) - velocity(*e, 0, 0)) / 2 - exact);
      if (before > 0) {
        EXPECT_LT(error, before / 2) << en << ' ' << dt;
      }
      before = error;
    }
    EXPECT_LT(before, 1e-3) << en;
  }
}

TEST(Collision, EnergyAccountClosesWithTheSquareOfTheStep) {
  for (const char* scene : {"collision", "cradle"}) {
    double before = 0;
    const double scale = scene == std::string("cradle") ? 0.1 : 1;
    for (const double dt : {8e-6, 2e-6, 5e-7}) {
      const auto e =
          run(load(scene), {"dt=" + std::to_string(dt * scale * 1e9) + "e-9"}, scale == 1 ? 2e-3 : 1e-2);
      double start = 0.010471975511965976;
      if (scale < 1) start = 0.5 * e->mass(0);
      const double error = std::abs(e->energy("sum") / start - 1);
      if (before > 0) {
        EXPECT_LT(error, before / 8) << scene << ' ' << dt;
      }
      before = error;
    }
    EXPECT_LT(before, 1e-4) << scene;
  }
}

TEST(Rolling, StopsSlidingWhenAndWhereItMust) {
  const double mu = std::tan(20 * std::numbers::pi / 180);
  const double start = 2 / (7 * mu * 9.81);
  const auto before = run(load("rolling"), {}, 0.9 * start);
  EXPECT_NEAR(velocity(*before, 0, 0), 1 - mu * 9.81 * 0.9 * start, 2e-4) << "still sliding: v = v0 - mu g t";
  // The contact's spring goes on swinging about the rolling motion: the mean is what the closed form says.
  const auto after = run(load("rolling"), {}, 1.5 * start);
  double v = 0;
  double w = 0;
  constexpr int samples = 2000;
  for (int i = 0; i < samples; ++i) {
    after->step(20);
    v += velocity(*after, 0, 0) / samples;
    w += after->approximate(BodyQuantity::angular_velocity, 0, 2) / samples;
  }
  EXPECT_NEAR(v, 5.0 / 7, 1e-3) << "rolling at 5/7 v0";
  EXPECT_NEAR(-w * 0.01, v, 1e-3) << "without slip";
  EXPECT_NEAR(after->energy("friction"), after->mass(0) / 7, 2e-2 * after->mass(0) / 7)
      << "1/7 m v0^2 is lost";
}

TEST(Bouncing, ReturnsToItsHeightInTime) {
  // Fall, contact, rise: the top again at 2 sqrt(2h/g) + the time of contact.
  const double fall = std::sqrt(2 * 0.05 / 9.81);
  const double top = 2 * fall + 1e-3;
  const auto e = run(load("bouncing"), {"material.ball.collision_time=1e-3"}, top);
  EXPECT_NEAR(velocity(*e, 0, 1), 0, 5e-3);
  EXPECT_NEAR(e->approximate(BodyQuantity::position, 0, 1), 0.06, 2e-5);
}

TEST(Cradle, HandsTheVelocityToTheLastBall) {
  const auto e = run(load("cradle"), {}, 0.015);
  double momentum = 0;
  for (std::size_t i = 0; i < e->bodies(); ++i) momentum += velocity(*e, i, 0);
  EXPECT_NEAR(momentum, 1, 1e-13) << "in units of the mass";
  EXPECT_NEAR(velocity(*e, 4, 0), 1, 1e-5);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(velocity(*e, i, 0), 0, 1e-5);
}

TEST(Energy, AccountOfEverythingCloses) {
  struct Case {
    const char* scene;
    std::vector<std::string> overrides;
    double until, tolerance;
    const char* why;
  };
  const Case cases[] = {
      {"packing", {}, 0.03, 1e-3, "friction, damping and the work of a moving wall, against the work"},
      {"beam", {"damping=0"}, 0.02, 1e-2, "bonds with moments, against the fall's energy"},
      {"bouncing", {"damping=0.1"}, 0.3, 1e-3, "damping"},
      {"rolling", {}, 0.1, 1e-3, "friction and rotation"},
  };
  for (const Case& c : cases) {
    const auto first = run(load(c.scene), c.overrides, 0);
    const double start = first->energy("sum");
    const auto e = run(load(c.scene), c.overrides, c.until);
    double scale = 0;
    for (const std::string& name : e->energy_names()) scale = std::max(scale, std::abs(e->energy(name)));
    EXPECT_LT(std::abs(e->energy("sum") - start), c.tolerance * scale) << c.scene << ": " << c.why;
  }
}

// The ball of the rolling scene with three moments.  A constant friction turns it: the leapfrog's account
// closes then, but only with the spin at the time of the step, half a step after the one that the state
// holds.
TEST(Energy, AccountOfAnAsphericalBodyCloses) {
  Scene scene = load("rolling");
  scene.spheres.at(0).inertia = scenes::Triple{"4e-7", "5e-7", "3e-7"};
  const double start = run(scene, {"dt=8e-6"}, 0)->energy("sum");
  const auto e = run(scene, {"dt=8e-6"}, 0.02);
  EXPECT_GT(e->energy("rotational_on_step"), 1e-5);
  EXPECT_NEAR(e->energy("sum"), start, 1e-11);
}

// A ball that a wall throws back within one step, at rest between: F dt = 2 m v.  The leapfrog makes no
// energy then, and what the shear spring has taken by the time is lost with the contact: k (dt u)^2/2 stored,
// and dt/2 of its force while the ball leaves.
TEST(Energy, AccountOfAContactThatEndsWithALoadedShearSpringCloses) {
  // Poisson's ratios that make the shear spring soft, so that the ball still slips as it leaves.
  for (const auto& [law, nu] :
       {std::pair<std::string, double>{"frictional", 0.02}, {"hertz_mindlin", 0.99}}) {
    const double r = 0.01;
    const double depth = 1e-6;
    const double dt = 1e-4;
    const double speed = 2 * depth / dt;
    const double slip = speed / 10;
    // kn = E r; or 4/3 E* sqrt(r/2) with E* = E/2, and 8 G* sqrt(r/2) with G* = E/(4 (2 - nu) (1 + nu)).
    const bool hertz = law == "hertz_mindlin";
    const double e_star = 1e7 / (2 * (1 - nu * nu));
    const double g_star = 1e7 / (4 * (2 - nu) * (1 + nu));
    const double force = hertz ? 4.0 / 3 * e_star * std::sqrt(r / 2) * std::pow(depth, 1.5) : 1e7 * r * depth;
    const double ks = hertz ? 8 * g_star * std::sqrt(r / 2 * depth) : nu * 1e7 * r;
    char text[1000];
    std::snprintf(text, sizeof text, R"(name = "thrown_back"
[[material]]
name = "m"
young = 1e7
poisson = %.17g
friction_angle = 60
[[sphere]]
position = [0, %.17g, 0]
velocity = [%.17g, %.17g, 0]
radius = 0.01
mass = %.17g
[[wall]]
axis = "y"
position = 0
[contacts]
law = "%s"
[run]
dt = %.17g
until = 1
record = ["energy"]
)",
                  nu, r + depth, slip, -speed, force * dt / (2 * speed), law.c_str(), dt);
    const auto e = make_engine("double", Level::own, testing::read(text), {});
    e->step(1);
    EXPECT_TRUE(e->contacts().empty()) << law;
    const double start = e->energy("sum");
    e->step(1);
    ASSERT_EQ(e->contacts().size(), 1U) << law;
    const double stored = ks * dt * dt * slip * slip / 2;
    EXPECT_NEAR(e->energy("elastic"), force * depth * (hertz ? 0.4 : 0.5) + stored, 1e-6 * stored) << law;
    e->step(1);
    EXPECT_TRUE(e->contacts().empty()) << law;
    EXPECT_EQ(e->energy("elastic"), 0) << law;
    EXPECT_NEAR(velocity(*e, 0, 1), speed, 1e-6 * speed) << law;
    const double leaving = velocity(*e, 0, 0) + r * e->approximate(BodyQuantity::angular_velocity, 0, 2);
    EXPECT_GT(leaving, slip / 2) << law;
    EXPECT_NEAR(e->energy("friction"), stored * (1 + leaving / slip), 1e-3 * stored) << law;
    EXPECT_NEAR(e->energy("sum"), start, 1e-3 * stored) << law;
  }
}

// Centres so near to each other that the square of their distance is 0 in float.
TEST(Contact, OfCentresNextToEachOtherHasADirection) {
  const auto e = make_engine("float", Level::own, testing::read(R"(name = "near"
[[material]]
name = "m"
[[sphere]]
position = [0, 0, 0]
radius = 0.01
fixed = true
[[sphere]]
position = [3e-30, 4e-30, 0]
radius = 0.01
[contacts]
law = "frictional"
[run]
dt = 1e-6
until = 1
)"),
                             {});
  e->step(1);
  EXPECT_GT(velocity(*e, 1, 1), 0);
  EXPECT_NEAR(velocity(*e, 1, 0) / velocity(*e, 1, 1), 0.75, 1e-6);
}

// The rules by waves of two spheres of 1e7 Pa whose density, stiffness or law is given otherwise.
TEST(CriticalStep, OfWavesIsThatOfTheMassesOrNone) {
  const auto rule = [](const std::string& material, const std::string& body, const std::string& law,
                       const char* name) {
    const auto e =
        make_engine("double", Level::own,
                    testing::read("name = \"pair\"\n[[material]]\nname = \"grain\"\ndensity = "
                                  "2600\nyoung = 1e7\n" +
                                  material + "[[sphere]]\nposition = [0, 0, 0]\nradius = 0.01\n" + body +
                                  "[[sphere]]\nposition = [0.0199, 0, 0]\nradius = 0.02\n" +
                                  "[contacts]\nlaw = \"" + law + "\"\n[run]\ndt = 1e-6\nuntil = 1\n"),
                    {});
    return e->critical_step(name);
  };
  const double by_density = 0.01 * std::sqrt(2600 / 1e7);
  const double rayleigh_over_p = std::numbers::pi * std::sqrt(2.0) / 0.8766;
  for (const char* law : {"frictional", "cohesive", "hertz_mindlin"}) {
    EXPECT_NEAR(rule("", "", law, "p_wave").step_s, by_density, 1e-12 * by_density) << law;
    const CriticalStep light = rule("", "mass = 1e-6\n", law, "p_wave");
    const double density = 1e-6 / (4.0 / 3 * std::numbers::pi * 1e-6);
    EXPECT_NEAR(light.step_s, 0.01 * std::sqrt(density / 1e7), 1e-12 * light.step_s) << law;
    EXPECT_NEAR(rule("", "mass = 1e-6\n", law, "rayleigh").step_s, rayleigh_over_p * light.step_s,
                1e-12 * light.step_s)
        << law;
  }
  const std::string given = "stiffness = 1e8\n";
  for (const char* name : {"p_wave", "rayleigh"}) {
    const std::string at =
        "the rule '" + std::string(name) + "': waves know elastic materials alone, and the ";
    EXPECT_EQ(rule(given, "", "frictional", name).refusal, at + "stiffness of the material 'grain' is given");
    EXPECT_EQ(rule("", "", "viscoelastic", name).refusal,
              at + "law 'viscoelastic' makes its springs from collision_time");
    EXPECT_EQ(rule(given, "", "hertz_mindlin", name).refusal, "") << "Hertz's law does not use it";
  }
  EXPECT_THROW((void)rule("", "", "frictional", "none"), std::invalid_argument);
}

TEST(Beam, BreaksUnderItsWeightAndOnlyThen) {
  const auto heavy = run(load("beam"), {}, 0.1);
  EXPECT_GT(heavy->energy("broken"), 0);
  const auto strong = run(load("beam"), {"material.brick.cohesion=1e9"}, 0.1);
  EXPECT_EQ(strong->energy("broken"), 0);
}

}  // namespace
}  // namespace ulpgate::dem
