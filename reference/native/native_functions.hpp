// Native functions as cheap references: the C library's in a wider type, with a bound of their error.
#pragma once

#include <cstddef>

#include "reference/functions/function_info.hpp"

namespace ulpgate {

#ifdef ULPGATE_HAVE_FLOAT128
using Binary128 = __float128;
#endif

// Evaluates f at `count` points: args holds count * arity values.  |results[i] - f(args of i)| is at most
// bounds[i] ulp of results[i] in W, wherever results[i] is a normal number of W; a negative bound says that
// nothing is known.  Otherwise a NaN says that f is not defined there, an infinity that it has a pole or
// exceeds W, a zero that f is zero or less than W's least normal number.  `argument_bits`: the arguments have
// no more significant bits than that, which makes some operations exact.
template <class W>
using BoundedFunction = void (*)(const W* args, W* results, double* bounds, std::size_t count,
                                 int argument_bits);

// W is double, long double with 64 bits (x87), or Binary128; nullptr where the type has no function whose
// bound is trusted.
//
// Where the bounds come from: arithmetic and the square root are correctly rounded by IEEE 754 (libquadmath's
// square root is within 1 ulp), fmod, remainder and logb are exact.  For the others the largest errors of
// glibc 2.36 and libquadmath 12 were measured with this harness against MPFR, over strata uniform,
// stratified, binades, edges and hard; a bound is twice the largest error (x87_extended) or four times and
// more (binary64, binary128), where a generous bound costs nothing.  The checked share of every run holds
// them to it.
// binary64 functions of one argument are libmvec's where the machine has it (vector_functions.hpp), with at
// least twice the 4 ulp that it documents.
// Refused are arguments at which a function is accurate in an absolute sense only: lgamma of
// negative numbers in binary128, and the Bessel functions altogether.  sin, cos and tan of double beyond 2^20
// get a bound of 2^19 ulp where the result is below 2^-20 (or the tangent above 2^20): next to multiples of
// pi/2 the argument reduction of glibc 2.36 is off by 1.4e5 ulp, an absolute error that is nothing elsewhere.
// Binary32 arguments from 2^22 on have a reduction of their own where libmvec serves (large_angles.hpp);
// tgamma and lgamma have short series far out and next to 0.
template <class W>
[[nodiscard]] BoundedFunction<W> bounded_function(FunctionId id);

}  // namespace ulpgate
