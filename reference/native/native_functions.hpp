// Native functions as cheap references: the C library's in a wider type, with a bound of their error.
#pragma once

#include "reference/functions/bounded_function.hpp"
#include "reference/functions/function_info.hpp"

namespace ulpgate {

// W is double, long double with 64 bits (x87), or Binary128; nullptr where the type has no function whose
// bound is trusted.
//
// Functions of one argument in double are our own, at arguments of 24 bits (double_lanes.hpp, with derived
// bounds). The others are the C library's.  Where their bounds come from: arithmetic and the square root are
// correctly rounded by IEEE 754 (libquadmath's square root is within 1 ulp), fmod, remainder and logb are
// exact.  Else the largest errors of glibc 2.36 and libquadmath 12 were measured with this harness against
// MPFR, over strata uniform, stratified, binades, edges and hard; a bound is twice the largest error
// (x87_extended) or four times and more (binary64, binary128), where a generous bound costs nothing.  The
// checked share of every run holds them to it. Refused are arguments at which a function is accurate in an
// absolute sense only: lgamma of negative numbers in binary128, and the Bessel functions altogether.
template <class W>
[[nodiscard]] BoundedFunction<W> bounded_function(FunctionId id);

}  // namespace ulpgate
