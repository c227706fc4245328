// Exact values of the gamma functions: MPFR's, and next to zero, where those take up to 0.7 ms, a short
// series.
#pragma once

#include <mpfr.h>

#include "reference/oracle/rounding_made.hpp"

namespace ulpgate::oracle {

// Gamma(x) and ln|Gamma(x)|, correctly rounded to nearest.
RoundingMade gamma(mpfr_ptr out, mpfr_srcptr x);
RoundingMade log_gamma(mpfr_ptr out, mpfr_srcptr x);

// Whether the series is for this x at this many bits.  It answers there unless the value lies within 2^-31 of
// the last bit of a number or a midpoint.
[[nodiscard]] bool series_serves_gamma(mpfr_srcptr x, long bits);

}  // namespace ulpgate::oracle
