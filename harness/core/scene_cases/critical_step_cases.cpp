// Critical steps of small networks in many orientations.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/core/contact_network/contact_network.hpp"
#include "harness/core/scene_cases/case_tables.hpp"
#include "harness/core/scene_cases/scene_text.hpp"
#include "harness/core/scene_cases/scene_transform.hpp"
#include "harness/core/subject/registry.hpp"

namespace ulpgate {

namespace {

using namespace scene_text;

// A network at rest and what is true of its step.
struct NetworkCase {
  std::string form, title, toml;
  double moment_stiffness = 0;  // alpha of bonds: alpha r1 r2 ks against bending and twisting
  bool damped = false;          // the limit with dashpots, not 2/omega
  const char* rule = "stiffness";
  std::vector<KnownVerdict> known{};
  bool turned = true;  // in other orientations as well
};

// Turns by integer quaternions (a, b, c, d): a^2 + b^2 + c^2 + d^2 times a rotation matrix of integers
// (Euler). The second is no turn but another place.
std::vector<SpaceMap> orientations() {
  std::vector<SpaceMap> list(2);
  list[1].shift = {"1", "-2", "3"};
  for (const auto& q : std::vector<std::array<int, 4>>{{4, 1, 2, 3},
                                                       {5, -2, 1, 1},
                                                       {3, 3, -1, 2},
                                                       {2, -3, 4, 1},
                                                       {6, 1, -1, 3},
                                                       {3, 1, 1, 1},
                                                       {7, 2, 3, 0},
                                                       {2, 1, 0, 0},
                                                       {3, 0, 0, 1},
                                                       {9, 4, -2, 5}}) {
    const auto& [a, b, c, d] = q;
    SpaceMap map;
    map.m = {{{a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)},
              {2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)},
              {2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d}}};
    map.divisor = a * a + b * b + c * c + d * d;
    list.push_back(map);
  }
  return list;
}

std::string spheres(const std::vector<std::string>& positions, const Keys& more = {}) {
  std::string text;
  for (const auto& p : positions) text += sphere(p, "0.01", more);
  return text;
}

std::string network(Keys material, const std::string& bodies, const std::string& law,
                    const Keys& contact_keys = {}) {
  material.insert(material.begin(), {{"density", "2600"}, {"young", "1e7"}});
  return begin("network", "grain", material) + bodies + contacts(law, contact_keys) + run("1e-12");
}

StressRow run_network(const NetworkCase& c, std::string_view token, const ode::StopFlag& stop) {
  StressRow row;
  const double u = unit_roundoff(find_type(token)->significand_bits);
  const scenes::Scene scene = scene_of(c.toml);
  double least = HUGE_VAL;
  double most = 0;
  double worst = 0;
  double frequency = 0;
  std::vector<SpaceMap> maps = orientations();
  // A wall lies across an axis: it is only moved.
  if (!c.turned) maps.resize(2);
  for (const SpaceMap& map : maps) {
    stop.check();
    const SceneTransform turn{.map = map};
    const auto engine = dem::make_engine(token, dem::Level::own, turn.apply(scene), {});
    engine->step(1);
    const dem::CriticalStep critical = engine->critical_step(c.rule);
    if (!critical.refusal.empty()) {
      row.why = critical.refusal;
      return row;
    }
    const double step = critical.step_s;
    // The only wall of these scenes lies under a sphere.
    ContactNetwork linear = network_of(*engine, scene.law, {{1, 1}});
    for (NetworkSpring& s : linear.springs)
      s.moment = c.moment_stiffness * engine->radius(s.first) * engine->radius(s.second) * s.ks;
    frequency = largest_frequency(linear);
    const double limit = c.damped ? critical_mode(linear).step : 2 / frequency;
    least = std::min(least, step);
    most = std::max(most, step);
    worst = std::max(worst, step / limit);
  }
  row.figures["step_over_true_limit"] = worst;
  row.figures["largest_frequency_rad_per_s"] = frequency;
  row.figures["largest_over_least_of_the_orientations"] = most / least;
  row.error = most / least - 1;
  // A turn rounds positions by u of their size, and the network's own frequency is as well conditioned.
  row.condition = 64;
  row.verdict = judge_stress(*row.error, *row.condition, std::max(u, unit_roundoff(53)));
  row.correct_digits = *row.error > 0 ? std::clamp(-std::log10(*row.error), 0.0, 15.0) : 15.0;
  if (worst > 1) {
    row.verdict = StressVerdict::wrong_outcome;
    row.why = fmt::format("the step is {:.3g} times the largest stable one", worst);
  } else if (row.verdict == StressVerdict::unstable) {
    row.verdict = StressVerdict::wrong_outcome;
    row.why =
        fmt::format("the step changes by {:.2g} of itself with the orientation or the place", *row.error);
  }
  return row;
}

