// The cases of largest stable steps: of integrators on linear problems and of scenes.
#pragma once

#include <vector>

#include "harness/core/stress/stress_case.hpp"

namespace ulpgate {

// Of kind "step_limit".  Stable is a measured limit that agrees with theory; a method without any stable step
// is unstable, as known of it; any other limit is a wrong outcome.
[[nodiscard]] std::vector<StressCase> step_limit_cases();

}  // namespace ulpgate
