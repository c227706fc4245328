// Tests of the scene reader: errors with file, line and key; expressions; overrides.
#include "kernels/scenes/reader/scene_reader.hpp"

#include <gtest/gtest.h>

#include "kernels/dem/testing/scenes.hpp"
#include "kernels/scenes/reader/expression.hpp"
#include "kernels/scenes/reader/scene_steps.hpp"

namespace ulpgate::scenes {
namespace {

const std::string good = R"(name = "test"
[constants]
r = 0.01
[[material]]
name = "m"
density = 2500
[[sphere]]
position = [0, "2*r", 1.25e-3]
radius = "r"
[run]
dt = 1e-5
until = 1
)";

std::string with(const std::string& from, const std::string& to) {
  std::string text = good;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Reader, KeepsTheDigitsOfFloats) {
  const auto result = read_scene(with("1e-5", "1.00000000000000000000000000001e-5"), "t.toml");
  ASSERT_TRUE(result.scene);
  EXPECT_EQ(result.scene->dt, "1.00000000000000000000000000001e-5");
  EXPECT_EQ(result.scene->spheres[0].position[2], "1.25e-3");
  EXPECT_EQ(result.scene->spheres[0].material, "m") << "the only material need not be named";
}

TEST(Reader, ErrorsNameFileLineAndKey) {
  struct Case {
    std::string text;
    const char* expected;
  };
  const Case cases[] = {
      {with("radius = \"r\"", "radius = -1"), "t.toml:9: sphere[0].radius: must be positive, is -1"},
      {with("radius = \"r\"", "radius = 0"), "t.toml:9: sphere[0].radius: must be positive, is 0"},
      {with("radius = \"r\"", "radius = nan"),
       "t.toml:9: sphere[0].radius: 'nan': unknown name 'nan' at character 1"},
      {with("radius = \"r\"", "radius = \"1/0\""), "t.toml:9: sphere[0].radius: '1/0' is not finite"},
      {with("radius = \"r\"", "radius = true"),
       "t.toml:9: sphere[0].radius: must be a number or a string that holds one"},
      {with("radius = \"r\"", "radius = \"2*\""),
       "t.toml:9: sphere[0].radius: '2*': a number is missing at character 3"},
      {with("radius = \"r\"", "radius = \"q\""),
       "t.toml:9: sphere[0].radius: 'q': unknown name 'q' at character 1"},
      {with("radius = \"r\"", ""), "t.toml:7: sphere[0].radius: is missing"},
      {with("radius = \"r\"", "radius = 1\nradios = 2"), "t.toml:10: sphere[0].radios: unknown key"},
      {with("radius = \"r\"", "radius = 1\nmaterial = \"x\""),
       "t.toml:10: sphere[0].material: there is no material 'x'"},
      {with("[0, \"2*r\", 1.25e-3]", "[0, 1]"),
       "t.toml:8: sphere[0].position: must be an array of three numbers"},
      {with("[0, \"2*r\", 1.25e-3]", "[0, 1, \"a\"]"),
       "t.toml:8: sphere[0].position[2]: 'a': unknown name 'a' at character 1"},
      {with("dt = 1e-5", "dt = 0"), "t.toml:11: run.dt: must be positive, is 0"},
      {with("dt = 1e-5", "dt = 1e-5\ndamping = 1"), "t.toml:12: run.damping: must be on [0, 1), is 1"},
      {with("dt = 1e-5", "dt = 1e-5\nrecord = [\"x\"]"),
       "t.toml:12: run.record: nothing named 'x' can be recorded"},
      {with("[run]", "[[bond]]\nbodies = [0, 1]\n[run]"),
       "t.toml:11: bond[0].bodies: must be two of the 1 spheres, numbered from 0"},
      {with("[run]", "[contacts]\nlaw = \"glue\"\n[run]"),
       "t.toml:11: contacts.law: 'glue' is none of frictional, viscoelastic, hertz_mindlin, cohesive"},
      {with("name = \"test\"", "name = 3"), "t.toml:1: name: must be a string that is not empty"},
      {with("density = 2500", "density = 2500\nrestitution_normal = 1.5"),
       "t.toml:7: material[0].restitution_normal: must be above 0 and at most 1, is 1.5"},
      {with("[run]", "[extra]\n[run]"), "t.toml:10: extra: unknown key"},
      {"name = ", "t.toml:1: "},
  };
  for (const Case& c : cases) {
    const auto result = read_scene(c.text, "t.toml");
    EXPECT_FALSE(result.scene) << c.expected;
    ASSERT_FALSE(result.errors.empty()) << c.expected;
    EXPECT_TRUE(result.errors.front().text().starts_with(c.expected))
        << "got  " << result.errors.front().text() << "\nwant " << c.expected;
  }
}

TEST(Reader, ReportsEveryError) {
  std::string text = with("radius = \"r\"", "radius = -1\nfoo = 1");
  EXPECT_EQ(read_scene(text, "t.toml").errors.size(), 2U);
}

TEST(Override, ChangesOrSaysWhyNot) {
  Scene scene = *read_scene(good, "t.toml").scene;
  EXPECT_FALSE(apply_override(scene, "dt=1e-6"));
  EXPECT_EQ(scene.dt, "1e-6");
  EXPECT_FALSE(apply_override(scene, "r=0.02"));
  EXPECT_FALSE(apply_override(scene, "gravity.y=-9.81"));
  EXPECT_FALSE(apply_override(scene, "material.m.friction_angle=30"));
  EXPECT_FALSE(apply_override(scene, "mass=yade"));
  EXPECT_EQ(scene.mass_rule, MassRule::yade);
  EXPECT_FALSE(apply_override(scene, "constants=stepwise"));
  EXPECT_EQ(scene.constants_rule, ConstantsRule::stepwise);
  EXPECT_FALSE(apply_override(scene, "material.m.stiffness=100"));
  EXPECT_EQ(scene.materials.front().stiffness, "100");
  struct Case {
    const char* text;
    const char* expected;
  };
  for (const Case& c :
       {Case{"dt", "override: dt: must be key=value"}, Case{"dt=-1", "override: dt: must be positive, is -1"},
        Case{"x=1", "override: x: nothing of this name can be changed"},
        Case{"mass=3", "override: mass: '3' is none of full, yade"},
        Case{"constants=float", "override: constants: 'float' is none of rounded_once, stepwise"},
        Case{"material.m.stiffness=0", "override: material.m.stiffness: must be positive, is 0"},
        Case{"r=zz", "override: r: 'zz': unknown name 'zz' at character 1"}}) {
    const auto error = apply_override(scene, c.text);
    ASSERT_TRUE(error) << c.text;
    EXPECT_EQ(error->text(), c.expected);
  }
  EXPECT_EQ(scene.dt, "1e-6") << "a refused override changes nothing";
}

TEST(Expression, Values) {
  struct Case {
    const char* text;
    double expected;
  };
  Evaluator<double> e;
  e.define("L", 0.1);
  for (const Case& c : {Case{"1 - 2 - 3", -4}, Case{"8/2/2", 2}, Case{"2*(3+4)", 14}, Case{"-L", -0.1},
                        Case{"--1", 1}, Case{"0x1.8p+1", 3}, Case{"1e-3*1E3", 1}, Case{"2*-3", -6},
                        Case{"sqrt(16)+exp(0)", 5}, Case{"pi", 3.141592653589793}, Case{".5", 0.5}}) {
    EXPECT_DOUBLE_EQ(e(c.text), c.expected) << c.text;
  }
  for (const char* bad : {"", "1 2", "(1", "1)", "1e", "foo(1)", "1..2", "*", "sqrt", "1,5", "2^3"}) {
    EXPECT_THROW((void)e(bad), ExpressionError) << bad;
  }
  EXPECT_THROW((void)e(std::string(5000, '(')), ExpressionError) << "depth is limited";
}

TEST(Expression, NoDoubleOnTheWay) {
  using Wide = MpfrReal<62>;
  const Evaluator<Wide> e;
  EXPECT_EQ(e("0.1/3"), Wide("0.1") / 3);
  EXPECT_EQ(e("4*pi/3"), 4 * boost::math::constants::pi<Wide>() / 3);
}

TEST(Scenes, TimesAreWholeSteps) {
  EXPECT_EQ(steps_until_end(dem::testing::load("deposition")), 7001U);
  Scene pendulum = dem::testing::load("pendulum3");
  EXPECT_EQ(steps_until_end(pendulum), 1600000U);
  EXPECT_EQ(steps_between_records(pendulum), 10U);
  EXPECT_FALSE(apply_override(pendulum, "dt=1e-6"));
  EXPECT_EQ(steps_between_records(pendulum), 100U);
}

TEST(Scenes, AllAreValid) {
  for (const std::string& name : dem::testing::scene_names()) EXPECT_EQ(dem::testing::load(name).name, name);
}

}  // namespace
}  // namespace ulpgate::scenes