std::vector<NetworkCase> networks() {
  const Keys smooth = {{"poisson", "0"}};
  const Keys rough = {{"poisson", "0.45"}, {"friction_angle", "30"}};
  const Keys dashpots = {{"collision_time", "1e-3"}, {"restitution_normal", "3e-3"}};
  const std::vector<std::string> pair = {"0, 0, 0", "0.0199, 0, 0"};
  const std::vector<std::string> chain = {"0, 0, 0", "0.0199, 0, 0", "0.0398, 0, 0", "0.0597, 0, 0",
                                          "0.0796, 0, 0"};
  const std::vector<std::string> square = {"0, 0, 0", "0.0199, 0, 0", "0.0199, 0.0199, 0", "0, 0.0199, 0"};
  std::vector<std::string> cube;
  for (const char* x : {"0", "0.0199", "0.0398"}) {
    for (const char* y : {"0", "0.0199", "0.0398"}) {
      for (const char* z : {"0", "0.0199"}) cube.push_back(std::string(x) + ", " + y + ", " + z);
    }
  }
  // A face-centred cluster: every sphere touches its neighbours at half a diagonal.
  std::vector<std::string> close;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) {
        if ((i + j + k) % 2 != 0) continue;
        close.push_back(std::to_string(i) + "*0.0199/sqrt(2), " + std::to_string(j) + "*0.0199/sqrt(2), " +
                        std::to_string(k) + "*0.0199/sqrt(2)");
      }
    }
  }
  const std::string frictional = "frictional";
  std::vector<NetworkCase> list;
  list.push_back(
      {.form = "pair", .title = "two spheres", .toml = network(smooth, spheres(pair), frictional)});
  list.push_back({.form = "pair_with_friction",
                  .title = "two spheres with friction and rotation",
                  .toml = network(rough, spheres(pair), frictional)});
  list.push_back({.form = "chain",
                  .title = "five spheres in a row",
                  .toml = network(smooth, spheres(chain), frictional)});
  list.push_back({.form = "square",
                  .title = "four spheres in a square",
                  .toml = network(smooth, spheres(square), frictional)});
  list.push_back({.form = "cube_with_friction",
                  .title = "18 spheres of a cubic lattice with friction",
                  .toml = network(rough, spheres(cube), frictional)});
  list.push_back({.form = "close_packing",
                  .title = "14 spheres of a face-centred cubic lattice",
                  .toml = network(smooth, spheres(close), frictional)});
  list.push_back({.form = "close_packing_with_friction",
                  .title = "14 spheres of a face-centred cubic lattice with friction",
                  .toml = network(rough, spheres(close), frictional)});
  list.push_back(
      {.form = "hertz",
       .title = "two spheres of Hertz's law, 1e-4 m deep",
       .toml = network(smooth, spheres(pair), "hertz_mindlin"),
       .known = {{"float", StressVerdict::wrong_outcome,
                  "of the type: the slope of Hertz's force is a root of the overlap, which cancels to "
                  "three digits of float here"}}});
  list.push_back(
      {.form = "hertz_large",
       .title = "two spheres of 1000 m of Hertz's law, 10 m deep",
       .toml = network(smooth, sphere("0, 0, 0", "1000") + sphere("1990, 0, 0", "1000"), "hertz_mindlin")});
  list.push_back({.form = "dashpots",
                  .title = "a visco-elastic pair of restitution 3e-3",
                  .toml = network(dashpots, spheres(pair), "viscoelastic"),
                  .damped = true});
  list.push_back({.form = "dashpots_chain",
                  .title = "five visco-elastic spheres in a row, restitution 3e-3",
                  .toml = network(dashpots, spheres(chain), "viscoelastic"),
                  .damped = true});
  list.push_back({.form = "bond_moments",
                  .title = "a bonded pair whose bond bends and twists, alpha = 2",
                  .toml = network({{"poisson", "0.25"},
                                   {"friction_angle", "30"},
                                   {"cohesion", "1e9"},
                                   {"adhesion", "1e9"},
                                   {"moment_stiffness", "2"}},
                                  spheres(pair), "cohesive", {{"bond_reach", "1.05"}}),
                  .moment_stiffness = 2});
  list.push_back({.form = "wall_without_friction",
                  .title = "a sphere on a wall, away from its origin",
                  .toml = network(smooth, spheres({"0, 0.0099, 0"}) + wall("0"), frictional),
                  .turned = false});
  const std::vector<KnownVerdict> transit = {
      {"all", StressVerdict::wrong_outcome,
       "Rayleigh's is the time of a wave over a sphere and no limit of a spring: networks allow down to 0.2 "
       "of it, and recommended are 0.1 to 0.4; a property of the method."}};
  const auto refused = [](const std::string& cause, const std::string& says) {
    return std::vector<KnownVerdict>{{"all", StressVerdict::refused, cause, says}};
  };
  const auto given = refused("Waves know Young's modulus, and the spring here is another.",
                             "the stiffness of the material 'grain' is given");
  const auto by_time = refused("Waves know Young's modulus, and the spring here comes from a time.",
                               "the law 'viscoelastic' makes its springs from collision_time");
  for (const char* rule : {"p_wave", "rayleigh"}) {
    const std::string name(rule);
    const auto known = name == "rayleigh" ? transit : std::vector<KnownVerdict>{};
    list.push_back({.form = name + "_close_packing",
                    .title = "14 spheres of a face-centred cubic lattice",
                    .toml = network(rough, spheres(close), frictional),
                    .rule = rule,
                    .known = known});
    list.push_back({.form = name + "_given_mass",
                    .title = "spheres whose masses are given, 1e-6 kg",
                    .toml = network(smooth, spheres(pair, {{"mass", "1e-6"}}), frictional),
                    .rule = rule,
                    .known = known});
    list.push_back({.form = name + "_given_stiffness",
                    .title = "spheres whose springs are given, 1e8 N/m",
                    .toml = network({{"poisson", "0"}, {"stiffness", "1e8"}}, spheres(pair), frictional),
                    .rule = rule,
                    .known = given});
    list.push_back(
        {.form = name + "_collision_time",
         .title = "a visco-elastic pair of tc = 1e-5 s",
         .toml = network({{"poisson", "0"}, {"collision_time", "1e-5"}}, spheres(pair), "viscoelastic"),
         .rule = rule,
         .known = by_time});
  }
  return list;
}

}  // namespace

std::vector<StressCase> critical_step_cases() {
  std::vector<StressCase> cases;
  for (const auto& n : networks()) {
    StressCase c;
    c.kind = "metamorphic";
    c.name = "critical_step";
    c.form = n.form;
    c.title = n.title + ": the step rule '" + n.rule + "' in many orientations against " +
              (n.damped ? "the largest step without growth" : "2/omega of the network");
    c.known = n.known;
    c.cost = 0.05;
    c.run = [n](std::string_view token, const ode::StopFlag& stop) -> std::optional<StressRow> {
      if (find_type(token) == nullptr) return std::nullopt;
      return run_network(n, token, stop);
    };
    cases.push_back(std::move(c));
  }
  return cases;
}

}  // namespace ulpgate
