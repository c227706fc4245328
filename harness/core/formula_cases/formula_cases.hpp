// The formulas as cases of the stress catalogue.
#pragma once

#include <vector>

#include "harness/core/stress/stress_case.hpp"

namespace ulpgate {

// One case a form of every problem, kind "formula", in the order of the problems.
[[nodiscard]] std::vector<StressCase> formula_cases();

}  // namespace ulpgate
