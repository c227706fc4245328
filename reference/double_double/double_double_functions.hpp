// Functions in double-double as references of binary64 and x87 numbers.
#pragma once

#include <cstddef>

#include "reference/double_double/double_double.hpp"
#include "reference/functions/function_info.hpp"

namespace ulpgate {

// Evaluates f at `count` points, as bounded_function does (native_functions.hpp): |results[i] - f(args of i)|
// is at most bounds[i] ulp of 2^-99 of the power of two below results[i].  A negative bound says that nothing
// is known: of arguments and results near the ends of the range, and of results next to a zero of a function.
// Else a NaN says that f is not defined there (of arguments of no more than 53 bits: a wider type has numbers
// beyond double), an infinity that it is beyond double, a zero (of these too) that it is 0.
using DoubleDoubleFunction = void (*)(const DoubleDouble* args, DoubleDouble* results, double* bounds,
                                      std::size_t count, int argument_bits);

// nullptr where there is none.  The bounds are derived where the functions stand (exponentials.inc and its
// like), for round to nearest; nothing of the C library is called.
[[nodiscard]] DoubleDoubleFunction double_double_function(FunctionId id);

// Whether all of it is had at less than the x87 function: then that has no stage before it.  Measured by
// engine_benchmark with AVX-512, a whole sample with the scan of ordinary ones, x87 first and without: exp
// 102 and 39 ns, log 99 and 63, sin 184 and 65, pow 320 and 111, add 89 and 44, fmod 110 and 48.  Where
// erfc underflows, x87 tells its size, which no double-double has.
[[nodiscard]] constexpr bool is_cheaper_than_x87(FunctionId id) {
  return id != FunctionId::erfc;
}

// Of each instruction set that this processor has, the slowest first; for tests.
[[nodiscard]] std::size_t double_double_levels();
[[nodiscard]] DoubleDoubleFunction double_double_function(FunctionId id, std::size_t level);

}  // namespace ulpgate
