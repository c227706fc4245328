// Divergence: how far two simulations of one scene, of different precision, have come apart.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/dem/engine/engine.hpp"
#include "reference/types/format.hpp"

namespace ulpgate {

struct Divergence {
  std::uint64_t step = 0;
  double time_s = 0;
  // Largest over the bodies: the Euclidean distance, and componentwise in ULP of the tested type.  Infinite
  // where a number of either is not finite.
  double position_error_m = 0;
  double position_error_ulp = 0;
  double velocity_error_m_per_s = 0;
  double velocity_error_ulp = 0;
  double energy_error_j = 0;  // of the sum; 0 where no account is kept
  // Contacts that exert a force in one simulation and not in the other.
  std::vector<dem::BodyPair> only_tested;
  std::vector<dem::BodyPair> only_reference;
};

// Compares the two engines as they are, which must have taken the same number of steps; `format` is that of
// the tested type.
[[nodiscard]] Divergence compare_engines(const dem::DemEngine& tested, const dem::DemEngine& reference,
                                         const FloatFormat& format);

// 1, 2, 5, 10, 20, 50 ... up to and including `last`.
[[nodiscard]] std::vector<std::uint64_t> comparison_steps(std::uint64_t last);

// A number of a scene that is good to the digits of a double only, although the type of the run has more.
struct ShortConstant {
  std::string what;   // "mass of body 1"
  std::string value;  // hexfloat
};

// The precision ladder over a scene's start state, in a type of more digits than double: a number made in
// full precision fills its significand (or is a short number such as a half, which float holds as well); one
// whose significand ends between float's and double's last bit was made in double and is good to 16 digits
// only.
[[nodiscard]] std::vector<ShortConstant> short_constants(const dem::DemEngine& wide);

}  // namespace ulpgate
