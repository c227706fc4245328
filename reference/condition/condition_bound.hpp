// Lower bounds of condition numbers from derivatives in closed form, in long double: cheap enough for every
// sample.
#pragma once

#include "reference/functions/function_info.hpp"

namespace ulpgate {

// A number that the componentwise relative condition number of part `part` of f
// (reference/condition/condition.hpp) at `args` does not fall below; 0 where none is known.  `value` is that
// part's exact value, to 2^-20 at least; args are the exact arguments rounded.  Errors of the C library's
// long double functions are covered by a margin of 2^-12, and by 2^-30 of the whole derivative where a part
// of it may cancel.  Numbers beyond 2^+-5000 give 0, so that no intermediate overflow can pass for a bound;
// not those of sin, cos and tan, whose bound ends at 1e300.
[[nodiscard]] double condition_lower_bound(const FunctionInfo& f, const long double* args, long double value,
                                           int part);

}  // namespace ulpgate
