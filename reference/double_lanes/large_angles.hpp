// 2/pi for the reduction of large binary32 angles in binary64.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace ulpgate {

// Up to here two pieces of pi/2 do (angles.inc).
inline constexpr double least_large_angle = 0x1p22;

// For x = m 2^e with an integer m of 24 bits: 2^e 2/pi mod 4 = high + middle + low, where m * high and m *
// middle are exact.
//
// Method: Payne and Hanek, "Radian reduction for trigonometric functions", SIGNUM Newsletter 18 (1983), with
// a table for every exponent.  No binary32 number comes closer to a multiple of pi/2 than 2^-30 of it, so
// that 110 bits of 2/pi leave its remainder right to 2 ulp.
struct LargeAngle {
  double to_integer;  // 2^-e
  double high;        // multiple of 2^-26
  double middle;      // multiple of 2^-54
  double low;
};

struct LargeAngles {
  static constexpr int least_exponent = 22;
  static constexpr int greatest_exponent = 127;

  std::array<LargeAngle, greatest_exponent - least_exponent + 1> factors;

  // Of any x; of what is no large binary32 number the row says nothing.
  [[nodiscard]] const LargeAngle& of(double x) const {
    const int exponent = static_cast<int>((std::bit_cast<std::uint64_t>(x) >> 52U) & 0x7ffU) - 1023;
    return factors[static_cast<std::size_t>(std::clamp(exponent, least_exponent, greatest_exponent) -
                                            least_exponent)];
  }
};

// Computed by MPFR when it is first asked for.
[[nodiscard]] const LargeAngles& large_angles();

}  // namespace ulpgate
