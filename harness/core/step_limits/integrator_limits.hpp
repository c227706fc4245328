// Largest stable steps of the integrators, measured and held against theory, as cases.
#pragma once

#include <string>
#include <string_view>

#include "harness/core/step_limits/stability_engine.hpp"
#include "harness/core/stress/stress_case.hpp"

namespace ulpgate {

enum class LinearProblem { oscillator, decay };  // q'' = -q; y' = -y

// One integrator in the type of the engine.  Figures: "limit" and "theory" in z = omega dt (absent where
// there is none up to 12), "gap_1_from", "gap_1_to", "gap_1_growth" ... of narrow unstable intervals below
// the limit, "gaps_hidden_by_rounding" of those of the theory that are too shallow for the type,
// "reentry_1_from", "reentry_1_to" ... of stable intervals above it, "growth_at_1.01_limit" and what theory
// says of it, and "step_matrix_error_u", the largest difference from theory below the limit in units of
// rounding.  Of a method whose limit in print is of another arrangement of its coefficients also that limit,
// as printed and as computed, and the orders of both.
[[nodiscard]] StressRow measure_step_limit(const StabilityEngine& engine, LinearProblem problem,
                                           std::string_view integrator, const ode::StopFlag& stop);

// step_limit/oscillator/<integrator> and step_limit/decay/<integrator> for every integrator of fixed order.
[[nodiscard]] std::vector<StressCase> integrator_limit_cases();

}  // namespace ulpgate
