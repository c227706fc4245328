// FloatFormat: precision and exponent range of a binary floating-point type, known at run time.
#pragma once

#include <limits>

#include "reference/types/real_types.hpp"

namespace ulpgate {

// Values are m * 2^e with 1 <= m < 2 and exponent_min <= e <= exponent_max; `precision` counts the
// significand's bits with the leading one.  With subnormals the spacing below 2^exponent_min stays that of
// exponent_min.
struct FloatFormat {
  long precision;
  long exponent_min;
  long exponent_max;
  bool subnormals;

  // Exponent of the smallest positive value.
  [[nodiscard]] long exponent_least() const {
    return subnormals ? exponent_min - (precision - 1) : exponent_min;
  }
  friend bool operator==(const FloatFormat&, const FloatFormat&) = default;
};

template <RealType Real>
[[nodiscard]] constexpr FloatFormat float_format() {
  using L = std::numeric_limits<Real>;
  // The standard's min_exponent and max_exponent count significands in [1/2, 1); cpp_bin_float's count them
  // in [1, 2).
  constexpr long offset = CppBinFloatBacked<Real> ? 0 : 1;
  return {L::digits, L::min_exponent - offset, L::max_exponent - offset,
          L::has_denorm == std::denorm_present};
}

}  // namespace ulpgate
