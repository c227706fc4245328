// ulpgate::Wide: a number of some hundred bits in which kernels are evaluated for their reference.
//
// An opaque handle: a file that uses it compiles as fast as one with doubles, and with any options; its
// arithmetic is that of the library, whatever -ffast-math allows here.  Kernels must name no number type:
// `using std::sqrt; sqrt(x)`, Real(0.5), Real y = x.
#pragma once

#include <type_traits>
#include <utility>

#include "ulpgate/ulpgate.h"

namespace ulpgate {

class Wide {
 public:
  Wide() : x_(ulpgate_wide_new()) {}
  Wide(const Wide& other) : Wide() { ulpgate_wide_assign(x_, other.x_); }
  Wide(Wide&& other) noexcept : x_(std::exchange(other.x_, nullptr)) {}
  // Exact: numbers of the built-in types are numbers of this one.
  template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
  Wide(Number value) : Wide() {  // NOLINT(google-explicit-constructor)
    // A long double holds every integer of 64 bits.
    if constexpr (std::is_same_v<Number, float> || std::is_same_v<Number, double>) {
      ulpgate_wide_assign_double(x_, value);
    } else {
      ulpgate_wide_assign_long_double(x_, static_cast<long double>(value));
    }
  }
  ~Wide() {
    if (x_ != nullptr) ulpgate_wide_free(x_);
  }
  Wide& operator=(const Wide& other) {
    ulpgate_wide_assign(x_, other.x_);
    return *this;
  }
  Wide& operator=(Wide&& other) noexcept {
    std::swap(x_, other.x_);
    return *this;
  }

  // double y = x; would lose what this type is for, and hide it.
  template <class Number, std::enable_if_t<std::is_floating_point_v<Number>, int> = 0>
  operator Number() const {  // NOLINT(google-explicit-constructor)
    static_assert(!std::is_floating_point_v<Number>,
                  "ulpgate: this kernel turns a Real into a built-in type, so that its reference would be no "
                  "better than itself. "
                  "Write Real instead of double or auto y = double(x); for an index, int(to_double(x)).");
    return {};
  }

#define ULPGATE_ARITHMETIC(SIGN, OPERATION)                                                             \
  friend Wide operator SIGN(const Wide& a, const Wide& b) {                                             \
    return apply(OPERATION, a, &b);                                                                     \
  }                                                                                                     \
  /* Better matches than the built-in operators, which would take the conversion that is no way out. */ \
  template <class N, std::enable_if_t<std::is_arithmetic_v<N>, int> = 0>                                \
  friend Wide operator SIGN(const Wide& a, N b) {                                                       \
    return a SIGN Wide(b);                                                                              \
  }                                                                                                     \
  template <class N, std::enable_if_t<std::is_arithmetic_v<N>, int> = 0>                                \
  friend Wide operator SIGN(N a, const Wide& b) {                                                       \
    return Wide(a) SIGN b;                                                                              \
  }
  ULPGATE_ARITHMETIC(+, ULPGATE_ADD)
  ULPGATE_ARITHMETIC(-, ULPGATE_SUB)
  ULPGATE_ARITHMETIC(*, ULPGATE_MUL)
  ULPGATE_ARITHMETIC(/, ULPGATE_DIV)
#undef ULPGATE_ARITHMETIC
  Wide operator-() const {
    return apply(ULPGATE_NEG, *this, nullptr);
  }
  Wide operator+() const {
    return *this;
  }
  Wide& operator+=(const Wide& b) {
    return *this = *this + b;
  }
  Wide& operator-=(const Wide& b) {
    return *this = *this - b;
  }
  Wide& operator*=(const Wide& b) {
    return *this = *this * b;
  }
  Wide& operator/=(const Wide& b) {
    return *this = *this / b;
  }

#define ULPGATE_COMPARISON(SIGN, CONDITION)                              \
  friend bool operator SIGN(const Wide& a, const Wide& b) {              \
    const int order = ulpgate_wide_compare(a.x_, b.x_);                  \
    return CONDITION;                                                    \
  }                                                                      \
  template <class N, std::enable_if_t<std::is_arithmetic_v<N>, int> = 0> \
  friend bool operator SIGN(const Wide& a, N b) {                        \
    return a SIGN Wide(b);                                               \
  }                                                                      \
  template <class N, std::enable_if_t<std::is_arithmetic_v<N>, int> = 0> \
  friend bool operator SIGN(N a, const Wide& b) {                        \
    return Wide(a) SIGN b;                                               \
  }
  ULPGATE_COMPARISON(==, order == 0)
  ULPGATE_COMPARISON(!=, order != 0)
  ULPGATE_COMPARISON(<, order == -1)
  ULPGATE_COMPARISON(>, order == 1)
  ULPGATE_COMPARISON(<=, order == -1 || order == 0)
  ULPGATE_COMPARISON(>=, order == 1 || order == 0)
#undef ULPGATE_COMPARISON

