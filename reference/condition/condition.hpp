// Condition numbers of functions at a point, from the oracle alone.
#pragma once

#include <array>
#include <span>

#include "reference/oracle/oracle.hpp"

namespace ulpgate {

// Componentwise relative condition number of part `part` of f at args: sum_i |x_i df/dx_i| / |f| (Higham,
// Accuracy and Stability of Numerical Algorithms, 2nd ed., section 1.6).  Derivatives are central differences
// of the oracle with a relative step of 2^-(bits+32), less for large arguments of periodic functions, so the
// result is good to 2^-90 of 1 or of itself, whichever is larger, except within such a step of a singularity,
// where the one-sided difference is taken.  NaN where f is not finite; infinity where f is 0 and its
// derivative is not.  Integer-valued arguments (degrees and orders) are held fixed.
[[nodiscard]] double condition_number(const FunctionInfo& f, std::span<const MpfrValue> args, int part,
                                      long bits);

}  // namespace ulpgate
