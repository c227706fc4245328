// Complex and special functions in double-double, for processors with and without fused multiply-add.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
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

// Each part is results[i] 2^scales[i]; arguments have no more than 53 bits.
using ScaledFunction = void (*)(const DoubleDouble* args, DoubleDouble* results, double* scales,
                                double* bounds, std::size_t count);
struct OneFunction {
  DoubleDoubleFunction pairs = nullptr;
  ScaledFunction scaled = nullptr;
};

// The names of what is written below; `row` is given each of them.
#define ULPGATE_EACH_OF_TWO_PARTS(row)                                                                     \
  row(csin) row(csinh) row(ccos) row(ccosh) row(ctan) row(ctanh) row(casin) row(casinh) row(cacos)         \
      row(cacosh) row(catan) row(catanh) row(cexp) row(clog) row(clog10) row(csqrt) row(cpolar) row(cconj) \
          row(cproj)
#define ULPGATE_EACH_OF_ONE_PART(row) row(cabs) row(carg) row(cnorm)

#define ULPGATE_LEVEL_FILE "reference/double_double/complex_instruction_set.inc"
#include "reference/lanes/each_level.inc"

}  // namespace

}  // namespace ulpgate::complex_dd

namespace ulpgate {

namespace {

complex_dd::OneFunction one_function(FunctionId id, [[maybe_unused]] std::size_t level) {
#ifdef ULPGATE_LEVELS
  if (level == 2) return complex_dd::avx512::complex_function_of(id);
  if (level == 1) return complex_dd::avx2::complex_function_of(id);
#endif
  return complex_dd::baseline::complex_function_of(id);
}

}  // namespace

DoubleDoubleFunction complex_double_double_function(FunctionId id, std::size_t level);
DoubleDoubleFunction complex_double_double_function(FunctionId id, std::size_t level) {
  return one_function(id, level).pairs;
}

namespace {

// The rounding to 64 bits is half an ulp, and what is left of 2^-99 times 2^20 much less.
template <FunctionId id>
void extended(const long double* args, long double* results, double* bounds, std::size_t count,
              int argument_bits) {
  static const auto scaled = one_function(id, instruction_levels() - 1).scaled;
  static const auto arity = static_cast<std::size_t>(info_of(id).arity);
  static const auto parts = static_cast<std::size_t>(info_of(id).parts);
  constexpr std::size_t block = 64;
  std::array<DoubleDouble, max_arity * block> pairs;
  std::array<DoubleDouble, max_parts * block> values;
  std::array<double, max_parts * block> scales{};
  for (std::size_t first = 0; first < count; first += block) {
    const std::size_t n = std::min(block, count - first);
    for (std::size_t k = 0; k < n * arity; ++k) pairs[k] = DoubleDouble(args[first * arity + k]);
    double* bound = bounds + first * parts;
    scaled(pairs.data(), values.data(), scales.data(), bound, n);
    for (std::size_t k = 0; k < n * parts; ++k) {
      const auto mantissa = static_cast<long double>(values[k]);
      const bool known = argument_bits <= 53 && bound[k] >= 0 && mantissa != 0 && mantissa - mantissa == 0;
      const long double value = known ? std::ldexp(mantissa, static_cast<int>(scales[k])) : 0;
      results[first * parts + k] = value;
      bound[k] = std::isnormal(value) ? 1 : -1;
    }
  }
}

}  // namespace

BoundedFunction<long double> extended_function(FunctionId id) {
  if (std::numeric_limits<long double>::digits != 64) return nullptr;
  switch (id) {
#define ULPGATE_ROW(name) \
  case FunctionId::name:  \
    return &extended<FunctionId::name>;
    ULPGATE_EACH_OF_TWO_PARTS(ULPGATE_ROW)
    ULPGATE_EACH_OF_ONE_PART(ULPGATE_ROW)
    ULPGATE_ROW(cpow)
    ULPGATE_ROW(cyl_bessel_j)
    ULPGATE_ROW(laguerre)
    ULPGATE_ROW(spherical_harmonic)
#undef ULPGATE_ROW
    default:
      return nullptr;
  }
}

}  // namespace ulpgate
