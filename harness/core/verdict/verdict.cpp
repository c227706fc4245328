// Verdict.
#include "harness/core/verdict/verdict.hpp"

#include <cmath>

namespace ulpgate {

int exit_code(Standing standing) {
  switch (standing) {
    case Standing::pass:
      return 0;
    case Standing::regression:
    case Standing::not_finite:
      return 1;
    case Standing::bad_input:
    case Standing::another_plan:
    case Standing::another_machine:
      return 2;
    case Standing::incomplete:
    case Standing::nothing_measured:
      return 3;
    case Standing::environment:
      break;
  }
  return 4;
}

Standing standing_of(int code) {
  switch (code) {
    case 0:
      return Standing::pass;
    case 1:
      return Standing::regression;
    case 2:
      return Standing::bad_input;
    case 3:
      return Standing::incomplete;
    default:
      return Standing::environment;
  }
}

Verdict& Verdict::operator|=(const Verdict& other) {
  for (std::size_t i = 0; i < standing_count; ++i) counts_[i] += other.counts_[i];
  return *this;
}

Standing Verdict::standing() const {
  for (std::size_t i = standing_count; i-- > 0;)
    if (counts_[i] > 0) return static_cast<Standing>(i);
  return Standing::pass;
}

Standing measured(std::uint64_t done, std::uint64_t planned) {
  if (done == 0) return Standing::nothing_measured;
  // More than planned is not what was planned either.
  return done == planned ? Standing::pass : Standing::incomplete;
}

Standing at_most(double value, double limit) {
  if (!std::isfinite(value) || std::isnan(limit)) return Standing::not_finite;
  return value <= limit ? Standing::pass : Standing::regression;
}

Standing at_least(double value, double limit) {
  if (!std::isfinite(value) || std::isnan(limit)) return Standing::not_finite;
  return value >= limit ? Standing::pass : Standing::regression;
}

}  // namespace ulpgate
