// Functions in double-double, for processors with and without fused multiply-add.
#include "reference/double_double/double_double_functions.hpp"

#include <cstdint>
#include <utility>

#include "reference/double_double/constants.hpp"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define ULPGATE_DOUBLE_DOUBLE_LEVELS
#include <immintrin.h>
#endif

// Never called: a function of one instruction set must not become another's.
#define ULPGATE_INLINE [[gnu::always_inline]] inline

#ifdef __clang__
// What is written for numbers and vectors has operands of & that may be bool.
#pragma clang diagnostic ignored "-Wbitwise-instead-of-logical"
#endif

namespace ulpgate::dd {

namespace {

namespace baseline {
constexpr std::size_t width = 2;
using Vector = double __attribute__((vector_size(width * sizeof(double))));
// Of a product a b, its rounding error: Dekker's product by Veltkamp's splitting, exact below 2^996.
template <class Number>
ULPGATE_INLINE Number rounding_of(Number a, Number b, Number p) {
  constexpr double factor = 0x1p27 + 1;
  const Number a_shifted = factor * a;
  const Number a_high = a_shifted - (a_shifted - a);
  const Number a_low = a - a_high;
  const Number b_shifted = factor * b;
  const Number b_high = b_shifted - (b_shifted - b);
  const Number b_low = b - b_high;
  return ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low;
}
ULPGATE_INLINE Vector root_of(Vector x) {
  for (std::size_t j = 0; j < width; ++j) x[j] = __builtin_sqrt(x[j]);
  return x;
}
#include "reference/double_double/instruction_set.inc"
}  // namespace baseline

#ifdef ULPGATE_DOUBLE_DOUBLE_LEVELS
#pragma GCC push_options
#pragma GCC target("arch=x86-64-v3")
namespace avx2 {
constexpr std::size_t width = 4;
using Vector = double __attribute__((vector_size(width * sizeof(double))));
ULPGATE_INLINE double rounding_of(double a, double b, double p) {
  return __builtin_fma(a, b, -p);
}
ULPGATE_INLINE Vector rounding_of(Vector a, Vector b, Vector p) {
  return _mm256_fmadd_pd(a, b, -p);
}
ULPGATE_INLINE Vector root_of(Vector x) {
  return _mm256_sqrt_pd(x);
}
#include "reference/double_double/instruction_set.inc"
}  // namespace avx2
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("arch=x86-64-v4")
namespace avx512 {
constexpr std::size_t width = 8;
using Vector = double __attribute__((vector_size(width * sizeof(double))));
ULPGATE_INLINE double rounding_of(double a, double b, double p) {
  return __builtin_fma(a, b, -p);
}
ULPGATE_INLINE Vector rounding_of(Vector a, Vector b, Vector p) {
  return _mm512_fmadd_pd(a, b, -p);
}
ULPGATE_INLINE Vector root_of(Vector x) {
  return _mm512_maskz_sqrt_pd(0xff, x);
}
#include "reference/double_double/instruction_set.inc"
}  // namespace avx512
#pragma GCC pop_options
#endif

}  // namespace

}  // namespace ulpgate::dd

namespace ulpgate {

std::size_t double_double_levels() {
#ifdef ULPGATE_DOUBLE_DOUBLE_LEVELS
  if (__builtin_cpu_supports("x86-64-v4") != 0) return 3;
  if (__builtin_cpu_supports("x86-64-v3") != 0) return 2;
#endif
  return 1;
}

DoubleDoubleFunction double_double_function(FunctionId id, [[maybe_unused]] std::size_t level) {
#ifdef ULPGATE_DOUBLE_DOUBLE_LEVELS
  if (level == 2) return dd::avx512::function_of(id);
  if (level == 1) return dd::avx2::function_of(id);
#endif
  return dd::baseline::function_of(id);
}

DoubleDoubleFunction double_double_function(FunctionId id) {
  static const std::size_t best = double_double_levels() - 1;
  return double_double_function(id, best);
}

}  // namespace ulpgate
