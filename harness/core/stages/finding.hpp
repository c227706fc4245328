// Finding: what a stage of the reference knows of one part of one result.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "harness/core/stages/native_bits.hpp"
#include "reference/oracle/oracle.hpp"
#include "reference/types/real_types.hpp"
#include "reference/ulp/ulp.hpp"

namespace ulpgate {

inline constexpr double smallest_error = std::numeric_limits<double>::denorm_min();

// What RealHP<4> is off by, in ulp of Real.
template <RealType Real>
inline constexpr double full_slack = power_of_two(
    std::max(-1000, std::numeric_limits<Real>::digits + 2 - std::numeric_limits<RealHP<4, Real>>::digits));
// Of an error like this RealHP<4> may see no more than that it is one.
inline constexpr double unseen_error = 0x1p-60;

// A mismatch, or a finite result whose error lies in [least, greatest] ULP.  A stage that does not know the
// outcome, or whether the result is the correctly rounded one, gives no finding at all.
struct Finding {
  Outcome outcome = Outcome::finite;
  double least = 0;  // 0 only where the result is exact
  double greatest = 0;
  double distance = 0;  // float_distance to the correctly rounded value, or a number that it does not exceed
  bool distance_known = true;
  bool correctly_rounded = true;

  // Whether two errors leave the same trace wherever errors are recorded one by one.
  [[nodiscard]] bool error_known() const {
    return least == greatest || recorded({least}) == recorded({greatest});
  }
  // Whether a judgement by a better reference is one that this finding allows; a margin covers the rounding
  // of the error itself.
  [[nodiscard]] bool allows(const Judgement& j) const {
    if (j.outcome != outcome) return false;
    if (outcome != Outcome::finite) return true;
    constexpr double margin = 0x1p-48;
    return j.error.value >= least * (1 - margin) && j.error.value <= greatest * (1 + margin) &&
           j.correctly_rounded == correctly_rounded &&
           (distance_known ? j.distance == distance : j.distance <= distance);
  }
  // Whether there is a judgement that both allow.
  [[nodiscard]] bool agrees_with(const Finding& other) const {
    if (other.outcome != outcome) return false;
    if (outcome != Outcome::finite) return true;
    constexpr double margin = 0x1p-48;
    if (other.greatest * (1 + margin) < least || greatest * (1 + margin) < other.least ||
        other.correctly_rounded != correctly_rounded)
      return false;
    if (distance_known && other.distance_known) return distance == other.distance;
    return !(distance_known && distance > other.distance) &&
           !(other.distance_known && other.distance > distance);
  }
};

// Sets the distance of a finding whose error says it.  On one grid the correctly rounded value is the nearest
// number of steps away; across a power of two the steps have two sizes.
inline void set_distance(Finding& f, bool one_grid) {
  const double low = std::floor(f.least + 0.5);
  const double high = std::floor(f.greatest + 0.5);
  if (one_grid && low == high && f.least != low - 0.5) {
    f.distance = low;
  } else if (one_grid && f.least == 0.5 && f.greatest == 0.5) {
    f.distance = f.correctly_rounded ? 0 : 1;
  } else {
    f.distance = 2 * f.greatest + 2;
    f.distance_known = false;
  }
}

[[nodiscard]] inline Finding finding_of(const Judgement& j) {
  return {j.outcome, j.error.value, j.error.value, j.distance, true, j.correctly_rounded};
}

// The screen and the full reference differ by more than the screen's bound: one of them is wrong, and nothing
// measured with them counts.
class ReferenceDisagreement : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace ulpgate
