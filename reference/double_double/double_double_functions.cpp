// Functions in double-double, for processors with and without fused multiply-add.
#include "reference/double_double/double_double_functions.hpp"

#include <cstdint>

#include "reference/double_double/constants.hpp"

// Never called: a function of one instruction set must not become another's.
#define ULPGATE_INLINE [[gnu::always_inline]] inline

namespace ulpgate::dd {

namespace {

// Batches of one function of one or two arguments.
#define ULPGATE_UNARY(name)                                                                             \
  void batch_##name(const DoubleDouble* args, DoubleDouble* results, double* bounds, std::size_t count, \
                    int argument_bits) {                                                                \
    const Constants& c = constants();                                                                   \
    for (std::size_t i = 0; i < count; ++i) {                                                           \
      const Bounded b = dd_##name(args[i], c);                                                          \
      results[i] = b.value;                                                                             \
      bounds[i] = argument_bits > 53 && !is_nonzero(b.value) ? -1 : b.bound;                            \
    }                                                                                                   \
  }
#define ULPGATE_BINARY(name)                                                                            \
  void batch_##name(const DoubleDouble* args, DoubleDouble* results, double* bounds, std::size_t count, \
                    int argument_bits) {                                                                \
    const Constants& c = constants();                                                                   \
    for (std::size_t i = 0; i < count; ++i) {                                                           \
      const Bounded b = dd_##name(args[2 * i], args[2 * i + 1], c);                                     \
      results[i] = b.value;                                                                             \
      bounds[i] = argument_bits > 53 && !is_nonzero(b.value) ? -1 : b.bound;                            \
    }                                                                                                   \
  }

namespace baseline {
// Dekker's product by Veltkamp's splitting: exact for products below 2^996.
ULPGATE_INLINE DoubleDouble two_product(double a, double b) {
  constexpr double factor = 0x1p27 + 1;
  const double a_shifted = factor * a;
  const double a_high = a_shifted - (a_shifted - a);
  const double a_low = a - a_high;
  const double b_shifted = factor * b;
  const double b_high = b_shifted - (b_shifted - b);
  const double b_low = b - b_high;
  const double p = a * b;
  return {p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low};
}
// Each rests on those before it.
// clang-format off
#include "reference/double_double/arithmetic.inc"
#include "reference/double_double/bounded.inc"
#include "reference/double_double/exponentials.inc"
#include "reference/double_double/logarithms.inc"
#include "reference/double_double/angles.inc"
#include "reference/double_double/inverse_angles.inc"
#include "reference/double_double/gamma.inc"
#include "reference/double_double/error_functions.inc"
#include "reference/double_double/batches.inc"
// clang-format on
}  // namespace baseline

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define ULPGATE_DOUBLE_DOUBLE_LEVELS
#pragma GCC push_options
#pragma GCC target("arch=x86-64-v3")
namespace fma {
ULPGATE_INLINE DoubleDouble two_product(double a, double b) {
  const double p = a * b;
  return {p, __builtin_fma(a, b, -p)};
}
// Each rests on those before it.
// clang-format off
#include "reference/double_double/arithmetic.inc"
#include "reference/double_double/bounded.inc"
#include "reference/double_double/exponentials.inc"
#include "reference/double_double/logarithms.inc"
#include "reference/double_double/angles.inc"
#include "reference/double_double/inverse_angles.inc"
#include "reference/double_double/gamma.inc"
#include "reference/double_double/error_functions.inc"
#include "reference/double_double/batches.inc"
// clang-format on
}  // namespace fma
#pragma GCC pop_options
#endif

}  // namespace

}  // namespace ulpgate::dd

namespace ulpgate {

std::size_t double_double_levels() {
#ifdef ULPGATE_DOUBLE_DOUBLE_LEVELS
  if (__builtin_cpu_supports("x86-64-v3") != 0) return 2;
#endif
  return 1;
}

DoubleDoubleFunction double_double_function(FunctionId id, [[maybe_unused]] std::size_t level) {
#ifdef ULPGATE_DOUBLE_DOUBLE_LEVELS
  if (level == 1) return dd::fma::function_of(id);
#endif
  return dd::baseline::function_of(id);
}

DoubleDoubleFunction double_double_function(FunctionId id) {
  static const std::size_t best = double_double_levels() - 1;
  return double_double_function(id, best);
}

}  // namespace ulpgate
