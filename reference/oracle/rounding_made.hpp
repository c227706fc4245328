// What is known of roundings of exact values, and which way a value was found.
#pragma once

#include "reference/oracle/oracle.hpp"

namespace ulpgate::oracle {

// A formula of ours answers only where its error bound decides the rounding; MPFR answers everywhere.  Tests
// ask who did: an oracle that always fell back would be right, and slow.
enum class Method { formula, mpfr };

struct RoundingMade {
  int ternary = 0;  // as MPFR's: its sign tells the direction of the rounding, 0 that there was none
  Method method = Method::mpfr;
};

// What our compositions say of their parts.
inline constexpr ExactParts not_known = {Exactness::unknown, Exactness::unknown};

// MPFR's ternary value is zero exactly where nothing was rounded, and has the sign of the rounding.
[[nodiscard]] inline Exactness exactness(int ternary) {
  if (ternary == 0) return Exactness::exact;
  return ternary > 0 ? Exactness::rounded_up : Exactness::rounded_down;
}
// MPC's, of both parts.
[[nodiscard]] inline ExactParts complex_parts(int ternary) {
  return {exactness(MPC_INEX_RE(ternary)), exactness(MPC_INEX_IM(ternary))};
}

[[nodiscard]] inline bool is_finite(mpc_srcptr z) {
  return mpfr_number_p(mpc_realref(z)) != 0 && mpfr_number_p(mpc_imagref(z)) != 0;
}

}  // namespace ulpgate::oracle
