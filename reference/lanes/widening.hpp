// Floats as doubles.
#pragma once

#include <cstddef>

namespace ulpgate {

// Writes `count` floats as doubles, exactly, by the best instructions that this processor has.
void widen_floats(const float* from, double* to, std::size_t count);

}  // namespace ulpgate
