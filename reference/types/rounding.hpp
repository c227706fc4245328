// Rounding of an MPFR number to a FloatFormat, gradual underflow and overflow included.
#pragma once

#include <mpfr.h>

#include "reference/types/format.hpp"

namespace ulpgate {

// Rounds x in place to the nearest value of the format (ties to even); beyond the largest value it becomes an
// infinity, as IEEE 754 section 4.3.1 says.
void round_to_format(mpfr_ptr x, const FloatFormat& format);

// Exponent of the binade of a regular x: floor(log2 |x|).
[[nodiscard]] inline long binade(mpfr_srcptr x) {
  return static_cast<long>(mpfr_get_exp(x)) - 1;
}

// Moves x, a value of the format, `steps` representable values up (or down if negative); stops at infinities.
void step_in_format(mpfr_ptr x, long steps, const FloatFormat& format);

}  // namespace ulpgate
