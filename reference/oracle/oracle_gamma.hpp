// Exact values of the gamma functions: MPFR's, and next to zero, where those take up to 0.7 ms, a short
// series.
#pragma once

#include <mpfr.h>

namespace ulpgate::oracle {

// Gamma(x) and ln|Gamma(x)|, correctly rounded to nearest, with MPFR's ternary value: its sign tells the
// direction of the rounding, 0 that there was none.
int gamma(mpfr_ptr out, mpfr_srcptr x);
int log_gamma(mpfr_ptr out, mpfr_srcptr x);

}  // namespace ulpgate::oracle
