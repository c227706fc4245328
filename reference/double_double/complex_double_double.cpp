// Complex and special functions in double-double, for processors with and without fused multiply-add.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
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

// What many functions have in common and takes hundreds of operations: a call is nothing beside it, and its
// code in each of them was half of what this file took to compile.
#define ULPGATE_APART [[gnu::noinline]] inline

namespace ulpgate::complex_dd {

namespace {

using multi_word::least_log_index;
using multi_word::Terms;

// Beyond these exponents, of 2, a part is told as a zero or an infinity with a bound of 1, or of 2
// (complex_parts.inc).
constexpr double far_exponent = 2300;
constexpr double farthest_exponent = 25000;

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

// Each part is results[i] 2^scales[i].
using ScaledFunction = void (*)(const DoubleDouble* args, DoubleDouble* results, double* scales,
                                double* bounds, std::size_t count, int argument_bits);
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

// 2^e, |e| < 16000.
[[maybe_unused]] long double power_of_two(long double /*like*/, int e) {
  return std::ldexp(1.0L, e);
}
template <class W>
struct Format;
template <>
struct Format<long double> {
  static constexpr int bits = std::numeric_limits<long double>::digits;
};
#ifdef ULPGATE_HAVE_FLOAT128
[[maybe_unused]] Binary128 power_of_two(Binary128 /*like*/, int e) {
  return std::bit_cast<Binary128>(static_cast<unsigned __int128>(e + 16383) << 112U);
}
template <>
struct Format<Binary128> {
  static constexpr int bits = 113;
};
#endif

template <class W>
[[maybe_unused]] int exponent_of(W x) {
#ifdef ULPGATE_HAVE_FLOAT128
  if constexpr (std::same_as<W, Binary128>)
    return static_cast<int>(std::bit_cast<unsigned __int128>(x) >> 112U & 0x7fffU) - 16383;
#endif
  return std::ilogb(static_cast<long double>(x));
}
// Multiplies what is beyond double's exponents, and no infinity, by a power of two that it gives the exponent
// of: it is then below 2^-700, or below 2^900.
template <class W>
[[maybe_unused]] int lift(W& x) {
  if (x == 0 || !((x < 0 ? -x : x) < W(0x1p-900))) return 0;
  const int k = -700 - exponent_of(x);
  x *= power_of_two(W(), k);
  return k;
}
template <class W>
[[maybe_unused]] int lower(W& x) {
  if (x - x != 0 || (x < 0 ? -x : x) <= W(0x1p900)) return 0;
  const int k = 800 - exponent_of(x);
  x *= power_of_two(W(), k);
  return k;
}
// Has special functions evaluated at numbers that are nearer to 1, where they follow powers of tiny or huge
// ones: the parts' scales times 2^shift.  J_n(x) is (x/2)^n / n!, a spherical harmonic has the factors
// theta^|m| and, in its imaginary part, phi, each but for 2^-1300 of it; a Laguerre polynomial is its last
// term but for 2^-600, or its value at 0 but for 2^-600.
template <FunctionId id, class W>
void bring_near([[maybe_unused]] W* a, [[maybe_unused]] double* shift) {
  if constexpr (id == FunctionId::cyl_bessel_j) shift[0] = -lift(a[1]) * static_cast<double>(a[0]);
  if constexpr (id == FunctionId::laguerre) {
    lift(a[2]);
    shift[0] = -lower(a[2]) * static_cast<double>(a[0]);
  }
  if constexpr (id == FunctionId::spherical_harmonic) {
    shift[0] = -lift(a[2]) * std::fabs(static_cast<double>(a[1]));
    shift[1] = shift[0] - lift(a[3]);
  }
}

// Half an ulp of W for what is rounded to it, and the pair's own, relatively 2^-99 each.
template <class W, FunctionId id>
void extended(const W* args, W* results, double* bounds, std::size_t count, int argument_bits) {
  static const auto scaled = one_function(id, instruction_levels() - 1).scaled;
  static const auto arity = static_cast<std::size_t>(info_of(id).arity);
  static const auto parts = static_cast<std::size_t>(info_of(id).parts);
  constexpr double least = -16300;
  // Its zeros do not come from arguments that a pair has no number for.
  constexpr bool keeps_zeros = id == FunctionId::spherical_harmonic;
  constexpr double ulps = Format<W>::bits > double_double_bits ? 0x1p14 : 0x1p-34;
  constexpr std::size_t block = 64;
  std::array<DoubleDouble, max_arity * block> pairs;
  std::array<DoubleDouble, max_parts * block> values;
  std::array<double, max_parts * block> scales{};
  for (std::size_t first = 0; first < count; first += block) {
    const std::size_t n = std::min(block, count - first);
    std::array<double, max_parts * block> shifts{};
    for (std::size_t i = 0; i < n; ++i) {
      std::array<W, max_arity> point{};
      std::copy_n(args + (first + i) * arity, arity, point.begin());
      bring_near<id>(point.data(), &shifts[i * parts]);
      for (std::size_t k = 0; k < arity; ++k) {
        const W x = point[k];
        const auto high = static_cast<double>(x);
        pairs[i * arity + k] = {high, high - high == 0 ? static_cast<double>(x - static_cast<W>(high)) : 0};
      }
    }
    double* bound = bounds + first * parts;
    scaled(pairs.data(), values.data(), scales.data(), bound, n, argument_bits);
    for (std::size_t k = 0; k < n * parts; ++k) {
      const DoubleDouble value = values[k];
      scales[k] += shifts[k];
      const bool finite = value.hi != 0 && value.hi - value.hi == 0;
      const double exponent = finite ? scales[k] + std::ilogb(value.hi) : 0;
      // What double has no number for, and what W has none for, is told as by a pair.
      const bool told =
          bound[k] >= 0 && (finite ? std::fabs(exponent) > complex_dd::farthest_exponent : bound[k] == 2);
      if (told || (keeps_zeros && bound[k] == 0 && value.hi == 0)) {
        const bool small = finite ? exponent < 0 : value.hi == 0;
        const double size = small ? 0 : std::numeric_limits<double>::infinity();
        results[first * parts + k] = static_cast<W>(std::copysign(size, value.hi));
        bound[k] = told ? 2 : 0;
        continue;
      }
      const bool known =
          finite && bound[k] >= 0 && std::fabs(exponent) < -least && std::fabs(scales[k]) < -least;
      results[first * parts + k] = known ? (static_cast<W>(value.hi) + static_cast<W>(value.lo)) *
                                               power_of_two(W(), static_cast<int>(scales[k]))
                                         : W(0);
      bound[k] = known ? 1 + bound[k] * ulps : -1;
    }
  }
}

}  // namespace

template <class W>
BoundedFunction<W> extended_function(FunctionId id) {
  switch (id) {
#define ULPGATE_ROW(name) \
  case FunctionId::name:  \
    return &extended<W, FunctionId::name>;
    ULPGATE_EACH_OF_TWO_PARTS(ULPGATE_ROW)
    ULPGATE_EACH_OF_ONE_PART(ULPGATE_ROW)
    ULPGATE_ROW(cpow)
    ULPGATE_ROW(erfc)
    ULPGATE_ROW(cyl_bessel_j)
    ULPGATE_ROW(laguerre)
    ULPGATE_ROW(spherical_harmonic)
#undef ULPGATE_ROW
    default:
      return nullptr;
  }
}

template BoundedFunction<long double> extended_function<long double>(FunctionId id);
#ifdef ULPGATE_HAVE_FLOAT128
template BoundedFunction<Binary128> extended_function<Binary128>(FunctionId id);
#endif

}  // namespace ulpgate
