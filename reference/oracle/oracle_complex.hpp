// Exact values of complex functions by formulas of ours, where MPC's own take seconds a point.
#pragma once

#include <span>

#include "reference/functions/function_info.hpp"
#include "reference/types/mpfr_value.hpp"

namespace ulpgate::oracle {

// Evaluates f at z = args[0] + i args[1], both finite and not zero; false where there is no formula or the
// point is another one.  Products, quotients and sums of positive terms at 32 guard bits, so that no part
// cancels: the error of either part is below 2^-24 ulp of the results' precision before its last rounding.
// MPC rounds correctly, and searches through thousands of bits where the parts differ much in size.
[[nodiscard]] bool complex_value(const FunctionInfo& f, std::span<const MpfrValue> args,
                                 std::span<MpfrValue> out);

}  // namespace ulpgate::oracle
