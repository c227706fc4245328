// The one opt-in header for arithmetic between RealHP levels: the narrower operand is widened exactly first.
//
// Without it `RealHP<1> + RealHP<4>` of multiprecision types does not compile (real_types.hpp deletes it).
// Include it only where mixing is the purpose, such as comparing a result with its reference.
#pragma once

#include "reference/types/widen.hpp"

namespace ulpgate {

// More constrained than DifferentLevels, so that these operators win over the deleted ones.
template <class A, class B>
concept MixableLevels = DifferentLevels<A, B> &&(widens_exactly<A, B> || widens_exactly<B, A>);

template <class A, class B>
using WiderOf = std::conditional_t<widens_exactly<A, B>, B, A>;

}  // namespace ulpgate

namespace boost::multiprecision {

#define ULPGATE_MIXED_OPERATOR(op)                                                         \
  template <class A, class B>                                                              \
  requires ulpgate::MixableLevels<number<A, et_off>, number<B, et_off>>                    \
  [[nodiscard]] auto operator op(const number<A, et_off>& a, const number<B, et_off>& b) { \
    using Wider = ulpgate::WiderOf<number<A, et_off>, number<B, et_off>>;                  \
    return ulpgate::widen<Wider>(a) op ulpgate::widen<Wider>(b);                           \
  }
ULPGATE_MIXED_OPERATOR(+)
ULPGATE_MIXED_OPERATOR(-)
ULPGATE_MIXED_OPERATOR(*)
ULPGATE_MIXED_OPERATOR(/)
#undef ULPGATE_MIXED_OPERATOR

}  // namespace boost::multiprecision
