// The one opt-in header for arithmetic between RealHP levels: the narrower operand is widened exactly first.
//
// Without it `RealHP<1> + RealHP<4>` of a multiprecision base does not compile, so a forgotten conversion
// cannot hide in a kernel.  Include it only where mixing is the purpose (comparing a result to its
// reference).
#pragma once

#include "reference/widen.hpp"

namespace ulpgate::detail {
template <class A, class B>
concept MixedNumbers =
    RealType<A> && RealType<B> && !std::same_as<A, B> &&
    (mp::is_number<A>::value && mp::is_number<B>::value) && (widens_exactly<A, B> || widens_exactly<B, A>);

template <class A, class B>
using Wider = std::conditional_t<widens_exactly<A, B>, B, A>;
}  // namespace ulpgate::detail

namespace boost::multiprecision {

#define ULPGATE_MIXED_OPERATOR(op)                                                 \
  template <class A, class B>                                                      \
  requires ulpgate::detail::MixedNumbers<A, B>                                     \
  [[nodiscard]] ulpgate::detail::Wider<A, B> operator op(const A& a, const B& b) { \
    using W = ulpgate::detail::Wider<A, B>;                                        \
    return ulpgate::widen<W>(a) op ulpgate::widen<W>(b);                           \
  }
ULPGATE_MIXED_OPERATOR(+)
ULPGATE_MIXED_OPERATOR(-)
ULPGATE_MIXED_OPERATOR(*)
ULPGATE_MIXED_OPERATOR(/)
#undef ULPGATE_MIXED_OPERATOR

}  // namespace boost::multiprecision
