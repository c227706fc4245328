// The pieces of 2/pi.
#include "reference/double_lanes/large_angles.hpp"

#include "reference/types/mpfr_value.hpp"

namespace ulpgate {

namespace {

LargeAngles make_large_angles() {
  constexpr auto nearest = MPFR_RNDN;
  LargeAngles angles;
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
  for (int exponent = LargeAngles::least_exponent; exponent <= LargeAngles::greatest_exponent; ++exponent) {
    const int e = exponent - 23;
    mpfr_mul_2si(rest, two_over_pi, e - 2, nearest);
    mpfr_frac(rest, rest, nearest);
    mpfr_mul_2ui(rest, rest, 2, nearest);
    LargeAngle& f = angles.factors[static_cast<std::size_t>(exponent - LargeAngles::least_exponent)];
    f.to_integer = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - e) << 52U);
    f.high = take(26);
    f.middle = take(54);
    f.low = mpfr_get_d(rest, nearest);
  }
  return angles;
}

}  // namespace

const LargeAngles& large_angles() {
  static const LargeAngles angles = make_large_angles();
  return angles;
}

}  // namespace ulpgate
