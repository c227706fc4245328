// The cases of kind "trajectory": initial value problems with an integrator and its steps.
#pragma once

#include <vector>

#include "harness/core/stress/stress_case.hpp"
#include "harness/core/trajectories/trajectory_engine.hpp"

namespace ulpgate {

[[nodiscard]] std::vector<StressCase> trajectory_cases();

// Steps that hold the estimated error of each below `tolerance`, found in double by Radau IIA of three stages
// (stiff problems) or by extrapolation of order 8: the same steps in every type.  Kept for the next call.
// Throws std::invalid_argument for an unknown problem, and std::runtime_error where the end is not reached.
[[nodiscard]] const StepPlan& step_plan(std::string_view problem, std::string_view end, double tolerance);

}  // namespace ulpgate
