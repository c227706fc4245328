// What is refused of a scene: a number out of its range, told in any Real, and a scene that is too large.
#pragma once

#include <stdexcept>
#include <string>

#include "reference/types/real_types.hpp"

namespace ulpgate::scenes {

// A scene that read_scene() accepted and that cannot be simulated in the type of the run; what() names the
// key, or the body: "sphere[0].radius: must be positive, is '1e-60' = 0".
struct SceneFault : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};
// One that would take more memory, or more numbers of bodies, than is allowed.
struct SceneTooLarge : SceneFault {
  using SceneFault::SceneFault;
};

// What a number must be, besides finite.
enum class Range { any, not_negative, positive, unit_open_closed, below_one, acute };

// Neither infinite nor NaN, which times 0 are NaN.
template <RealType Real>
[[nodiscard]] bool is_finite(const Real& x) {
  return x * Real(0) == Real(0);
}

// What is asked of a number that `value` is not; empty where it is in the range.
template <RealType Real>
[[nodiscard]] std::string range_fault(const Real& value, Range range) {
  if (!is_finite(value)) return "must be finite";
  switch (range) {
    case Range::any:
      return "";
    case Range::not_negative:
      return value >= 0 ? "" : "must not be negative";
    case Range::positive:
      return value > 0 ? "" : "must be positive";
    case Range::unit_open_closed:
      return value > 0 && value <= 1 ? "" : "must be above 0 and at most 1";
    case Range::below_one:
      return value >= 0 && value < 1 ? "" : "must be on [0, 1)";
    case Range::acute:
      return value >= 0 && value < 90 ? "" : "must be on [0, 90)";
  }
  return "";
}

}  // namespace ulpgate::scenes
