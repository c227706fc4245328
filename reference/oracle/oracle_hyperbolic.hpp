// sinh and cosh of one number, both correctly rounded.
#pragma once

#include <mpfr.h>

namespace ulpgate::oracle {

// Of a finite x; sh and ch have one precision.  mpfr_sinh_cosh (MPFR 4.2) takes exponentials of as many more
// bits as lie between x and 1, a hundred microseconds for 2^-900; one at a time both see at once that the
// first term of their series is enough.
inline void sinh_and_cosh(mpfr_ptr sh, mpfr_ptr ch, mpfr_srcptr x) {
  if (mpfr_regular_p(x) != 0 && -2 * mpfr_get_exp(x) > mpfr_get_prec(sh) + 16) {
    mpfr_sinh(sh, x, MPFR_RNDN);
    mpfr_cosh(ch, x, MPFR_RNDN);
  } else {
    mpfr_sinh_cosh(sh, ch, x, MPFR_RNDN);
  }
}

}  // namespace ulpgate::oracle
