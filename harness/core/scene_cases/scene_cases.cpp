// States and scenes from their tables.
#include "harness/core/scene_cases/scene_cases.hpp"

#include "harness/core/scene_cases/case_tables.hpp"

namespace ulpgate {

std::vector<StressCase> state_cases() {
  std::vector<StressCase> cases;
  for (const auto& table : {geometry_states(), law_states(), motion_states()}) {
    for (const auto& c : table) cases.push_back(as_stress_case(c));
  }
  for (auto& c : shared_edge_states()) cases.push_back(std::move(c));
  return cases;
}

std::vector<StressCase> scene_cases() {
  std::vector<StressCase> cases;
  for (const auto& table : {contact_scenes(), extreme_scenes()}) {
    for (const auto& c : table) cases.push_back(as_stress_case(c));
  }
  return cases;
}

}  // namespace ulpgate
