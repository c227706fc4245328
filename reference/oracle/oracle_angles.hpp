// Sines of huge angles and arguments of complex numbers to nearly the last bit, for less than MPFR takes to
// round them correctly.
#pragma once

#include <mpfr.h>

namespace ulpgate::oracle {

// s = sin x, c = cos x, of one precision; each is within 2^-4 ulp of it before its last rounding.  Numbers
// with exponents up to 2^20 are reduced by as many bits of 2/pi as matter (Payne and Hanek 1983), where MPFR
// divides by pi to all of them.
void sine_and_cosine(mpfr_ptr s, mpfr_ptr c, mpfr_srcptr x);

// x = (4k + quadrant) pi/2 + r, |r| <= pi/4, r within 2^-bits of x and its own last rounding.  False, and
// nothing else, where the exponent of x is above 2^20.
bool reduce_to_quadrant(unsigned& quadrant, mpfr_ptr r, mpfr_srcptr x, long bits);

// arg(x + iy), within 2^-4 ulp before its last rounding.  `out` is neither x nor y.
void angle_of(mpfr_ptr out, mpfr_srcptr y, mpfr_srcptr x);

}  // namespace ulpgate::oracle
