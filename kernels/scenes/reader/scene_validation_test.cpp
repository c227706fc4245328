// What is refused of a scene in the type of the run, and before its memory is taken.
#include <gtest/gtest.h>

#include "kernels/scenes/reader/assemble.hpp"
#include "kernels/scenes/reader/scene_reader.hpp"
#include "kernels/scenes/reader/scene_steps.hpp"

namespace ulpgate::scenes {
namespace {

const std::string good_scene = R"(name = "test"
[constants]
R = 0.01
L = 0.1
[[material]]
name = "m"
density = 2500
[[sphere]]
position = [0, "L", 0]
radius = "R"
[[wall]]
axis = "y"
position = 0
[run]
dt = 1e-5
until = 1
)";

Scene read(const std::string& from = "", const std::string& to = "") {
  std::string text = good_scene;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  const auto result = read_scene(text.replace(at, from.size(), to), "t.toml");
  for (const auto& e : result.errors) ADD_FAILURE() << e.text();
  return result.scene.value_or(Scene{});
}

template <RealType Real>
std::string fault_of(const Scene& scene) {
  try {
    (void)assemble<Real>(scene);
    return "";
  } catch (const SceneFault& fault) {
    return fault.what();
  }
}

struct Case {
  const char* from;
  const char* to;
  const char* in_float;  // how the fault begins; empty where there is none
  const char* in_double;
};

TEST(SceneValidation, A6EveryNumberIsJudgedInTheTypeOfTheRun) {
  const Case cases[] = {
      {"", "", "", ""},
      {"radius = \"R\"", "radius = 1e-60", "sphere[0].radius: must be positive, is '1e-60' = 0", ""},
      {"radius = \"R\"", "radius = 1e-20", "sphere[0] (body 0): its mass must be positive", ""},
      {"radius = \"R\"", "radius = 1e39", "sphere[0].radius: must be finite", ""},
      {"radius = \"R\"", "radius = 1e-308", "sphere[0].radius: must be pos", "sphere[0] (body 0): its mass"},
      {"radius = \"R\"", "radius = 1e308", "sphere[0].radius: must be finite",
       "sphere[0] (body 0): its mass"},
      {"radius = \"R\"", "radius = 1\nmass = 1e-50", "sphere[0].mass: must be positive", ""},
      {"radius = \"R\"", "radius = 1\ninertia = [1, 1, 1e-50]", "sphere[0].inertia: must be positive", ""},
      {"radius = \"R\"", "radius = 1\nvelocity = [0, 1e300, 0]", "sphere[0].velocity: must be finite", ""},
      {"density = 2500", "density = 1e-50", "material[0].density: must be positive", ""},
      {"density = 2500", "young = 1e50", "material[0].young: must be finite", ""},
      {"density = 2500", "collision_time = 1e-50", "material[0].collision_time: must be positive", ""},
      {"density = 2500", "restitution_normal = 1e-50", "material[0].restitution_normal: must be above 0", ""},
      {"position = 0", "position = 1e99", "wall[0].position: must be finite", ""},
      {"dt = 1e-5", "dt = 1e-50", "run.dt: must be positive, is '1e-50' = 0", ""},
      {"dt = 1e-5", "dt = 1e-5\ngravity = [0, 1e308, 0]", "run.gravity: must be finite", ""},
      {"dt = 1e-5", "dt = 1e-5\ndamping = 0.9999999999", "run.damping: must be on [0, 1)", ""},
      {"[run]", "[contacts]\nsweep = 1e-60\n[run]", "contacts.sweep: must be positive", ""},
  };
  for (const Case& c : cases) {
    const Scene scene = read(c.from, c.to);
    const auto begins = [](const std::string& text, const std::string& with) {
      return with.empty() ? text.empty() : text.starts_with(with);
    };
    EXPECT_TRUE(begins(fault_of<float>(scene), c.in_float)) << c.to << ": " << fault_of<float>(scene);
    EXPECT_TRUE(begins(fault_of<double>(scene), c.in_double)) << c.to << ": " << fault_of<double>(scene);
  }
}

TEST(SceneValidation, A6WhatDependsOnAnOverrideIsJudgedAgain) {
  Scene scene = read();
  ASSERT_FALSE(apply_override(scene, "R=-0.1"));
  EXPECT_EQ(fault_of<double>(scene), "sphere[0].radius: must be positive, is 'R' = -0.1");
  scene = read("dt = 1e-5", "dt = \"R*1e-5\"");
  ASSERT_FALSE(apply_override(scene, "R=-1"));
  EXPECT_THROW((void)steps_until_end(scene), SceneFault);
  ASSERT_FALSE(apply_override(scene, "R=0"));
  EXPECT_THROW((void)steps_until_end(scene), SceneFault);
  scene = read("until = 1", "until = \"1/R\"");
  ASSERT_FALSE(apply_override(scene, "R=0"));
  EXPECT_THROW((void)steps_until_end(scene), SceneFault);
}

TEST(SceneValidation, A6DegenerateBodiesAreRefusedWithTheirPlace) {
  const std::string facet = "[[facet]]\nvertices = ";
  const std::string box = "[[box]]\ncentre = [0, 0, 0]\nhalf_size = [1, 1, 1]\naxis = ";
  const struct {
    std::string table;
    const char* expected;
  } cases[] = {
      {facet + "[[0, 0, 0], [1, 0, 0], [0, 0, 1]]\n", ""},
      {facet + "[[0, 0, 0], [1, 0, 0], [2, 0, 0]]\n", "facet[0] (body 1): the facet has no area"},
      {facet + "[[0, 0, 0], [0.1, 0.1, 0.1], [0.3, 0.3, 0.3]]\n", "facet[0] (body 1): the facet has no area"},
      {facet + "[[1, 1, 1], [1, 1, 1], [0, 0, 1]]\n", "facet[0] (body 1): the facet has no area"},
      {box + "[0, 0, 2]\n", ""},
      {box + "[0, 0, 0]\n", "box[0].axis: its length must be positive"},
      {box + "[0, 1e-200, 0]\n", ""},  // a direction all the same
      {"[[sphere]]\nposition = [0, 0.1, 0]\nradius = 1\n",
       "bodies 0 and 1: their centres are the same point"},
      {"[[sphere]]\nposition = [0, 0.1, 1]\nradius = 1\n", ""},
      {"[[generator]]\nkind = \"grid\"\nradius = 1\ncounts = [2, 1, 1]\nspacing = [0, 1, 1]\n",
       "bodies 1 and 2: their centres are the same point"},
      {"[[generator]]\nkind = \"grid\"\nradius = 1e-120\ncounts = [2, 1, 1]\nspacing = [1, 1, 1]\n",
       "generator[0] (body 1): its mass must be positive"},
      {"[[generator]]\nkind = \"hexagonal_ball\"\nradius = 1e-120\nball_radius = 3e-120\n",
       "generator[0] (body 1): its mass must be positive"},
      {"[[generator]]\nkind = \"facet_box\"\nhalf_size = [1, 1, 1e-170]\n",
       "generator[0] (body 1): the facet has no area"},
      {"[[generator]]\nkind = \"hexagonal_ball\"\nradius = 1\nball_radius = 0.5\n",
       "generator[0]: no sphere fits into the ball"},
  };
  for (const auto& c : cases) {
    const std::string fault = fault_of<double>(read("[run]", c.table + "[run]"));
    EXPECT_TRUE(*c.expected == '\0' ? fault.empty() : fault.starts_with(c.expected)) << c.table << fault;
  }
}

TEST(SceneValidation, B5LatticesWithoutEndAreRefused) {
  for (const char* radius : {"1e-300", "1e-9", "1e308"}) {
    const std::string ball = std::string("[[generator]]\nkind = \"hexagonal_ball\"\nball_radius = 0.5\n") +
                             "corner = [-0.5, -0.5, -0.5]\nradius = " + radius + "\n[run]";
    EXPECT_TRUE(fault_of<double>(read("[run]", ball)).starts_with("generator[0]")) << radius;
  }
}

TEST(SceneValidation, B6MemoryIsEstimatedBeforeItIsTaken) {
  const std::string grid =
      "[[generator]]\nkind = \"grid\"\nradius = 1\ncounts = [1000, 1000, 1000]\nspacing = [2, 2, 2]\n[run]";
  const std::string fault = fault_of<double>(read("[run]", grid));
  EXPECT_TRUE(fault.starts_with("generator[0]: bodies: 1000000002 need about ")) << fault;
  EXPECT_NE(fault.find(" GB, more than the "), std::string::npos) << fault;
  EXPECT_EQ(fault_of<float>(read("[run]", grid)).find("1000000002 need about"),
            fault.find("1000000002 need"));
  EXPECT_THROW(refuse_large("bodies", most_bodies + 1, most_bodies, 1, true), SceneTooLarge);
  EXPECT_NO_THROW(refuse_large("bodies", most_bodies, most_bodies, 4000, true));
}

TEST(SceneValidation, B6AReachBeyondMeasureIsRefused) {
  std::string text = good_scene;
  text.replace(text.find("[run]"), 5, "[contacts]\nlaw = \"cohesive\"\nbond_reach = 1e300\n[run]");
  const auto result = read_scene(text, "t.toml");
  ASSERT_TRUE(result.scene);
  EXPECT_TRUE(fault_of<double>(*result.scene).starts_with("contacts.bond_reach: the square of the reach"));
  EXPECT_TRUE(fault_of<float>(*result.scene).starts_with("contacts.bond_reach: must be finite"));
}

TEST(SceneValidation, BondsWithinReachAreThoseOfEveryPair) {
  const std::string grid =
      "[[generator]]\nkind = \"grid\"\nradius = \"R\"\nradius_spread = 0.4\ncounts = [5, 4, 3]\n"
      "spacing = [0.02, 0.02, 0.02]\njitter = 0.005\nfixed_layers = 2\n"
      "[contacts]\nlaw = \"cohesive\"\nbond_reach = 1.1\n[run]";
  const auto a = assemble<double>(read("[run]", grid));
  std::vector<std::pair<int, int>> expected;
  for (int i = 0; i < static_cast<int>(a.bodies.size()); ++i) {
    for (int j = i + 1; j < static_cast<int>(a.bodies.size()); ++j) {
      const auto& p = a.bodies[static_cast<std::size_t>(i)];
      const auto& q = a.bodies[static_cast<std::size_t>(j)];
      if (p.shape != Shape::sphere || q.shape != Shape::sphere || (p.fixed && q.fixed)) continue;
      const double far = 1.1 * (p.radius + q.radius);
      if (dem::squared_norm(q.position - p.position) < far * far) expected.emplace_back(i, j);
    }
  }
  std::vector<std::pair<int, int>> found;
  for (const auto& b : a.bonds) found.emplace_back(b.first, b.second);
  EXPECT_GT(found.size(), 20U);
  EXPECT_EQ(found, expected);
}

TEST(SceneValidation, A14NamesOfScenesStayInsideTheDirectory) {
  for (const char* name :
       {"../../evil", "/etc/evil", "..", ".hidden", "a/b", "a b", "-x", "\\u00e9", "a\\n"}) {
    std::string text = good_scene;
    text.replace(text.find("\"test\""), 6, "\"" + std::string(name) + "\"");
    const auto result = read_scene(text, "t.toml");
    ASSERT_EQ(result.errors.size(), 1U) << name;
    EXPECT_TRUE(result.errors[0].text().starts_with("t.toml:1: name: must be up to 100 letters")) << name;
  }
  EXPECT_EQ(read("\"test\"", "\"My_scene-2.1+x\"").name, "My_scene-2.1+x");
}

TEST(SceneValidation, CConstantsDoNotShadowTheLanguage) {
  for (const char* name : {"pi", "nan", "inf", "sqrt", "exp", "\"a-b\"", "\"1a\"", "\"\""}) {
    std::string text = good_scene;
    text.replace(text.find("R = 0.01"), 1, name);
    text.replace(text.find("radius = \"R\""), 12, "radius = 1");
    const auto result = read_scene(text, "t.toml");
    ASSERT_EQ(result.errors.size(), 1U) << name;
    EXPECT_TRUE(result.errors[0].text().starts_with("t.toml:3: constants.")) << result.errors[0].text();
  }
}

TEST(SceneValidation, B5StepsBeyondCountingAreCounted) {
  Scene scene = read();
  EXPECT_EQ(steps_for(scene, "1e300"), countless_steps);
  ASSERT_FALSE(apply_override(scene, "dt=1e-300"));
  EXPECT_EQ(steps_until_end(scene), countless_steps);
  scene = read("until = 1", "until = 1\nrecord_every = 1e-9");
  EXPECT_THROW((void)steps_between_records(scene), SceneFault);
}

TEST(SceneInTheTypeOfTheRun, AMomentOfInertiaThatUnderflowsIsRefused) {
  Scene scene = read("radius = \"R\"", "radius = 1e-10");
  EXPECT_EQ(fault_of<double>(scene), "");
  EXPECT_NE(fault_of<float>(scene).find("moments of inertia"), std::string::npos) << fault_of<float>(scene);
}

TEST(SceneInTheTypeOfTheRun, AnIntegerMayBeAtTheEndsOfItsRange) {
  const auto errors = [](const std::string& seed) {
    const std::string grid =
        "[[generator]]\nkind = \"grid\"\nmaterial = \"m\"\nradius = 0.001\ncounts = [2, 1, 1]\n"
        "spacing = [1, 1, 1]\ncorner = [0, 1, 0]\nseed = " +
        seed + "\n";
    std::string text = good_scene;
    return read_scene(text.insert(text.find("[[wall]]"), grid), "t.toml").errors;
  };
  for (const char* seed : {"0", "1", "2147483647"}) {
    const auto found = errors(seed);
    EXPECT_TRUE(found.empty()) << seed << ": " << found.front().text();
  }
  for (const char* seed : {"-1", "2147483648"}) EXPECT_FALSE(errors(seed).empty()) << seed;
}

}  // namespace
}  // namespace ulpgate::scenes