  friend Wide fma(const Wide& a, const Wide& b, const Wide& c) {
    Wide r;
    ulpgate_wide_fma(r.x_, a.x_, b.x_, c.x_);
    return r;
  }
  friend Wide ldexp(const Wide& x, int n) {
    Wide r;
    ulpgate_wide_ldexp(r.x_, x.x_, n);
    return r;
  }
  friend bool isnan(const Wide& x) {
    return ulpgate_wide_kind(x.x_) == 2;
  }
  friend bool isinf(const Wide& x) {
    return ulpgate_wide_kind(x.x_) == 1;
  }
  friend bool isfinite(const Wide& x) {
    return ulpgate_wide_kind(x.x_) == 0;
  }
  friend bool signbit(const Wide& x) {
    return ulpgate_wide_sign_bit(x.x_) != 0;
  }
  // For branches and indices; what is computed with it afterwards is a double.
  friend double to_double(const Wide& x) {
    return ulpgate_wide_to_double(x.x_);
  }

  static Wide apply(ulpgate_operation operation, const Wide& a, const Wide* b) {
    Wide r;
    ulpgate_wide_apply(operation, r.x_, a.x_, b == nullptr ? nullptr : b->x_);
    return r;
  }
  [[nodiscard]] const ulpgate_wide* handle() const {
    return x_;
  }
  [[nodiscard]] ulpgate_wide* handle() {
    return x_;
  }

