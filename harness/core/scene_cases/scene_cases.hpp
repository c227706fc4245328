// Extreme DEM cases: states of kernels, small scenes, and scenes that are run again transformed.
#pragma once

#include <vector>

#include "harness/core/stress/stress_case.hpp"

namespace ulpgate {

// Kernels at the ends of what their rules are made for; kind "state".
[[nodiscard]] std::vector<StressCase> state_cases();
// Small scenes, against the same scene in RealHP<4>, half the step and closed forms; kind "scene".
[[nodiscard]] std::vector<StressCase> scene_cases();
// Scenes and step rules under transformations that must change nothing; kind "metamorphic".
[[nodiscard]] std::vector<StressCase> metamorphic_cases();

}  // namespace ulpgate
