// Constants in full precision from their decimal text, so that no double literal reaches a kernel.
#pragma once

#include "reference/text/text.hpp"

namespace ulpgate {

// real<Real>("9.81"): the Real nearest to the decimal or hexfloat text.  A malformed literal is a programming
// error and throws std::invalid_argument.
template <RealType Real>
[[nodiscard]] Real real(std::string_view text) {
  return parse_real<Real>(text);
}

}  // namespace ulpgate
