// StepPlan by tolerance, and the times at which planned runs of one problem can be compared.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "harness/core/trajectories/trajectory_engine.hpp"

namespace ulpgate {

// Steps that hold the estimated error of each below `tolerance`, found in double by Radau IIA of three stages
// (stiff problems) or by extrapolation of order 8: the same steps in every type.  Kept for the next call.
// Throws std::invalid_argument for an unknown problem, and std::runtime_error where the end is not reached.
[[nodiscard]] const StepPlan& step_plan(std::string_view problem, std::string_view end, double tolerance);

// The tolerances that graded_plan() takes: below, rounding in double would choose the steps; above, orbits
// leave for where there are no steps.
inline constexpr double finest_tolerance = 1e-13;
inline constexpr double coarsest_tolerance = 1e-3;
// Times of every graded plan, the end among them.
inline constexpr std::size_t graded_times_count = 16;

// Times at equal shares of the steps that the problem asks for at a tolerance of 1e-9: dense where the
// solution is fast.  Exact numbers, rising; all but the last, which is the end.  Throws as step_plan().
[[nodiscard]] const std::vector<double>& graded_times(std::string_view problem, std::string_view end);

// Steps as of step_plan() that come by each of the graded times, exactly: the sums of the steps up to them
// are these very numbers.
struct GradedPlan {
  StepPlan plan;
  std::vector<std::uint64_t> behind;  // of the graded times: the number of steps before; the last that of all
};
// Kept for the next call.  Throws as step_plan(), ode::Stopped, and std::invalid_argument for a tolerance
// outside the range above.
[[nodiscard]] const GradedPlan& graded_plan(std::string_view problem, std::string_view end, double tolerance,
                                            const ode::StopFlag& stop = {});

}  // namespace ulpgate
