// Real number types under test and the ladder RealHP<N, Base> of their multiples of precision.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/mpfr.hpp>
#ifdef ULPGATE_HAVE_FLOAT128
#include <boost/multiprecision/float128.hpp>
#endif
#include <concepts>
#include <limits>
#include <type_traits>

namespace ulpgate {

namespace mp = boost::multiprecision;

// Expression templates are off: `auto` then always names a value, and a kernel's intermediate results are
// rounded one by one, exactly as they are for a native type.  MPFR digits live on the stack because the heap
// doubles the time of an operation at 62 digits.
template <unsigned Digits10>
using MpfrReal = mp::number<mp::mpfr_float_backend<Digits10, mp::allocate_stack>, mp::et_off>;

template <unsigned Digits10>
using CppBinFloatReal = mp::number<mp::cpp_bin_float<Digits10>, mp::et_off>;

#ifdef ULPGATE_HAVE_FLOAT128
using Float128Real = mp::number<mp::float128_backend, mp::et_off>;
#endif

template <class T>
struct IsMpfrReal : std::false_type {};
template <unsigned D>
struct IsMpfrReal<MpfrReal<D>> : std::true_type {};

template <class T>
struct IsCppBinFloatReal : std::false_type {};
template <unsigned D>
struct IsCppBinFloatReal<CppBinFloatReal<D>> : std::true_type {};

template <class T>
concept NativeReal = std::is_floating_point_v<T>;
template <class T>
concept MpfrBacked = IsMpfrReal<T>::value;
template <class T>
concept CppBinFloatBacked = IsCppBinFloatReal<T>::value;
#ifdef ULPGATE_HAVE_FLOAT128
template <class T>
concept Float128Backed = std::same_as<T, Float128Real>;
#else
template <class T>
concept Float128Backed = false;
#endif

// A type that watches what is done with it: kernels are instantiated with it, results are not measured in it.
template <class T>
inline constexpr bool is_instrumented_real = false;

// Every type that the harness can measure.
template <class T>
concept RealType =
    NativeReal<T> || MpfrBacked<T> || CppBinFloatBacked<T> || Float128Backed<T> || is_instrumented_real<T>;

namespace detail {

// The narrowest IEEE format of this machine with at least `Digits10` decimal digits, else MPFR.
template <int Digits10>
consteval auto pick_binary_family() {
  if constexpr (std::numeric_limits<float>::digits10 >= Digits10) {
    return std::type_identity<float>{};
  } else if constexpr (std::numeric_limits<double>::digits10 >= Digits10) {
    return std::type_identity<double>{};
  } else if constexpr (std::numeric_limits<long double>::digits10 >= Digits10) {
    return std::type_identity<long double>{};
#ifdef ULPGATE_HAVE_FLOAT128
  } else if constexpr (std::numeric_limits<Float128Real>::digits10 >= Digits10) {
    return std::type_identity<Float128Real>{};
#endif
  } else {
    return std::type_identity<MpfrReal<static_cast<unsigned>(Digits10)>>{};
  }
}

template <unsigned N, class Base>
struct RealHPImpl {
  using type = typename decltype(pick_binary_family<N * std::numeric_limits<Base>::digits10>())::type;
};
template <RealType Base>
struct RealHPImpl<1, Base> {
  using type = Base;
};
template <unsigned N, unsigned D>
requires(N > 1) struct RealHPImpl<N, MpfrReal<D>> {
  using type = MpfrReal<N * D>;
};
template <unsigned N, unsigned D>
requires(N > 1) struct RealHPImpl<N, CppBinFloatReal<D>> {
  using type = CppBinFloatReal<N * D>;
};

}  // namespace detail

// The type with at least N times the decimal digits of Base; RealHP<1, Base> is Base itself.  An IEEE base
// climbs through the wider IEEE formats and then into MPFR; an MPFR or cpp_bin_float base stays in its
// family.
template <unsigned N, RealType Base>
requires(N >= 1) using RealHP = typename detail::RealHPImpl<N, Base>::type;

// True where every value of From is a value of To: at least its significand and its exponent range.
//
// cpp_bin_float takes its guard bits from the exponent range, so more digits cost the last thousand or so of
// its 2^31 exponents; those are let pass, as no sampled argument comes near them.
template <class From, class To>
inline constexpr bool widens_exactly = [] {
  using F = std::numeric_limits<From>;
  using T = std::numeric_limits<To>;
  constexpr long slack = CppBinFloatBacked<From> && CppBinFloatBacked<To> ? 1L << 20 : 0;
  return F::digits <= T::digits && F::max_exponent <= T::max_exponent + slack &&
         F::min_exponent - long{F::digits} >= T::min_exponent - long{T::digits} - slack;
}();

// Two multiprecision levels that must not meet in one operation by accident.
template <class A, class B>
concept DifferentLevels = RealType<A> && RealType<B> && !std::same_as<A, B>;

}  // namespace ulpgate

// Boost would convert the narrower operand in silence, and a forgotten conversion would hide in a kernel; so
// arithmetic between levels does not compile unless reference/types/mixed_precision.hpp is included.  (Found
// by ADL, like Boost's own.)
namespace boost::multiprecision {

#define ULPGATE_NO_MIXED_OPERATOR(op)                                     \
  template <class A, class B>                                             \
  requires ulpgate::DifferentLevels<number<A, et_off>, number<B, et_off>> \
  void operator op(const number<A, et_off>& a, const number<B, et_off>& b) = delete;
ULPGATE_NO_MIXED_OPERATOR(+)
ULPGATE_NO_MIXED_OPERATOR(-)
ULPGATE_NO_MIXED_OPERATOR(*)
ULPGATE_NO_MIXED_OPERATOR(/)
#undef ULPGATE_NO_MIXED_OPERATOR

}  // namespace boost::multiprecision
