// The catalogue of stiff and extreme cases.
#pragma once

#include <vector>

#include "harness/core/stress/stress_case.hpp"

namespace ulpgate {

// Every case, by kind; keys are unique.
[[nodiscard]] const std::vector<StressCase>& stress_catalogue();

}  // namespace ulpgate