 private:
  ulpgate_wide* x_;
};

// So that a kernel may say to_double() of any Real.
template <class Number, std::enable_if_t<std::is_floating_point_v<Number>, int> = 0>
double to_double(Number x) {
  return static_cast<double>(x);
}

#define ULPGATE_WIDE_1(NAME, OPERATION)        \
  inline Wide NAME(const Wide& x) {            \
    return Wide::apply(OPERATION, x, nullptr); \
  }
#define ULPGATE_WIDE_2(NAME, OPERATION)                                  \
  inline Wide NAME(const Wide& a, const Wide& b) {                       \
    return Wide::apply(OPERATION, a, &b);                                \
  }                                                                      \
  template <class N, std::enable_if_t<std::is_arithmetic_v<N>, int> = 0> \
  Wide NAME(const Wide& a, N b) {                                        \
    return NAME(a, Wide(b));                                             \
  }                                                                      \
  template <class N, std::enable_if_t<std::is_arithmetic_v<N>, int> = 0> \
  Wide NAME(N a, const Wide& b) {                                        \
    return NAME(Wide(a), b);                                             \
  }
ULPGATE_WIDE_1(fabs, ULPGATE_FABS)
ULPGATE_WIDE_1(abs, ULPGATE_FABS)
ULPGATE_WIDE_1(sqrt, ULPGATE_SQRT)
ULPGATE_WIDE_1(cbrt, ULPGATE_CBRT)
ULPGATE_WIDE_1(exp, ULPGATE_EXP)
ULPGATE_WIDE_1(exp2, ULPGATE_EXP2)
ULPGATE_WIDE_1(expm1, ULPGATE_EXPM1)
ULPGATE_WIDE_1(log, ULPGATE_LOG)
ULPGATE_WIDE_1(log2, ULPGATE_LOG2)
ULPGATE_WIDE_1(log10, ULPGATE_LOG10)
ULPGATE_WIDE_1(log1p, ULPGATE_LOG1P)
ULPGATE_WIDE_1(sin, ULPGATE_SIN)
ULPGATE_WIDE_1(cos, ULPGATE_COS)
ULPGATE_WIDE_1(tan, ULPGATE_TAN)
ULPGATE_WIDE_1(asin, ULPGATE_ASIN)
ULPGATE_WIDE_1(acos, ULPGATE_ACOS)
ULPGATE_WIDE_1(atan, ULPGATE_ATAN)
ULPGATE_WIDE_1(sinh, ULPGATE_SINH)
ULPGATE_WIDE_1(cosh, ULPGATE_COSH)
ULPGATE_WIDE_1(tanh, ULPGATE_TANH)
ULPGATE_WIDE_1(asinh, ULPGATE_ASINH)
ULPGATE_WIDE_1(acosh, ULPGATE_ACOSH)
ULPGATE_WIDE_1(atanh, ULPGATE_ATANH)
ULPGATE_WIDE_1(erf, ULPGATE_ERF)
ULPGATE_WIDE_1(erfc, ULPGATE_ERFC)
ULPGATE_WIDE_1(tgamma, ULPGATE_TGAMMA)
ULPGATE_WIDE_1(lgamma, ULPGATE_LGAMMA)
ULPGATE_WIDE_1(floor, ULPGATE_FLOOR)
ULPGATE_WIDE_1(ceil, ULPGATE_CEIL)
ULPGATE_WIDE_1(trunc, ULPGATE_TRUNC)
ULPGATE_WIDE_1(round, ULPGATE_ROUND)
ULPGATE_WIDE_2(pow, ULPGATE_POW)
ULPGATE_WIDE_2(hypot, ULPGATE_HYPOT)
ULPGATE_WIDE_2(atan2, ULPGATE_ATAN2)
ULPGATE_WIDE_2(fmod, ULPGATE_FMOD)
ULPGATE_WIDE_2(remainder, ULPGATE_REMAINDER)
ULPGATE_WIDE_2(fmin, ULPGATE_FMIN)
ULPGATE_WIDE_2(fmax, ULPGATE_FMAX)
ULPGATE_WIDE_2(min, ULPGATE_FMIN)
ULPGATE_WIDE_2(max, ULPGATE_FMAX)
ULPGATE_WIDE_2(copysign, ULPGATE_COPYSIGN)
#undef ULPGATE_WIDE_1
#undef ULPGATE_WIDE_2

}  // namespace ulpgate

// std::sqrt(x) with a qualified name finds no function of a class: the text says what to write instead.
namespace std {
#define ULPGATE_QUALIFIED(NAME)                                                                             \
  template <class Real, std::enable_if_t<std::is_same_v<Real, ulpgate::Wide>, int> = 0>                     \
  Real NAME(const Real&) {                                                                                  \
    static_assert(!std::is_same_v<Real, ulpgate::Wide>,                                                     \
                  "ulpgate: std::" #NAME "(x) names the built-in types' function. Write: using std::" #NAME \
                  "; " #NAME "(x)");                                                                        \
  }
ULPGATE_QUALIFIED(fabs)
ULPGATE_QUALIFIED(abs)
ULPGATE_QUALIFIED(sqrt)
ULPGATE_QUALIFIED(cbrt)
ULPGATE_QUALIFIED(exp)
ULPGATE_QUALIFIED(expm1)
ULPGATE_QUALIFIED(log)
ULPGATE_QUALIFIED(log1p)
ULPGATE_QUALIFIED(sin)
ULPGATE_QUALIFIED(cos)
ULPGATE_QUALIFIED(tan)
ULPGATE_QUALIFIED(asin)
ULPGATE_QUALIFIED(acos)
ULPGATE_QUALIFIED(atan)
ULPGATE_QUALIFIED(tanh)
ULPGATE_QUALIFIED(floor)
ULPGATE_QUALIFIED(ceil)
#undef ULPGATE_QUALIFIED
#define ULPGATE_MIXED(NAME)                                                                  \
  template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>           \
  ulpgate::Wide NAME(const ulpgate::Wide& a, Number) {                                       \
    static_assert(!std::is_arithmetic_v<Number>, "ulpgate: std::" #NAME                      \
                                                 "(x, 0.0) mixes Real and a built-in type. " \
                                                 "Write: " #NAME "(x, Real(0.0))");          \
    return a;                                                                                \
  }
ULPGATE_MIXED(max)
ULPGATE_MIXED(min)
#undef ULPGATE_MIXED
}  // namespace std
