// The MPFR oracle: exact values of every function, correctly rounded at any precision, independent of the
// types.
#pragma once

#include <array>
#include <span>

#include "reference/functions/function_info.hpp"
#include "reference/types/mpfr_value.hpp"

namespace ulpgate {

// What is known of a part: that it is the exact value, or that the exact value is another one, at times on
// which side: a part that was rounded up is larger than the exact value.
enum class Exactness { unknown, exact, rounded, rounded_up, rounded_down };
[[nodiscard]] constexpr bool is_rounded(Exactness e) {
  return e == Exactness::rounded || e == Exactness::rounded_up || e == Exactness::rounded_down;
}
using ExactParts = std::array<Exactness, 2>;

// out[i] = part i of f(args), args taken exactly; the precision of out[i] is that of the result.
//
// Real functions are MPFR's, correctly rounded (error at most 1/2 ulp of the result's precision); complex
// ones are MPC's or our formulas with 32 guard bits (oracle_complex.hpp), within 1/2 + 2^-24 ulp; special
// functions are our series with bounds of what their roundings lose, within 1/2 + 2^-16 ulp.  Special values
// follow C99 annex F and G.  Runs in MPFR's widest exponent range.
ExactParts exact_value(const FunctionInfo& f, std::span<const MpfrValue> args, std::span<MpfrValue> out);

}  // namespace ulpgate
