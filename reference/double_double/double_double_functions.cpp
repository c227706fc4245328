// Functions in double-double, for processors with and without fused multiply-add.
#include "reference/double_double/double_double_functions.hpp"

#include <cstdint>
#include <utility>

#include "reference/lanes/levels.hpp"
#include "reference/multi_word/constants.hpp"

#ifdef __clang__
// What is written for numbers and vectors has operands of & that may be bool.
#pragma clang diagnostic ignored "-Wbitwise-instead-of-logical"
#endif

namespace ulpgate::dd {

namespace {

using multi_word::least_log_index;
using multi_word::Terms;

#define ULPGATE_LEVEL_FILE "reference/double_double/instruction_set.inc"
#include "reference/lanes/each_level.inc"

}  // namespace

}  // namespace ulpgate::dd

namespace ulpgate {

// complex_double_double.cpp
DoubleDoubleFunction complex_double_double_function(FunctionId id, std::size_t level);

DoubleDoubleFunction double_double_function(FunctionId id, [[maybe_unused]] std::size_t level) {
  if (info_of(id).function_class != FunctionClass::real) return complex_double_double_function(id, level);
#ifdef ULPGATE_LEVELS
  if (level == 2) return dd::avx512::function_of(id);
  if (level == 1) return dd::avx2::function_of(id);
#endif
  return dd::baseline::function_of(id);
}

DoubleDoubleFunction double_double_function(FunctionId id) {
  static const std::size_t best = instruction_levels() - 1;
  return double_double_function(id, best);
}

}  // namespace ulpgate
