// ScreenStages: the cheap references that a function has.
#pragma once

#include <limits>

#include "harness/core/judging/judging.hpp"
#include "reference/double_double/double_double_functions.hpp"
#include "reference/native/native_functions.hpp"
#include "reference/triple_double/triple_double_functions.hpp"

namespace ulpgate {

// The stages before the full reference; tests plant wrong ones.
struct ScreenStages {
  BoundedFunction<double> binary64 = nullptr;
  BoundedFunction<long double> x87_extended = nullptr;
  BoundedFunction<DoubleDouble> double_double = nullptr;
#ifdef ULPGATE_HAVE_FLOAT128
  BoundedFunction<Binary128> binary128 = nullptr;
#endif
  TripleDoubleFunction triple_double = nullptr;
  ExactFunction mpfr = exact_value;
};

// The stages of f: functions of native types where they have trusted bounds.
[[nodiscard]] inline ScreenStages screen_stages(const FunctionInfo& f) {
  ScreenStages stages;
  stages.double_double = double_double_function(f.id);
  if (f.function_class != FunctionClass::real) {
    if constexpr (std::numeric_limits<long double>::digits == 64)
      stages.x87_extended = extended_function<long double>(f.id);
#ifdef ULPGATE_HAVE_FLOAT128
    stages.binary128 = extended_function<Binary128>(f.id);
#endif
    return stages;
  }
  stages.binary64 = bounded_function<double>(f.id);
  if constexpr (std::numeric_limits<long double>::digits == 64)
    stages.x87_extended = bounded_function<long double>(f.id);
#ifdef ULPGATE_HAVE_FLOAT128
  stages.binary128 = bounded_function<Binary128>(f.id);
#endif
  stages.triple_double = triple_double_function(f.id);
  return stages;
}

}  // namespace ulpgate
