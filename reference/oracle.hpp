// The MPFR oracle: exact values of every function, correctly rounded at any precision, independent of the
// types.
#pragma once

#include <array>
#include <span>

#include "reference/function_info.hpp"
#include "reference/mpfr_value.hpp"

namespace ulpgate {

// Which parts of a value are known to be exact, not only rounded.  A false entry promises nothing.
using ExactParts = std::array<bool, 2>;

// out[i] = part i of f(args), args taken exactly; the precision of out[i] is that of the result.
//
// Real functions and complex ones are MPFR's and MPC's, correctly rounded (error at most 1/2 ulp of the
// result's precision); special functions are our series, accepted when two working precisions agree to 16
// bits beyond it. Special values follow C99 annex F and G.  Runs in MPFR's widest exponent range.
ExactParts exact_value(const FunctionInfo& f, std::span<const MpfrValue> args, std::span<MpfrValue> out);

}  // namespace ulpgate
