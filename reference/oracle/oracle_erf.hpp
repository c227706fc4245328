// Exact values of the error functions: MPFR's, and at moderate arguments, where those take up to 70 ms, the
// trapezoidal rule.
#pragma once

#include <mpfr.h>

#include "reference/oracle/rounding_made.hpp"

namespace ulpgate::oracle {

// erf(x) and erfc(x), correctly rounded to nearest.
RoundingMade error_function(mpfr_ptr out, mpfr_srcptr x);
RoundingMade complementary_error_function(mpfr_ptr out, mpfr_srcptr x);

// Whether the trapezoidal rule is for erf(x) and for erfc(x) at this many bits.  It answers there unless the
// value lies within 2^-27 of the last bit of a number or a midpoint.
[[nodiscard]] bool rule_serves_erf(mpfr_srcptr x, long bits);
[[nodiscard]] bool rule_serves_erfc(mpfr_srcptr x, long bits);

}  // namespace ulpgate::oracle
