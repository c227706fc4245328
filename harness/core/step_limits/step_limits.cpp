// All cases of largest stable steps.
#include "harness/core/step_limits/step_limits.hpp"

#include <iterator>
#include <utility>

#include "harness/core/step_limits/integrator_limits.hpp"
#include "harness/core/step_limits/scenes/scene_limits.hpp"

namespace ulpgate {

std::vector<StressCase> step_limit_cases() {
  std::vector<StressCase> cases = integrator_limit_cases();
  std::vector<StressCase> of_scenes = scene_limit_cases();
  std::move(of_scenes.begin(), of_scenes.end(), std::back_inserter(cases));
  return cases;
}

}  // namespace ulpgate
