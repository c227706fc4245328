// The largest stable step of a scene in the engine of a type, found by runs at rising steps.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/dem/engine/engine.hpp"
#include "kernels/ode/stepper/stop_flag.hpp"

namespace ulpgate {

// A scene about to be disturbed by its velocities: the kinetic energy of the start is what growth is measured
// against.
struct SceneStepSearch {
  scenes::Scene scene;  // its dt is replaced
  double expected = 0;  // s, where the limit is looked for: from 0.1 to 1.1 of it
  std::uint64_t steps = 300;
  double grown = 1e5;        // times the kinetic energy of the start: unstable
  double resolution = 5e-4;  // of the limit, relative
};

struct MeasuredStep {
  double largest_stable = 0;  // s; 0: none of those tried
  // A stable step above an unstable one, as a multiple of `expected`; nothing where there is none.
  std::optional<double> stable_again;
  // The factor by which velocities grow in a step of 1.01 times the expected limit; nothing where they do
  // not.
  std::optional<double> growth;
  std::string refusal;  // of the scene itself
};

// A step is unstable where the kinetic energy grows to `grown` times that of the start or leaves the numbers.
// Throws ode::Stopped, and std::invalid_argument where the token is not built in.
[[nodiscard]] MeasuredStep measure_scene_step(std::string_view token, const SceneStepSearch& search,
                                              const ode::StopFlag& stop);

// Decimal text that a scene reads back as this number, rounded to its type.
[[nodiscard]] std::string number_text(double x);

}  // namespace ulpgate
