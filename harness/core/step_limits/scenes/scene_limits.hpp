// Largest stable steps of scenes, measured in the DEM engine and held against their linearised contacts.
#pragma once

#include <vector>

#include "harness/core/stress/stress_case.hpp"

namespace ulpgate {

// step_limit/rod_pendulum/young_1e2 ... _1e12, step_limit/damped_contact/restitution_..., step_limit/
// free_pair/normal, shear, step_limit/packing/<lattice>_<turn>, boxed: the largest stable step against that
// of the network of contacts.  Figures: "omega_max" (1/s), "limit" and "theory" (s), "limit_over_theory",
// "growth_at_1.01_limit" and "growth_at_1.01_limit_theory" (per step).
// step_limit/p_wave_rule/..., rayleigh_rule/..., stiffness_rule/...: the engine's critical steps (times
// nothing) against that limit.  Figures: "rule" (s), "rule_over_limit", "block_bound_over_limit".
// step_limit/resonances/elastic_pendulum: the largest energy error over z.
[[nodiscard]] std::vector<StressCase> scene_limit_cases();

}  // namespace ulpgate
