// Functions in triple-double.
#include "reference/triple_double/triple_double_functions.hpp"

#include <cstdint>
#include <utility>

#include "reference/lanes/levels.hpp"
#include "reference/multi_word/constants.hpp"

#ifdef __clang__
// What is written for numbers and vectors has operands of & that may be bool.
#pragma clang diagnostic ignored "-Wbitwise-instead-of-logical"
#endif

namespace ulpgate::td {

namespace {

using multi_word::least_log_index;
using multi_word::Terms;

#define ULPGATE_LEVEL_FILE "reference/triple_double/instruction_set.inc"
#include "reference/lanes/each_level.inc"

}  // namespace

}  // namespace ulpgate::td

namespace ulpgate {

// The one of a level.
#ifdef ULPGATE_LEVELS
#define ULPGATE_AT(function, id, level)      \
  ((level) == 2   ? td::avx512::function(id) \
   : (level) == 1 ? td::avx2::function(id)   \
                  : td::baseline::function(id))
#else
#define ULPGATE_AT(function, id, level) td::baseline::function(id)
#endif

TripleDoubleFunction triple_double_function(FunctionId id, [[maybe_unused]] std::size_t level) {
  return ULPGATE_AT(function_of, id, level);
}
TripleDoubleFunction prepared_triple_double_function(FunctionId id, [[maybe_unused]] std::size_t level) {
  return ULPGATE_AT(prepared_function_of, id, level);
}

TripleDoubleFunction triple_double_function(FunctionId id) {
  return triple_double_function(id, instruction_levels() - 1);
}
TripleDoubleFunction prepared_triple_double_function(FunctionId id) {
  return prepared_triple_double_function(id, instruction_levels() - 1);
}

}  // namespace ulpgate
