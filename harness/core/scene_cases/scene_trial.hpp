// SceneTrial: a small scene in one type beside RealHP<4>, from the same numbers; its rounding, its step's
// error and its condition.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "harness/core/stress/stress_case.hpp"
#include "kernels/dem/engine/engine.hpp"

namespace ulpgate {

// A scene that is text, read without errors; throws std::invalid_argument with them otherwise.
[[nodiscard]] scenes::Scene scene_of(std::string_view toml);

// The sizes that differences of two states are relative to.
struct StateScale {
  double position = 0;  // m, the largest of all |x_i| and radii
  double speed = 0;     // m/s
  double spin = 0;      // rad/s
};
// Raises `scale` to what the engine's state holds.
void raise_scale(const dem::DemEngine& engine, StateScale& scale);

// The largest over the bodies of |x - x'|, |v - v'| and |w - w'|, each over its scale; infinite where a
// number of either is not finite.
[[nodiscard]] double state_distance(const dem::DemEngine& a, const dem::DemEngine& b,
                                    const StateScale& scale);

// A state's text with every sphere moved by +-`size` of its own position or radius, and of its velocities, in
// directions that `seed` draws.
[[nodiscard]] std::string perturbed_state(dem::DemEngine& engine, double size, unsigned seed);

// Both runs at their end.
struct SceneTrial {
  const dem::DemEngine& own;
  const dem::DemEngine& reference;
  double kinetic_start = 0;  // J, of the own run
  double u = 0;
  double dt_s = 0;
};

struct SceneCase {
  std::string name, form, title;
  std::string toml;
  std::uint64_t steps = 1;
  // What is wrong with how it went; empty: nothing.  May add figures and set the stepping error against a
  // closed form.
  std::function<std::string(const SceneTrial&, StressRow&)> outcome{};
  std::vector<KnownVerdict> known{};
};

// E: own type against RealHP<4> started from the same numbers, after all steps.  Stepping error: the step
// against its half, both in RealHP<4>.  kappa: the root of the sum of squares over the steps of what a
// relative perturbation of the state before a step becomes at the end, from sixteen steps of the run.
[[nodiscard]] StressRow run_scene_case(const SceneCase& c, std::string_view token, const ode::StopFlag& stop);

// kappa alone, of a scene after `steps`, from `starts` of them; infinite where a perturbed run leaves the
// numbers.
[[nodiscard]] double trajectory_condition(std::string_view token, const scenes::Scene& scene,
                                          std::uint64_t steps, std::uint64_t starts,
                                          const ode::StopFlag& stop);

[[nodiscard]] StressCase as_stress_case(SceneCase c);

}  // namespace ulpgate
