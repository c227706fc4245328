// Whether a result that a cheap reference cannot tell from the exact value is the exact value.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "reference/functions/function_info.hpp"
#include "reference/oracle/oracle.hpp"
#include "reference/oracle/oracle_special.hpp"
#include "reference/types/real_types.hpp"

namespace ulpgate {

namespace detail {

// Residuals of products and quotients do not underflow while the numbers stay above this.
template <NativeReal Real>
[[nodiscard]] bool has_residual(Real x) {
  using L = std::numeric_limits<Real>;
  return std::fabs(x) > std::ldexp(L::min(), 2 * L::digits);
}

template <NativeReal Real>
[[nodiscard]] Exactness exactness_of_sum(Real a, Real b, Real got) {
  if (a + b != got) return Exactness::rounded;
  const Real part = got - a;
  return (a - (got - part)) + (b - part) == 0 ? Exactness::exact : Exactness::rounded;  // Knuth's two-sum
}

[[nodiscard]] inline Exactness rounded_if(bool condition) {
  return condition ? Exactness::rounded : Exactness::unknown;
}

// The exponent of the last bit of x, which is finite and not 0.
template <NativeReal Real>
[[nodiscard]] int last_exponent(Real x) {
  constexpr int digits = std::numeric_limits<Real>::digits;
  int exponent = 0;
  const auto fraction = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::fabs(x), &exponent), digits));
  return exponent - digits + std::countr_zero(fraction);
}

template <NativeReal Real>
[[nodiscard]] Exactness exactness_of_laguerre(Real n, Real x, Real got) {
  if (!(n >= 1 && n < 10000) || x == 0 || got == 0 || !std::isfinite(got)) return Exactness::unknown;
  const int last = last_exponent(x);
  if (last >= 0) return Exactness::unknown;
  return rounded_if(last_exponent(got) != oracle::last_bit_of_laguerre(static_cast<long>(n), last));
}

}  // namespace detail

// The function's value at every algebraic number is transcendental, but at 1, or else at 0.
[[nodiscard]] constexpr bool has_value_at_one(FunctionId id) {
  return id == FunctionId::acos || id == FunctionId::acosh || id == FunctionId::log;
}
[[nodiscard]] constexpr bool is_transcendental(FunctionId id) {
  switch (id) {
    case FunctionId::sin:
    case FunctionId::cos:
    case FunctionId::tan:
    case FunctionId::sinh:
    case FunctionId::cosh:
    case FunctionId::tanh:
    case FunctionId::asin:
    case FunctionId::atan:
    case FunctionId::asinh:
    case FunctionId::atanh:
    case FunctionId::exp:
    case FunctionId::expm1:
    case FunctionId::log1p:
      return true;
    default:
      return has_value_at_one(id);
  }
}

// Complex functions whose parts are transcendental at every z off the axes, and so neither 0 (oracle.cpp).
[[nodiscard]] constexpr bool has_transcendental_parts(FunctionId id) {
  switch (id) {
    case FunctionId::csin:
    case FunctionId::csinh:
    case FunctionId::ccos:
    case FunctionId::ccosh:
    case FunctionId::ctan:
    case FunctionId::ctanh:
    case FunctionId::casin:
    case FunctionId::casinh:
    case FunctionId::cacos:
    case FunctionId::cacosh:
    case FunctionId::catan:
    case FunctionId::catanh:
    case FunctionId::cexp:
    case FunctionId::cpolar:
      return true;
    default:
      return false;
  }
}

// Of `got`, a normal number next to f(a): is it f(a)?  Elementary functions of algebraic numbers are
// transcendental but for the arguments excluded here (Lindemann and Weierstrass; Gelfond and Schneider for
// 2^x and for logarithms to base 2 and 10; Niven, "Irrational Numbers", chapters 9 and 10).
template <NativeReal Real>
[[nodiscard]] Exactness exactness_of(FunctionId id, const Real* a, Real got) {
  using detail::rounded_if;
  const Real x = a[0];
  if (!std::isfinite(x)) return Exactness::unknown;
  if (is_transcendental(id)) return rounded_if(x != (has_value_at_one(id) ? Real(1) : Real(0)));
  if (has_transcendental_parts(id)) return rounded_if(x != 0 && a[1] != 0 && std::isfinite(a[1]));
  switch (id) {
    case FunctionId::atan2:
    case FunctionId::carg:
      // Angles of algebraic numbers are transcendental, but 0.
      return rounded_if(got != 0);
    case FunctionId::hypot:
    case FunctionId::cabs:
      // It is larger than either.
      return rounded_if(x != 0 && a[1] != 0 && (got == std::fabs(x) || got == std::fabs(a[1])));
    case FunctionId::exp2:
    case FunctionId::log10:
      // 10^n, n > 0, is an integer; negative powers are no binary numbers.
      return rounded_if(x != std::trunc(x));
    case FunctionId::log2: {
      int exponent = 0;
      return rounded_if(std::frexp(x, &exponent) != Real(0.5));
    }
    case FunctionId::erf:
      return rounded_if(std::fabs(got) == 1);  // it stays below
    case FunctionId::erfc:
      return rounded_if(got == 2 || (got == 1 && x != 0));  // it falls from 2 to 0
    case FunctionId::add:
      return detail::exactness_of_sum<Real>(a[0], a[1], got);
    case FunctionId::sub:
      return detail::exactness_of_sum<Real>(a[0], -a[1], got);
    case FunctionId::mul:
      if (!detail::has_residual(got)) return Exactness::unknown;
      return std::fma(a[0], a[1], -got) == 0 ? Exactness::exact : Exactness::rounded;
    case FunctionId::div:
      if (!detail::has_residual(a[0])) return Exactness::unknown;
      return std::fma(got, a[1], -a[0]) == 0 ? Exactness::exact : Exactness::rounded;
    case FunctionId::sqrt:
      if (!detail::has_residual(x)) return Exactness::unknown;
      return std::fma(got, got, -x) == 0 ? Exactness::exact : Exactness::rounded;
    case FunctionId::cyl_bessel_j:
      // At algebraic numbers but 0 it is transcendental (C. L. Siegel, "Transcendental Numbers", 1949,
      // chapter II).
      return rounded_if(a[1] != 0 && std::isfinite(a[1]));
    case FunctionId::laguerre:
      return detail::exactness_of_laguerre(a[0], a[2], got);
    default:
      return Exactness::unknown;
  }
}

// Where a univariate function surely takes no value of a binary format: what exactness_of says, as ranges
// that a loop over many samples can test.  Arguments 0 are left out always.
struct InexactResults {
  double arguments_below = 0;  // at every |x| < this but 1
  double result_a = -1;        // next to a result of this size
  double result_b = -1;
  bool never_zero = false;  // a zero at a finite argument is an underflow
};

[[nodiscard]] constexpr bool is_never_zero(FunctionId id) {
  return id == FunctionId::exp || id == FunctionId::exp2 || id == FunctionId::erfc ||
         id == FunctionId::tgamma || has_transcendental_parts(id) || id == FunctionId::cnorm;
}

[[nodiscard]] constexpr InexactResults inexact_results(FunctionId id) {
  InexactResults r{.never_zero = is_never_zero(id)};
  if (is_transcendental(id)) r.arguments_below = std::numeric_limits<double>::infinity();
  if (id == FunctionId::exp2 || id == FunctionId::log10) r.arguments_below = 1;
  if (id == FunctionId::erf || id == FunctionId::erfc) r.result_a = 1;
  if (id == FunctionId::erfc) r.result_b = 2;
  return r;
}

}  // namespace ulpgate
