// The cases of kind "trajectory": initial value problems with an integrator and its steps.
#pragma once

#include <vector>

#include "harness/core/stress/stress_case.hpp"
#include "harness/core/trajectories/step_plan.hpp"

namespace ulpgate {

[[nodiscard]] std::vector<StressCase> trajectory_cases();

}  // namespace ulpgate
