// Complex powers, where MPC's own search for exact results without end in sight.
#pragma once

#include "reference/oracle/oracle.hpp"

namespace ulpgate::oracle {

// out = z^w = exp(w log z), on C99's branch; either part within 2^-24 ulp before its last rounding.  Of a
// power beyond MPFR's range the parts are infinities or zeros with the signs that they have.
ExactParts power(mpc_ptr out, mpc_srcptr z, mpc_srcptr w, mpc_rnd_t rounding);

// log x of x > 0, within 2^-4 ulp before its last rounding, for less than MPFR's, which is rounded correctly.
// `out` is not x.
void logarithm_of(mpfr_ptr out, mpfr_srcptr x);

}  // namespace ulpgate::oracle
