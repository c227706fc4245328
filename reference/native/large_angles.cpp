// The reduction of large angles.
#include "reference/native/large_angles.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numbers>

#include "reference/types/mpfr_value.hpp"

namespace ulpgate {

namespace {

constexpr int least_exponent = 22;
constexpr int greatest_exponent = 127;

// For x = m 2^e with an integer m of 24 bits: 2^e 2/pi mod 4 = high + middle + low, where m * high and
// m * middle are exact.
struct Factor {
  double to_integer;  // 2^-e
  double high;        // multiple of 2^-26
  double middle;      // multiple of 2^-54
  double low;
};
using Factors = std::array<Factor, greatest_exponent - least_exponent + 1>;

Factors make_factors() {
  constexpr auto nearest = MPFR_RNDN;
  Factors factors;
  MpfrValue two_over_pi(400);
  mpfr_const_pi(two_over_pi, nearest);
  mpfr_ui_div(two_over_pi, 2, two_over_pi, nearest);
  MpfrValue rest(400);
  MpfrValue part(400);
  // Takes the multiple of 2^-bits out of the rest.
  const auto take = [&](unsigned long bits) {
    mpfr_mul_2ui(part, rest, bits, nearest);
    mpfr_trunc(part, part);
    mpfr_div_2ui(part, part, bits, nearest);
    mpfr_sub(rest, rest, part, nearest);
    return mpfr_get_d(part, nearest);
  };
  for (int exponent = least_exponent; exponent <= greatest_exponent; ++exponent) {
    const int e = exponent - 23;
    mpfr_mul_2si(rest, two_over_pi, e - 2, nearest);
    mpfr_frac(rest, rest, nearest);
    mpfr_mul_2ui(rest, rest, 2, nearest);
    Factor& f = factors[static_cast<std::size_t>(exponent - least_exponent)];
    f.to_integer = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - e) << 52U);
    f.high = take(26);
    f.middle = take(54);
    f.low = mpfr_get_d(rest, nearest);
  }
  return factors;
}

}  // namespace

void reduce_large_angles(const double* x, std::size_t count, double* angles, std::uint8_t* quadrants) {
  static const Factors factors = make_factors();
  // Added and taken away again it rounds to an integer, which its last bits show meanwhile.
  constexpr double magic = 0x1.8p52;
  for (std::size_t i = 0; i < count; ++i) {
    const auto bits = std::bit_cast<std::uint64_t>(x[i]);
    const int exponent = static_cast<int>((bits >> 52U) & 0x7ffU) - 1023;
    const Factor& f = factors[static_cast<std::size_t>(
        std::clamp(exponent, least_exponent, greatest_exponent) - least_exponent)];
    const double m = x[i] * f.to_integer;
    const double high = m * f.high;      // exact, below 2^26
    const double middle = m * f.middle;  // exact, below 1/4
    const double shifted = (high + middle) + magic;
    // Exact: both terms are multiples of 2^-26.  The next sum is one of multiples of 2^-54, exact where it
    // cancels.
    const double fraction = ((high - (shifted - magic)) + middle) + m * f.low;
    angles[i] = fraction * (std::numbers::pi / 2);
    quadrants[i] = static_cast<std::uint8_t>(std::bit_cast<std::uint64_t>(shifted) & 3U);
  }
}

}  // namespace ulpgate
