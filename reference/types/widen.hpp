// Exact widening of a value to a type of higher precision; the narrowing direction does not compile.
#pragma once

#include "reference/types/real_types.hpp"

namespace ulpgate {

// Returns x in To with all extra bits zero.  Error: none.  A To that cannot hold every From does not compile.
template <RealType To, RealType From>
requires widens_exactly<From, To>
[[nodiscard]] To widen(const From& x) {
  return static_cast<To>(x);
}

}  // namespace ulpgate
