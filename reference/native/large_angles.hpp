// Argument reduction of sin, cos and tan for large binary32 numbers, in binary64.
#pragma once

#include <cstddef>
#include <cstdint>

namespace ulpgate {

// At least this, the least argument that is reduced here.
inline constexpr double least_large_angle = 0x1p22;

// x[i] = n pi/2 + r with an integer n: writes angles[i] = r, |r| < 0.79, and quadrants[i] = n mod 4.  For
// finite numbers of 24 significant bits, least_large_angle <= |x| < 2^128, r is within 2 ulp of its exact
// value; anything else gets some r and n.
//
// Method: Payne and Hanek, "Radian reduction for trigonometric functions", SIGNUM Newsletter 18 (1983), with
// a table of 2^e 2/pi mod 4 for every exponent.  No binary32 number comes closer to a multiple of pi/2 than
// 2^-30 of it, so that 110 bits of 2/pi suffice.
void reduce_large_angles(const double* x, std::size_t count, double* angles, std::uint8_t* quadrants);

}  // namespace ulpgate
