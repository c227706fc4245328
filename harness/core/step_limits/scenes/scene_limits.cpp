// The cases of scenes: measured limits and the rules of the engine.
#include "harness/core/step_limits/scenes/scene_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "harness/core/step_limits/scenes/limit_scenes.hpp"
#include "harness/core/step_limits/scenes/resonances.hpp"
#include "harness/core/step_limits/scenes/scene_step.hpp"
#include "kernels/scenes/reader/scene_fault.hpp"

namespace ulpgate {

namespace {

using MakeScene = std::function<LimitScene()>;

// The contacts of a scene as it stands: one step so short that nothing moves makes them.
struct Looked {
  std::unique_ptr<dem::DemEngine> engine;
  ContactNetwork network;
};
std::optional<Looked> look_at(std::string_view token, const LimitScene& s) {
  Looked looked{dem::make_engine(token, dem::Level::own, s.scene, {}), {}};
  if (looked.engine == nullptr) return std::nullopt;
  looked.engine->step(1);
  looked.network = network_of(*looked.engine, s.scene.law, s.walls);
  return looked;
}

// The spectral radius of the leapfrog on one mode at 1.01 times its critical step: with dashpots
// lambda^2 - (2 - a - b) lambda + 1 - a = 0, a = 2 zeta z, b = z^2, where 4 - 2 a - b = 0 at the limit.
double growth_beyond(double damped_step, double undamped_step) {
  const double z_limit = 2 * damped_step / undamped_step;
  const double two_zeta = (4 - z_limit * z_limit) / (2 * z_limit);
  const double z = 1.01 * z_limit;
  const double half = (2 - two_zeta * z - z * z) / 2;
  return -half + std::sqrt(half * half - (1 - two_zeta * z));
}

StressRow measured_row(std::string_view token, LimitScene s, bool one_mode, const ode::StopFlag& stop) {
  StressRow row;
  const auto looked = look_at(token, s);
  const CriticalMode mode = critical_mode(looked->network);
  const double undamped = undamped_critical_step(looked->network);
  row.figures["omega_max"] = 2 / undamped;
  row.figures["theory"] = mode.step;
  // Small enough that 1000 times as much stays linear, and no dashpot pulls; above the rounding of float.
  disturb(s, mode, s.disturbance);
  SceneStepSearch search{s.scene, mode.step};
  // Dashpots let growth begin slowly, and let nothing else grow at all.
  if (mode.step < 0.999 * undamped) search.grown = 100;
  if (!one_mode) {
    search.steps = 150;
    search.resolution = 2e-3;
  }
  const MeasuredStep measured = measure_scene_step(token, search, stop);
  if (!measured.refusal.empty()) {
    row.verdict = StressVerdict::refused;
    row.why = measured.refusal;
    return row;
  }
  const double ratio = measured.largest_stable / mode.step;
  row.figures["limit"] = measured.largest_stable;
  row.figures["limit_over_theory"] = ratio;
  if (measured.growth) row.figures["growth_at_1.01_limit"] = *measured.growth;
  if (one_mode) row.figures["growth_at_1.01_limit_theory"] = growth_beyond(mode.step, undamped);
  row.verdict = std::abs(ratio - 1) <= 0.01 ? StressVerdict::stable : StressVerdict::wrong_outcome;
  row.why =
      fmt::format("stable up to {:.6g} s, {:.5f} of what its contacts say", measured.largest_stable, ratio);
  if (measured.stable_again) {
    row.figures["stable_again_at"] = *measured.stable_again;
    row.why += fmt::format("; stable again at {:.2f} of it", *measured.stable_again);
  }
  return row;
}

StressRow rule_row(std::string_view token, const LimitScene& s, const std::string& rule) {
  StressRow row;
  const auto looked = look_at(token, s);
  const double limit = critical_mode(looked->network).step;
  const dem::CriticalStep critical = looked->engine->critical_step(rule);
  if (!critical.refusal.empty()) {
    row.why = critical.refusal;
    return row;
  }
  const double step = critical.step_s;
  row.figures["theory"] = limit;
  row.figures["rule"] = step;
  row.figures["rule_over_limit"] = step / limit;
  row.figures["block_bound_over_limit"] = block_bound_step(looked->network) / limit;
  row.verdict = step <= limit ? StressVerdict::stable : StressVerdict::wrong_outcome;
  row.why = fmt::format("the rule's step is {:.4g} times the largest stable one", step / limit);
  return row;
}

// What is refused in a type is a row; what is not built in is none.
template <class Row>
std::optional<StressRow> row_or_refusal(std::string_view token, Row&& row) {
  const std::vector<std::string> tokens = dem::engine_tokens();
  if (std::find(tokens.begin(), tokens.end(), token) == tokens.end()) return std::nullopt;
  try {
    return row();
  } catch (const scenes::SceneFault& fault) {
    StressRow refused;
    refused.why = fault.what();
    return refused;
  }
}

StressCase limit_case(std::string name, const MakeScene& make, bool one_mode, std::string title,
                      double cost) {
  StressCase c;
  c.kind = "step_limit";
  c.name = std::move(name);
  c.form = make().name;
  c.title = std::move(title);
  c.cost = cost;
  c.run = [make, one_mode](std::string_view token, const ode::StopFlag& stop) {
    return row_or_refusal(token, [&] { return measured_row(token, make(), one_mode, stop); });
  };
  return c;
}

StressCase rule_case(const std::string& rule, const MakeScene& make) {
  StressCase c;
  c.kind = "step_limit";
  c.name = rule + "_rule";
  c.form = make().name;
  c.title = "The critical step '" + rule + "' of the engine against the largest stable step";
  c.cost = 0.05;
  const bool waves_say_nothing = rule != "stiffness" && c.form == "boxed";
  if (rule == "rayleigh" && c.form != "hertz_on_wall" && !waves_say_nothing) {
    c.known.push_back({"all", StressVerdict::wrong_outcome,
                       "A property of the method: Rayleigh's rule is the time of a surface wave over a body; "
                       "linear contacts of "
                       "kn = E r, let alone stiffer ones, vibrate faster"});
  }
  if (waves_say_nothing) {
    c.known.push_back(
        {"all", StressVerdict::refused,
         "waves know Young's modulus, and the visco-elastic law takes its stiffness from the time "
         "of a collision",
         "makes its springs from collision_time"});
  }
  c.run = [make, rule](std::string_view token, const ode::StopFlag&) {
    return row_or_refusal(token, [&] { return rule_row(token, make(), rule); });
  };
  return c;
}

}  // namespace

std::vector<StressCase> scene_limit_cases() {
  std::vector<StressCase> cases;
  for (int exponent = 2; exponent <= 12; ++exponent) {
    cases.push_back(limit_case(
        "rod_pendulum", [exponent] { return rod_pendulum(std::pow(10.0, exponent)); }, true,
        "Hanging chain of three elastic rods: largest stable step against 2/omega_max", 0.05));
  }
  for (const double restitution : {1.0, 0.8, 0.3, 0.003}) {
    cases.push_back(limit_case(
        "damped_contact", [restitution] { return sphere_on_wall(restitution); }, true,
        "A sphere pressed on a wall, dashpot with velocities half a step old: z <= 2 (sqrt(1 + zeta^2) - "
        "zeta)",
        0.05));
  }
  cases.push_back(limit_case(
      "hertz_contact", [] { return hertz_on_wall(); }, true,
      "A sphere pressed on a wall by Hertz's law: 2/omega of the slope of the force", 0.05));
  for (const double poisson : {0.0, 0.45}) {
    cases.push_back(limit_case(
        "free_pair",
        [poisson] {
          return free_pair(poisson, {1, 0, 0});
        },
        true,
        poisson > 0 ? "Two free spheres: omega^2 = 7 ks/m of shear with rotation"
                    : "Two free spheres: omega^2 = 2 kn/m",
        0.05));
  }
  struct Packing {
    const char* lattice;
    double poisson;
  };
  std::vector<MakeScene> packings;
  for (const Packing& p : {Packing{"chain", 0.0}, Packing{"cubic", 0.3}, Packing{"fcc", 0.3}}) {
    for (const std::string& turn : packing_turns())
      packings.push_back([p, turn] { return bonded_packing(p.lattice, p.poisson, turn); });
  }
  packings.push_back([] { return boxed_packing(0.003); });
  for (const MakeScene& make : packings) {
    cases.push_back(limit_case("packing", make, false,
                               "A packing at rest: largest stable step against 2/omega_max of its contacts",
                               1));
  }
  packings.push_back([] { return hertz_on_wall(); });
  packings.push_back([] { return sphere_far_along_wall(); });
  for (const char* rule : {"p_wave", "rayleigh", "stiffness"}) {
    for (const MakeScene& make : packings) cases.push_back(rule_case(rule, make));
  }
  StressCase scan;
  scan.kind = "step_limit";
  scan.name = "resonances";
  scan.form = "elastic_pendulum";
  scan.title = "Energy error of a swinging elastic rod over z = omega dt below the limit";
  scan.run = [](std::string_view token, const ode::StopFlag& stop) {
    return row_or_refusal(token, [&] { return scan_resonances(token, stop); });
  };
  cases.push_back(std::move(scan));
  return cases;
}

}  // namespace ulpgate
