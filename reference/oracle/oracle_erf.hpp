// Exact values of the error functions: MPFR's, and at moderate arguments, where those take up to 70 ms, the
// trapezoidal rule.
#pragma once

#include <mpfr.h>

namespace ulpgate::oracle {

// erf(x) and erfc(x), correctly rounded to nearest, with MPFR's ternary value: its sign tells the direction
// of the rounding, 0 that there was none.
int error_function(mpfr_ptr out, mpfr_srcptr x);
int complementary_error_function(mpfr_ptr out, mpfr_srcptr x);

}  // namespace ulpgate::oracle
