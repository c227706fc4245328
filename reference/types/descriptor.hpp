// RealDescriptor: what `ulpgate list types` prints of a Real, computed from the type itself.
#pragma once

#include <climits>
#include <string>

#include "reference/types/format.hpp"

namespace ulpgate {

struct RealDescriptor {
  std::string token;
  std::string cpp_type;
  int total_bits;  // 0 where the representation is not a fixed-width interchange format
  int decimal_places;
  int exponent_bits;  // 0 likewise
  int significand_bits;
  FloatFormat format;
  int reference_decimal_places;  // of RealHP<4>
  long reference_bits;           // significand bits of RealHP<4>
};

template <RealType Real>
[[nodiscard]] RealDescriptor describe(std::string token, std::string cpp_type) {
  using L = std::numeric_limits<Real>;
  using Reference = RealHP<4, Real>;
  constexpr bool ieee = NativeReal<Real> || Float128Backed<Real>;
  int exponent_bits = 0;
  int total_bits = 0;
  if constexpr (ieee) {
    // The IEEE exponent field holds 2 * emax + 2 codes.
    while ((1L << exponent_bits) < 2L * L::max_exponent) ++exponent_bits;
    // x87 stores its leading significand bit, the interchange formats do not.
    constexpr bool explicit_leading_bit = L::digits == 64;
    total_bits = 1 + exponent_bits + L::digits - (explicit_leading_bit ? 0 : 1);
  }
  return {std::move(token),
          std::move(cpp_type),
          total_bits,
          L::digits10,
          exponent_bits,
          L::digits,
          float_format<Real>(),
          std::numeric_limits<Reference>::digits10,
          std::numeric_limits<Reference>::digits};
}

}  // namespace ulpgate
