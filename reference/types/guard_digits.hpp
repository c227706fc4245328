// The wider MPFR type in which constants and exact references are computed before they are rounded once.
#pragma once

#include "reference/types/exchange.hpp"

namespace ulpgate::ode {

// At least 24 decimal digits more than Real: enough for the handful of digits that an elimination or a
// recursion of a few dozen steps loses.  All narrow types share one, so that they share its instantiations.
template <RealType Real>
using Guarded = MpfrReal<(std::numeric_limits<Real>::digits10 <= 38
                              ? 62U
                              : static_cast<unsigned>(std::numeric_limits<Real>::digits10) + 24U)>;

// Exact.
template <RealType Real>
[[nodiscard]] Guarded<Real> guarded(const Real& x) {
  Guarded<Real> wide;
  to_mpfr(wide.backend().data(), x);
  return wide;
}

// Rounded once, to nearest even.
template <RealType Real>
[[nodiscard]] Real rounded(const Guarded<Real>& x) {
  return from_mpfr<Real>(x.backend().data());
}

}  // namespace ulpgate::ode
