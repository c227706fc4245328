// Critical steps of small networks in many orientations.
#include <algorithm>
#include <cmath>

#include "harness/core/scene_cases/case_tables.hpp"
#include "harness/core/scene_cases/network_vibrations.hpp"
#include "harness/core/scene_cases/scene_transform.hpp"
#include "harness/core/subject/registry.hpp"

namespace ulpgate {

namespace {

using dem::DemEngine;

// A network at rest and what is true of its step.
struct NetworkCase {
  std::string form, title, toml;
  bool rotation = false;
  // The tangent springs where the law is not linear, or a bond has moments; else linear_springs().
  std::function<std::vector<ContactSpring>(const DemEngine&)> springs{};
  bool damped = false;  // the limit with dashpots, not 2/omega
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

std::string spheres(const std::vector<std::string>& positions, const std::string& more) {
  std::string text;
  for (const auto& p : positions) text += "[[sphere]]\nposition = [" + p + "]\nradius = \"0.01\"\n" + more;
  return text;
}

std::string network(const std::string& material, const std::string& bodies, const std::string& contacts) {
  return "name = \"network\"\n[[material]]\nname = \"grain\"\ndensity = \"2600\"\nyoung = \"1e7\"\n" +
         material + bodies + "[contacts]\n" + contacts + "[run]\ndt = \"1e-12\"\nuntil = \"1\"\n";
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
    const double step = engine->critical_step(c.rule);
    const auto springs = c.springs ? c.springs(*engine) : linear_springs(*engine);
    const NetworkVibrations vibrations(*engine, springs, c.rotation);
    frequency = vibrations.largest_frequency();
    const double limit = c.damped ? vibrations.largest_stable_step() : 2 / frequency;
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
    row.why = "the step is " + std::to_string(worst) + " times the largest stable one";
  } else if (row.verdict == StressVerdict::unstable) {
    row.verdict = StressVerdict::wrong_outcome;
    row.why = "the step changes by a factor of " + std::to_string(most / least) +
              " with the orientation or the place";
  }
  return row;
}

// Hertz: dF/du = 3/2 kn sqrt(u), shear ks sqrt(u).
std::vector<ContactSpring> hertz_springs(const DemEngine& e) {
  auto springs = linear_springs(e);
  for (auto& s : springs) {
    Eigen::Vector3d d;
    for (int c = 0; c < 3; ++c) {
      d[c] = e.approximate(dem::BodyQuantity::position, s.second, static_cast<std::size_t>(c)) -
             e.approximate(dem::BodyQuantity::position, s.first, static_cast<std::size_t>(c));
    }
    const double root = std::sqrt(e.radius(s.first) + e.radius(s.second) - d.norm());
    s.kn *= 1.5 * root;
    s.ks *= root;
  }
  return springs;
}

std::vector<NetworkCase> networks() {
  const std::string smooth = "poisson = \"0\"\n";
  const std::string rough = "poisson = \"0.45\"\nfriction_angle = \"30\"\n";
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
        close.push_back("\"" + std::to_string(i) + "*0.0199/sqrt(2)\", \"" + std::to_string(j) +
                        "*0.0199/sqrt(2)\", \"" + std::to_string(k) + "*0.0199/sqrt(2)\"");
      }
    }
  }
  const std::string frictional = "law = \"frictional\"\n";
  const auto defect = [](const std::string& cause) {
    return std::vector<KnownVerdict>{{"all", StressVerdict::wrong_outcome, cause}};
  };
  std::vector<NetworkCase> list;
  list.push_back(
      {.form = "pair", .title = "two spheres", .toml = network(smooth, spheres(pair, ""), frictional)});
  list.push_back({.form = "pair_with_friction",
                  .title = "two spheres with friction and rotation",
                  .toml = network(rough, spheres(pair, ""), frictional),
                  .rotation = true});
  list.push_back({.form = "chain",
                  .title = "five spheres in a row",
                  .toml = network(smooth, spheres(chain, ""), frictional)});
  list.push_back({.form = "square",
                  .title = "four spheres in a square",
                  .toml = network(smooth, spheres(square, ""), frictional)});
  list.push_back({.form = "cube_with_friction",
                  .title = "18 spheres of a cubic lattice with friction",
                  .toml = network(rough, spheres(cube, ""), frictional),
                  .rotation = true});
  list.push_back({.form = "close_packing",
                  .title = "14 spheres of a face-centred cubic lattice",
                  .toml = network(smooth, spheres(close, ""), frictional)});
  list.push_back({.form = "close_packing_with_friction",
                  .title = "14 spheres of a face-centred cubic lattice with friction",
                  .toml = network(rough, spheres(close, ""), frictional),
                  .rotation = true});
  list.push_back(
      {.form = "hertz",
       .title = "two spheres of Hertz's law, 1e-4 m deep",
       .toml = network(smooth, spheres(pair, ""), "law = \"hertz_mindlin\"\n"),
       .springs = hertz_springs,
       .known = {{"float", StressVerdict::wrong_outcome,
                  "of the type: the slope of Hertz's force is a root of the overlap, which cancels to "
                  "three digits of float here"}}});
  list.push_back({.form = "hertz_large",
                  .title = "two spheres of 1000 m of Hertz's law, 10 m deep",
                  .toml = network(smooth,
                                  "[[sphere]]\nposition = [0, 0, 0]\nradius = 1000\n[[sphere]]\nposition = "
                                  "[1990, 0, 0]\nradius = 1000\n",
                                  "law = \"hertz_mindlin\"\n"),
                  .springs = hertz_springs});
  list.push_back({.form = "dashpots",
                  .title = "a visco-elastic pair of restitution 3e-3",
                  .toml = network("collision_time = \"1e-3\"\nrestitution_normal = \"3e-3\"\n",
                                  spheres(pair, ""), "law = \"viscoelastic\"\n"),
                  .damped = true});
  list.push_back({.form = "dashpots_chain",
                  .title = "five visco-elastic spheres in a row, restitution 3e-3",
                  .toml = network("collision_time = \"1e-3\"\nrestitution_normal = \"3e-3\"\n",
                                  spheres(chain, ""), "law = \"viscoelastic\"\n"),
                  .damped = true});
  list.push_back({.form = "bond_moments",
                  .title = "a bonded pair whose bond bends and twists, alpha = 2",
                  .toml = network("poisson = \"0.25\"\nfriction_angle = \"30\"\ncohesion = \"1e9\"\nadhesion "
                                  "= \"1e9\"\nmoment_stiffness = \"2\"\n",
                                  spheres(pair, ""), "law = \"cohesive\"\nbond_reach = \"1.05\"\n"),
                  .rotation = true,
                  .springs = [](const DemEngine& e) {
                    auto springs = linear_springs(e);
                    // kr = r1 r2 ks alpha.
                    for (auto& s : springs) s.moment = 2 * e.radius(s.first) * e.radius(s.second) * s.ks;
                    return springs;
                  }});
  list.push_back(
      {.form = "wall_without_friction",
       .title = "a sphere on a wall, away from its origin",
       .toml = network(
           smooth,
           "[[sphere]]\nposition = [0, 0.0099, 0]\nradius = \"0.01\"\n[[wall]]\naxis = \"y\"\nposition = 0\n",
           frictional),
       .turned = false});
  const auto transit = defect(
      "Rayleigh's is the time of a wave over a sphere and no limit of a spring: the network here allows 0.21 "
      "of it, "
      "and recommended are 0.1 to 0.4; a property of the rule.");
  const auto given = defect(
      "The rules of waves know density and Young's modulus alone: a mass, a spring or a collision time that "
      "is "
      "given instead is left out, where nothing should be said; a defect of the rule.");
  for (const char* rule : {"p_wave", "rayleigh"}) {
    const std::string name(rule);
    const auto packing_known = name == "rayleigh" ? transit : std::vector<KnownVerdict>{};
    list.push_back({.form = name + "_close_packing",
                    .title = "14 spheres of a face-centred cubic lattice",
                    .toml = network(rough, spheres(close, ""), frictional),
                    .rotation = true,
                    .rule = rule,
                    .known = packing_known});
    list.push_back({.form = name + "_given_mass",
                    .title = "spheres whose masses are given, 1e-6 kg",
                    .toml = network(smooth, spheres(pair, "mass = \"1e-6\"\n"), frictional),
                    .rule = rule,
                    .known = given});
    list.push_back({.form = name + "_given_stiffness",
                    .title = "spheres whose springs are given, 1e8 N/m",
                    .toml = network(smooth + "stiffness = \"1e8\"\n", spheres(pair, ""), frictional),
                    .rule = rule,
                    .known = given});
    list.push_back({.form = name + "_collision_time",
                    .title = "a visco-elastic pair of tc = 1e-5 s",
                    .toml = network(smooth + "collision_time = \"1e-5\"\n", spheres(pair, ""),
                                    "law = \"viscoelastic\"\n"),
                    .rule = rule,
                    .known = given});
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
