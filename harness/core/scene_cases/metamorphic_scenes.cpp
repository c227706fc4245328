// The scenes that metamorphic_cases() transforms.
#include <cmath>

#include "harness/core/scene_cases/case_tables.hpp"
#include "harness/core/scene_cases/scene_text.hpp"
#include "harness/core/scene_cases/scene_trial.hpp"
#include "harness/core/subject/registry.hpp"

namespace ulpgate {

namespace {

using namespace scene_text;

std::string head_on() {
  return head_on_balls("0.5", "-0.01050371", "0.0105") + run("1e-5", "2e-3", {{"record", energy}});
}

// Every number is short in binary, and stays so for some steps: k dt^2/m = 1/4.
std::string dyadic() {
  return begin("dyadic", "ball", {{"stiffness", "64"}}) +
         sphere("-0.515625, 0.25, 0", "0.5", {{"velocity", "0.5, 0, 0"}, {"mass", "1"}}) +
         sphere("0.515625, 0.25, 0", "0.5", {{"velocity", "-0.5, 0, 0"}, {"mass", "1"}}) +
         contacts("frictional") + run("0.0625");
}

std::string rolling() {
  return begin("rolling", "ball",
               {{"density", "2500"}, {"young", "1e6"}, {"poisson", "0.3"}, {"friction_angle", "20"}}) +
         sphere("0, 0.01-0.01*0.0102736, 0", "0.01", {{"velocity", "1, 0, 0"}}) + wall("0") +
         contacts("frictional") +
         run("1e-5", "0.2", {{"gravity", downwards}, {"record", "[\"energy\", \"rotation\"]"}});
}

std::string oblique(const std::string& law) {
  return text_of({law, law == "hertz_mindlin" ? "1e11" : "1e8", "25", "0.0091"}, "oblique");
}

// Balls on a floor, more on top, all touching from the start or soon.
std::string heap(const std::string& floor, const std::string& damping) {
  std::string text = begin(
      "heap", "grain", {{"density", "2600"}, {"young", "1e7"}, {"poisson", "0.3"}, {"friction_angle", "25"}});
  for (const char* place : {"-0.0099, 0.0098, -0.0101", "0.0100, 0.0097, -0.0098", "0.0101, 0.0099, 0.0102",
                            "-0.0097, 0.0099, 0.0099", "0.0002, 0.0238, -0.0003", "0.0150, 0.0246, 0.0151"}) {
    text += sphere(place, "0.01", {{"velocity", "0.1, -0.2, 0.05"}});
  }
  return text + floor + contacts("frictional") +
         run("6e-6", "1", {{"gravity", downwards}, {"damping", damping}, {"record", energy}});
}

std::string pendulum() {
  return begin("pendulum", "rod", {{"density", "10"}, {"young", "1e5"}, {"poisson", "0"}}) +
         sphere("0, 0, 0", "1e-3", {{"fixed", "true"}}) + sphere("0.0235, 0.0085, 0.002", "1e-3") +
         sphere("0.047, 0.0171, 0", "1e-3") + section("[[bond]]", {{"bodies", "[0, 1]"}}) +
         section("[[bond]]", {{"bodies", "[1, 2]"}}) + contacts("cohesive", {{"between", "bonded"}}) +
         run("1e-5", "16", {{"gravity", downwards}, {"record", energy}});
}

// A ball falls, sliding, on a square of 1 m cut into these facets; where it is after the bounce.
struct Floor {
  std::string name;
  std::string facets;
};

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "[[facet]]\nvertices = [[" + a + "], [" + b + "], [" + c + "]]\n";
}

std::string ball_on(const std::string& floor, const std::string& x, const std::string& z) {
  return R"(
name = "floor"
[[material]]
name = "ball"
density = "2500"
young = "1e7"
poisson = "0.3"
friction_angle = "20"
[[sphere]]
position = [")" +
         x + R"(", "0.010001", ")" + z + R"("]
velocity = ["0.1", "-0.5", "0.05"]
radius = "0.01"
)" + floor +
         R"(
[contacts]
law = "frictional"
[run]
dt = "4e-6"
until = "1"
)";
}

StressCase triangulated(const Floor& a, const Floor& b, const std::string& where, const std::string& x,
                        const std::string& z) {
  StressCase c;
  c.kind = "metamorphic";
  c.name = "retriangulated";
  c.form = b.name + "_" + where;
  c.title = "a ball bounces on a square floor cut into facets: " + a.name + " against " + b.name;
  c.cost = 0.02;
  const std::string first = ball_on(a.facets, x, z);
  const std::string second = ball_on(b.facets, x, z);
  c.run = [first, second](std::string_view token, const ode::StopFlag& stop) -> std::optional<StressRow> {
    const RealDescriptor* type = find_type(token);
    if (type == nullptr) return std::nullopt;
    constexpr std::uint64_t steps = 200;
    auto one = dem::make_engine(token, dem::Level::own, scene_of(first), {});
    auto other = dem::make_engine(token, dem::Level::own, scene_of(second), {});
    one->step(steps);
    other->step(steps);
    StateScale scale;
    raise_scale(*one, scale);
    StressRow row;
    row.error = state_distance(*one, *other, scale);
    row.condition = trajectory_condition(token, scene_of(first), steps, 4, stop);
    row.figures["rise_over_other"] = one->approximate(dem::BodyQuantity::velocity, 0, 1) /
                                     other->approximate(dem::BodyQuantity::velocity, 0, 1);
    row.verdict = judge_stress(*row.error, *row.condition, unit_roundoff(type->significand_bits));
    if (!std::isfinite(*row.condition)) row.condition.reset();
    row.correct_digits = std::max(0.0, *row.error > 0 ? -std::log10(*row.error) : type->decimal_places);
    // The normals of a level floor are exact, so no rounding depends on its facets.
    row.figures["same_bytes"] = *row.error == 0 ? 1 : 0;
    if (*row.error != 0) {
      row.verdict = StressVerdict::wrong_outcome;
      row.why = "the bounce depends on the triangulation";
    }
    return row;
  };
  return c;
}

}  // namespace

