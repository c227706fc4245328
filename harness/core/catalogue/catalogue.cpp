// stress_catalogue(): the families of cases, one behind the other.
#include "harness/core/catalogue/catalogue.hpp"

#include <algorithm>
#include <iterator>

#include "harness/core/formula_cases/formula_cases.hpp"
#include "harness/core/scene_cases/scene_cases.hpp"
#include "harness/core/step_limits/step_limits.hpp"
#include "harness/core/trajectories/trajectory_cases.hpp"

namespace ulpgate {

const std::vector<StressCase>& stress_catalogue() {
  static const std::vector<StressCase> list = [] {
    std::vector<StressCase> all;
    for (const auto& family :
         {formula_cases, trajectory_cases, state_cases, scene_cases, metamorphic_cases, step_limit_cases}) {
      auto cases = family();
      std::ranges::move(cases, std::back_inserter(all));
    }
    return all;
  }();
  return list;
}

}  // namespace ulpgate
