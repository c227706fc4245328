// The C library's functions of several binary64 numbers at once, where the machine has them.
#pragma once

#include <cstddef>

#include "reference/functions/function_info.hpp"

namespace ulpgate {

// Evaluates a function of one argument at `count` points.
using VectorFunction = void (*)(const double* args, double* results, std::size_t count);

// glibc's libmvec (AVX-512 or AVX2), within 4 ulp by its documentation; nullptr where library, processor or
// function is missing.  `most_lanes` 4 takes AVX2 where the processor has more.
[[nodiscard]] VectorFunction vector_function(FunctionId id, int most_lanes = 8);

}  // namespace ulpgate
