// Functions in double-double as references of binary64 and x87 numbers.
#pragma once

#include <cstddef>

#include "reference/functions/bounded_function.hpp"
#include "reference/functions/function_info.hpp"
#include "reference/multi_word/double_double.hpp"

namespace ulpgate {

// Evaluates f at `count` points, as bounded_function does (native_functions.hpp), of a complex function both
// parts, one behind the other: |results[i] - f(args of i)| is at most bounds[i] ulp of 2^-99 of the power of
// two below results[i].  A negative bound says that nothing is known: of arguments and results near the ends
// of the range, and of results next to a zero of a function. Else a NaN says that f is not defined there (of
// arguments of no more than 53 bits: a wider type has numbers beyond double), an infinity that it is beyond
// double, a zero (of these too) that it is 0 where its bound is, and where that is 1 that it is no zero and
// below 2^-1100; either with a bound of 2 lies beyond 2^20000 or below 2^-20000.
using DoubleDoubleFunction = void (*)(const DoubleDouble* args, DoubleDouble* results, double* bounds,
                                      std::size_t count, int argument_bits);

// nullptr where there is none.  The bounds are derived where the functions stand (exponentials.inc and its
// like), for round to nearest; nothing of the C library is called.
[[nodiscard]] DoubleDoubleFunction double_double_function(FunctionId id);

// Complex and special functions, and erfc beyond 24, as numbers of x87 or binary128, bounded_function's way,
// which hold results that double's exponents do not; nullptr where there is none.
template <class W>
[[nodiscard]] BoundedFunction<W> extended_function(FunctionId id);

// Of one instruction set, below instruction_levels(); for tests.
[[nodiscard]] DoubleDoubleFunction double_double_function(FunctionId id, std::size_t level);

}  // namespace ulpgate
