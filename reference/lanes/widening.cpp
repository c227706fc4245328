// Floats as doubles, for several instruction sets.
#include "reference/lanes/widening.hpp"

#include "reference/lanes/levels.hpp"

namespace ulpgate {

namespace {

#define ULPGATE_LEVEL_FILE "reference/lanes/widening.inc"
#include "reference/lanes/each_level.inc"

using Widening = void (*)(const float*, double*, std::size_t);

Widening best_widening() {
#ifdef ULPGATE_LEVELS
  const std::size_t levels = instruction_levels();
  if (levels > 2) return avx512::widen_floats;
  if (levels > 1) return avx2::widen_floats;
#endif
  return baseline::widen_floats;
}

}  // namespace

void widen_floats(const float* from, double* to, std::size_t count) {
  static const Widening best = best_widening();
  best(from, to, count);
}

}  // namespace ulpgate
