// A scan for steps at which the leapfrog resonates with a nonlinear motion.
#pragma once

#include <string_view>

#include "harness/core/stress/stress_case.hpp"

namespace ulpgate {

// A mass on one elastic rod, swinging from the horizontal while the rod vibrates by a tenth of its length:
// the largest energy error in 600 steps at z = omega dt from 0.1 to 1.95 and close around 2 sin(pi m/n),
// where the vibration takes n/m steps.  Figures: "energy_error_at_<z>" of some z, "resonances" (how many z
// err at least 10 times as much as their neighbours), "resonance_1_z", "resonance_1_ratio" ...,
// "diverged_from" (z, from where on the energy error always passes 100).
[[nodiscard]] StressRow scan_resonances(std::string_view token, const ode::StopFlag& stop);

}  // namespace ulpgate
