// Complex and special functions in double-double, for processors with and without fused multiply-add.
#include <array>
#include <cstdint>
#include <utility>

#include "reference/double_double/double_double_functions.hpp"
#include "reference/lanes/levels.hpp"
#include "reference/multi_word/constants.hpp"
#include "reference/types/mpfr_value.hpp"

#ifdef __clang__
// What is written for numbers and vectors has operands of & that may be bool.
#pragma clang diagnostic ignored "-Wbitwise-instead-of-logical"
#pragma clang diagnostic ignored "-Wunused-function"
#endif

namespace ulpgate::complex_dd {

namespace {

using multi_word::least_log_index;
using multi_word::Terms;

// k! = mantissa[k] 2^exponent[k], the mantissa in [1, 2) and within bound[k] ulp.
struct Factorials {
  static constexpr std::size_t count = 2001;
  std::array<DoubleDouble, count> mantissa;
  std::array<double, count> exponent;
  std::array<double, count> bound;
};

const Factorials& factorials() {
  static const Factorials all = [] {
    Factorials f;
    // Each product is within 2^-300 of itself.
    MpfrValue value(300);
    MpfrValue rest(300);
    mpfr_set_ui(value, 1, MPFR_RNDN);
    double scale = 0;
    bool exact = true;
    for (std::size_t k = 0; k < Factorials::count; ++k) {
      if (k > 0) exact = mpfr_mul_ui(value, value, k, MPFR_RNDN) == 0 && exact;
      scale += static_cast<double>(mpfr_get_exp(value.get()) - 1);
      mpfr_set_exp(value, 1);
      const double hi = mpfr_get_d(value, MPFR_RNDN);
      mpfr_sub_d(rest, value, hi, MPFR_RNDN);
      const double lo = mpfr_get_d(rest, MPFR_RNDN);
      f.mantissa[k] = {hi, lo};
      f.exponent[k] = scale;
      f.bound[k] = exact && mpfr_cmp_d(rest, lo) == 0 ? 0 : 1;
    }
    return f;
  }();
  return all;
}

#define ULPGATE_LEVEL_FILE "reference/double_double/complex_instruction_set.inc"
#include "reference/lanes/each_level.inc"

}  // namespace

}  // namespace ulpgate::complex_dd

namespace ulpgate {

DoubleDoubleFunction complex_double_double_function(FunctionId id, std::size_t level);
DoubleDoubleFunction complex_double_double_function(FunctionId id, [[maybe_unused]] std::size_t level) {
#ifdef ULPGATE_LEVELS
  if (level == 2) return complex_dd::avx512::complex_function_of(id);
  if (level == 1) return complex_dd::avx2::complex_function_of(id);
#endif
  return complex_dd::baseline::complex_function_of(id);
}

}  // namespace ulpgate
