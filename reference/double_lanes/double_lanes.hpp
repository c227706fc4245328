// Functions of binary32 numbers in binary64, two, four or eight at a time.
#pragma once

#include <cstddef>

#include "reference/functions/bounded_function.hpp"
#include "reference/functions/function_info.hpp"

namespace ulpgate {

// The best that this processor can of a function of one argument, at arguments that are binary32 numbers;
// nullptr where there is none.  The bounds are derived where the functions stand (exponentials.inc and its
// like), for round to nearest; nothing of the C library is called.  Beside what BoundedFunction says an
// infinity stands for numbers from 2^900 on, and a zero for those below 2^-900.
[[nodiscard]] BoundedFunction<double> double_lanes_function(FunctionId id);

// Of one instruction set, below instruction_levels(); for tests.
[[nodiscard]] BoundedFunction<double> double_lanes_function(FunctionId id, std::size_t level);

}  // namespace ulpgate
