// Functions in triple-double as references of binary128 numbers.
#pragma once

#include <cstddef>

#include "reference/functions/function_info.hpp"
#include "reference/multi_word/triple_double.hpp"

namespace ulpgate {

// Evaluates f at `count` points: |results[i] 2^scales[i] - f(args of i)| is at most bounds[i] ulp of 2^-149
// of the power of two below results[i] 2^scales[i]; scales are whole numbers.  A negative bound says that
// nothing is known: of arguments near the ends of double's range and beyond, and where f is not defined; an
// infinity that f is beyond binary128, a zero that it is far below.
using TripleDoubleFunction = void (*)(const TripleDouble* args, TripleDouble* results, double* scales,
                                      double* bounds, std::size_t count);

// nullptr where there is none.  The bounds are derived where the functions stand (reference/multi_word), for
// round to nearest; nothing of the C library is called.
[[nodiscard]] TripleDoubleFunction triple_double_function(FunctionId id);

// Of points of two numbers each: sine, cosine and tangent of a fraction and a quadrant (large_angles.hpp);
// logarithms of x 2^shift, x of double's exponents and shift a number below 2^31.
[[nodiscard]] TripleDoubleFunction prepared_triple_double_function(FunctionId id);

// Of one instruction set, below instruction_levels(); for tests.
[[nodiscard]] TripleDoubleFunction triple_double_function(FunctionId id, std::size_t level);
[[nodiscard]] TripleDoubleFunction prepared_triple_double_function(FunctionId id, std::size_t level);

}  // namespace ulpgate