std::vector<MetamorphicScene> metamorphic_scenes() {
  const std::string floor = facet("-1, 0, -1", "1, 0, -0.5", "-0.25, 0, 1");
  using Known = MetamorphicScene::Known;
  const auto small = [](StressVerdict verdict, const std::string& says) {
    return Known{
        "scaled_far",
        {"float", verdict,
         "Moments of inertia, energies and squares of areas of grains of 1e-13 m are below the normal range "
         "of float: a property of the type.",
         says}};
  };
  const Known small_grains = small(StressVerdict::wrong_outcome, "");
  const auto by_axes = [](const std::string& transform) {
    return Known{
        transform,
        {"all", StressVerdict::wrong_outcome,
         "Non-viscous damping looks at each component of velocity and acceleration on its own: it depends on "
         "the axes, a property of the method."}};
  };
  return {
      {.name = "head_on",
       .title = "two balls head on",
       .toml = head_on(),
       .steps = 200,
       .same_when_renumbered = true},
      {.name = "rolling",
       .title = "a ball that slides, then rolls",
       .toml = rolling(),
       .steps = 1000,
       .known = {small_grains}},
      {.name = "oblique_viscoelastic",
       .title = "two spinning balls off centre",
       .toml = oblique("viscoelastic"),
       .steps = 600,
       .known = {small_grains}},
      {.name = "oblique_hertz",
       .title = "two spinning balls off centre",
       .toml = oblique("hertz_mindlin"),
       .steps = 600,
       .known = {small_grains}},
      {.name = "oblique_frictional",
       .title = "two spinning balls off centre",
       .toml = oblique("frictional"),
       .steps = 600,
       .known = {small_grains}},
      {.name = "heap_on_wall",
       .title = "six balls on a wall",
       .toml = heap(wall("0"), "0.1"),
       .steps = 200,
       .known = {small_grains}},
      {.name = "heap_on_facet",
       .title = "six balls on a facet",
       .toml = heap(floor, "0"),
       .steps = 200,
       .known = {small_grains}},
      {.name = "heap_damped",
       .title = "six damped balls on a facet",
       .toml = heap(floor, "0.1"),
       .steps = 200,
       .known = {small_grains, by_axes("rotated"), by_axes("rotated_again")}},
      {.name = "dyadic",
       .title = "two balls head on, in short binary numbers",
       .toml = dyadic(),
       .steps = 6,
       .same_when_renumbered = true,
       .same_when_translated = true},
      {.name = "pendulum",
       .title = "two rods out of a plane",
       .toml = pendulum(),
       .steps = 500,
       .known = {small(StressVerdict::refused, "moments of inertia must be positive")}},
  };
}

std::vector<StressCase> triangulation_cases() {
  const std::string a = "-0.5, 0, -0.5";
  const std::string b = "0.5, 0, -0.5";
  const std::string c = "0.5, 0, 0.5";
  const std::string d = "-0.5, 0, 0.5";
  const std::string m = "0, 0, 0";
  const Floor diagonal{"one_diagonal", facet(a, b, c) + facet(a, c, d)};
  const Floor cycled{"corners_cycled", facet(b, c, a) + facet(c, d, a)};
  const Floor reversed{"corners_reversed", facet(c, b, a) + facet(d, c, a)};
  const Floor other{"other_diagonal", facet(a, b, d) + facet(b, c, d)};
  const Floor quarters{"four_triangles", facet(a, b, m) + facet(b, c, m) + facet(c, d, m) + facet(d, a, m)};
  std::vector<StressCase> list;
  for (const Floor& f : {cycled, reversed, other, quarters})
    list.push_back(triangulated(diagonal, f, "away_from_edges", "0.05", "-0.3"));
  list.push_back(triangulated(diagonal, cycled, "on_the_diagonal", "0.1", "0.1"));
  list.push_back(triangulated(diagonal, reversed, "on_the_diagonal", "0.1", "0.1"));
  list.push_back(triangulated(diagonal, other, "on_the_diagonal", "0.1", "0.1"));
  list.push_back(triangulated(diagonal, quarters, "in_the_middle", "0", "0"));
  return list;
}

}  // namespace ulpgate
