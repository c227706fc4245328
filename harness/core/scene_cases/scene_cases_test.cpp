// Tests of the extreme cases: each kind of judgement on a case whose answer is known, and the tables' own
// order.
#include "harness/core/scene_cases/scene_cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "harness/core/scene_cases/case_tables.hpp"
#include "harness/core/scene_cases/scene_text.hpp"
#include "harness/core/scene_cases/scene_transform.hpp"
#include "harness/core/subject/registry.hpp"

namespace ulpgate {
namespace {

using dem::BodyQuantity;

const ode::StopFlag no_stop;

std::vector<StressCase> all_cases() {
  std::vector<StressCase> all = state_cases();
  for (auto& c : scene_cases()) all.push_back(std::move(c));
  for (auto& c : metamorphic_cases()) all.push_back(std::move(c));
  return all;
}

const StressCase& find(const std::vector<StressCase>& cases, const std::string& key) {
  for (const auto& c : cases) {
    if (c.key() == key) return c;
  }
  throw std::invalid_argument("no case " + key);
}

TEST(SceneCases, KeysAreNamesOfOneCaseEach) {
  std::set<std::string> keys;
  for (const auto& c : all_cases()) {
    EXPECT_TRUE(keys.insert(c.key()).second) << c.key();
    EXPECT_FALSE(c.title.empty()) << c.key();
    for (const auto& known : c.known) EXPECT_FALSE(known.cause.empty()) << c.key();
  }
  EXPECT_GT(keys.size(), 200U);
}

TEST(SceneCases, StatesAreAsKnownInEveryType) {
  for (const auto& c : state_cases()) {
    for (const auto& type : all_types()) {
      const auto row = c.run(type.token, no_stop);
      ASSERT_TRUE(row) << c.key();
      EXPECT_TRUE(standing_of(c, type.token, *row).as_known)
          << c.key() << ' ' << type.token << ": " << to_string(row->verdict) << ' ' << row->why;
    }
  }
}

TEST(SceneCases, ScenesAreAsKnownInFloat) {
  std::vector<StressCase> cases = scene_cases();
  for (auto& c : metamorphic_cases()) cases.push_back(std::move(c));
  for (const auto& c : cases) {
    const auto row = c.run("float", no_stop);
    ASSERT_TRUE(row) << c.key();
    EXPECT_TRUE(standing_of(c, "float", *row).as_known)
        << c.key() << ": " << to_string(row->verdict) << ' ' << row->why;
  }
}

TEST(SceneCases, AnUnknownTypeHasNoRow) {
  for (const auto& c : all_cases()) EXPECT_FALSE(c.run("float7", no_stop)) << c.key();
}

TEST(SceneCases, AStopIsHeard) {
  const std::atomic<bool> raised{true};
  const ode::StopFlag stop(raised);
  const auto cases = all_cases();
  for (const char* key : {"state/far_from_the_origin/scan", "scene/far_from_the_origin/1",
                          "metamorphic/rotated/pendulum", "metamorphic/critical_step/pair"}) {
    EXPECT_THROW((void)find(cases, key).run("double", stop), ode::Stopped) << key;
  }
}

TEST(KernelState, RoundsItsInputsToTheTypeAndJudgesThem) {
  const RealDescriptor& type = *find_type("float");
  const KernelPoint p = evaluate_state("sphere_sphere", type, "0.1 0 0 1 2.1-u 0 0 1", 0);
  EXPECT_EQ(static_cast<float>(p.inputs[0]), 0.1F);
  EXPECT_EQ(static_cast<double>(p.inputs[0]), static_cast<double>(0.1F));
  EXPECT_THROW((void)evaluate_state("sphere_sphere", type, "1 2 3", 0), std::invalid_argument);
  EXPECT_THROW((void)evaluate_state("no_such_kernel", type, "1", 0), std::invalid_argument);
  KernelStateCase c;
  c.kernel = "wall_sphere";
  c.inputs = "0 0 0 0.5 0 0 1";
  c.truth = {{0, {"0.5"}}};
  EXPECT_EQ(judge_state(c, type, 0).verdict, StressVerdict::stable);
  c.truth = {{0, {"0.5+64*u"}}};
  EXPECT_EQ(judge_state(c, type, 0).verdict, StressVerdict::unstable) << "another truth";
  c.truth = {{0, {"0"}}};
  EXPECT_EQ(judge_state(c, type, 0).verdict, StressVerdict::wrong_outcome) << "0 is true";
  c.truth = {};
  c.outcome = [](const KernelPoint& point) { return point.of(0, 0) > 1 ? "" : "too small"; };
  EXPECT_EQ(judge_state(c, type, 0).why, "too small");
}

TEST(KernelState, AScanTellsItsFirstWrongArgument) {
  const auto cases = state_cases();
  EXPECT_EQ(find(cases, "state/absorbed_motion/scan").run("double", no_stop)->first_wrong, "s = 2^-53");
  EXPECT_EQ(find(cases, "state/absorbed_motion/scan").run("float", no_stop)->first_wrong, "s = 2^-24");
}

const std::string pair_of_balls =
    scene_text::begin("pair", "ball", {{"density", "1000"}, {"stiffness", "1e5"}}) +
    scene_text::sphere("0, 0.5, 0", "0.01", {{"velocity", "1, 0, 0"}}) +
    scene_text::sphere("0.0199, 0.5, 0", "0.01") + scene_text::contacts("frictional") +
    scene_text::run("1e-5");

TEST(SceneText, SaysExpressionsTriplesAndWordsAsTheReaderWantsThem) {
  EXPECT_EQ(
      scene_text::section("[[sphere]]",
                          {{"position", "0, 1e-3+sqrt(2), -(1+2)"}, {"radius", "3/2"}, {"fixed", "true"}}),
      "[[sphere]]\nposition = [\"0\", \"1e-3+sqrt(2)\", \"-(1+2)\"]\nradius = \"3/2\"\nfixed = true\n");
  EXPECT_EQ(scene_text::section("[[bond]]", {{"bodies", "[0, 1]"}}), "[[bond]]\nbodies = [0, 1]\n");
  const scenes::Scene scene = scene_of(pair_of_balls + scene_text::wall("0.1"));
  EXPECT_EQ(scene.spheres.at(0).velocity, (scenes::Triple{"1", "0", "0"}));
  EXPECT_EQ(scene.spheres.at(1).position, (scenes::Triple{"0.0199", "0.5", "0"}));
  EXPECT_EQ(scene.walls.at(0).position, "0.1");
  EXPECT_EQ(scene.materials.at(0).stiffness, "1e5");
}

TEST(SceneTrial, TellsRoundingFromSteps) {
  SceneCase c;
  c.toml = pair_of_balls;
  c.steps = 100;
  const StressRow f = run_scene_case(c, "float", no_stop);
  const StressRow d = run_scene_case(c, "double", no_stop);
  EXPECT_GT(*f.error, 1e-8);
  EXPECT_LT(*d.error, 1e-12) << "rounding falls with the type";
  EXPECT_NEAR(*f.stepping_error, *d.stepping_error, 1e-2 * *d.stepping_error) << "the step's error does not";
  EXPECT_GT(*d.condition, 1);
  c.outcome = [](const SceneTrial&, StressRow&) { return std::string("wrong"); };
  EXPECT_EQ(run_scene_case(c, "double", no_stop).verdict, StressVerdict::wrong_outcome);
  c.toml = "name = 1";
  EXPECT_THROW((void)run_scene_case(c, "double", no_stop), std::invalid_argument);
}

TEST(SceneTrial, PerturbsByWhatItIsToldTo) {
  const scenes::Scene scene = scene_of(pair_of_balls);
  const auto engine = dem::make_engine("double", dem::Level::own, scene, {});
  const auto moved = dem::make_engine("double", dem::Level::own, scene, {});
  moved->restore(perturbed_state(*engine, 0x1p-20, 1), dem::Constants::from_text);
  const double by = moved->approximate(BodyQuantity::position, 1, 1) - 0.5;
  EXPECT_EQ(std::fabs(by), 0.5 * 0x1p-20) << "of the largest coordinate";
  EXPECT_EQ(std::fabs(moved->approximate(BodyQuantity::position, 1, 2)), 0.5 * 0x1p-20)
      << "also where it is 0";
}

TEST(SceneTransform, GoesThereAndBack) {
  const scenes::Scene scene = scene_of(pair_of_balls);
  SceneTransform t;
  t.map.m = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
  t.scale = {3, 5, -1};
  t.renumber = true;
  const auto base = dem::make_engine("double", dem::Level::own, scene, {});
  const auto moved = dem::make_engine("double", dem::Level::own, t.apply(scene), {});
  EXPECT_EQ(moved->approximate(BodyQuantity::position, 1, 0), -4) << "8 times y, the last is the first";
  EXPECT_EQ(moved->approximate(BodyQuantity::velocity, 1, 1), 16);
  EXPECT_EQ(moved->mass(1), base->mass(0) * 32);
  base->step(50);
  EXPECT_FALSE(compare_transformed(*base, *moved, scene, t).first.empty()) << "50 steps apart";
  moved->step(50);
  EXPECT_EQ(compare_transformed(*base, *moved, scene, t).first, "");
}

TEST(SceneTransform, WallsStayAcrossTheirAxes) {
  scenes::Scene scene = scene_of(pair_of_balls);
  scene.walls.push_back({1, "2", "3", "ball"});
  SceneTransform t;
  t.map.m = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
  const auto moved = dem::make_engine("double", dem::Level::own, t.apply(scene), {});
  EXPECT_EQ(moved->approximate(BodyQuantity::position, 2, 0), -2);
  EXPECT_EQ(moved->approximate(BodyQuantity::velocity, 2, 0), -3);
  t.map.m = {{{2, -1, 2}, {2, 2, -1}, {-1, 2, 2}}};
  t.map.divisor = 3;
  EXPECT_THROW((void)t.apply(scene), std::invalid_argument);
}

}  // namespace
}  // namespace ulpgate
