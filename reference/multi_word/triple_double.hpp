// TripleDouble: a number of about 159 bits as the unevaluated sum of three doubles.
#pragma once

namespace ulpgate {

struct TripleDouble {
  double hi = 0;
  double mid = 0;
  double lo = 0;
};

// One ulp of a TripleDouble as bounds count them: 2^-149 of the power of two below the number.
inline constexpr int triple_double_bits = 150;
// The binade down to which all parts of a number have all of their bits.
inline constexpr int triple_double_least = -910;

}  // namespace ulpgate
