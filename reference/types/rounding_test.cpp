// Tests of rounding and stepping in a format, against the processor's own float and double.
#include "reference/types/rounding.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "reference/types/exchange.hpp"
#include "reference/types/mpfr_value.hpp"

namespace ulpgate {
namespace {

constexpr double infinity = HUGE_VAL;

double rounded_to_float_format(double x) {
  MpfrValue v(53);
  mpfr_set_d(v, x, MPFR_RNDN);
  round_to_format(v, float_format<float>());
  return mpfr_get_d(v, MPFR_RNDN);
}

void expect_as_the_processor(double x) {
  const auto want = static_cast<double>(static_cast<float>(x));
  const double got = rounded_to_float_format(x);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(got), std::bit_cast<std::uint64_t>(want)) << std::hexfloat << x;
}

TEST(Rounding, ToFloatIsTheProcessorsWithTiesAndNeighboursOfTies) {
  // Midpoints of floats and doubles next to them, from half the least number to beyond the largest.
  for (int e = -152; e <= 128; ++e) {
    for (const double m : {1.0, 1.5, 1 + 0x1p-24, 1 + 0x3p-24, 2 - 0x1p-24, 1.25, 1 + 0x1p-22}) {
      const double x = std::ldexp(m, e);
      for (const double y : {x, std::nextafter(x, 0), std::nextafter(x, infinity)}) {
        expect_as_the_processor(y);
        expect_as_the_processor(-y);
      }
    }
  }
  for (const double x : {0.0, -0.0, infinity, -infinity}) expect_as_the_processor(x);
}

TEST(Rounding, ToFloatIsTheProcessorsForAnyDouble) {
  std::mt19937_64 words(1);
  for (int i = 0; i < 20000; ++i) {
    // Exponents of float with a margin on both sides.
    const auto fraction = static_cast<double>(words() >> 11U) * 0x1p-53 + 1;
    const int e = static_cast<int>(words() % 300) - 160;
    expect_as_the_processor(std::ldexp(fraction, e));
  }
}

TEST(Rounding, WithoutSubnormalsEndsAtTheLeastNormalNumber) {
  const FloatFormat format{24, -126, 127, false};
  const auto rounded = [&](double x) {
    MpfrValue v(53);
    mpfr_set_d(v, x, MPFR_RNDN);
    round_to_format(v, format);
    return mpfr_get_d(v, MPFR_RNDN);
  };
  EXPECT_EQ(format.exponent_least(), -126);
  EXPECT_EQ(rounded(0x1p-126), 0x1p-126);
  EXPECT_EQ(rounded(0x1.fffp-127), 0x1p-126);
  EXPECT_EQ(rounded(0x1.000002p-127), 0x1p-126);
  EXPECT_EQ(rounded(0x1p-127), 0) << "the tie goes to zero";
  EXPECT_EQ(rounded(-0x1.8p-127), -0x1p-126);
  EXPECT_TRUE(std::signbit(rounded(-0x1p-128)));
  EXPECT_EQ(rounded(0x1.000001p-126), 0x1p-126) << "the precision is that of normal numbers";
  EXPECT_EQ(rounded(0x1.000003p-126), 0x1.000004p-126);
}

template <class Real>
Real stepped(Real x, long steps) {
  MpfrValue v(std::numeric_limits<Real>::digits);
  to_mpfr(v.get(), x);
  step_in_format(v, steps, float_format<Real>());
  return from_mpfr<Real>(v);
}

// `steps` times std::nextafter, which like step_in_format stays at an infinity.
template <class Real>
Real walked(Real x, long steps) {
  for (; steps > 0; --steps) x = std::nextafter(x, std::numeric_limits<Real>::infinity());
  for (; steps < 0; ++steps) x = std::nextafter(x, -std::numeric_limits<Real>::infinity());
  return x;
}

template <class Real>
void expect_steps_of_the_library() {
  using L = std::numeric_limits<Real>;
  const Real starts[] = {0,
                         1,
                         2,
                         Real(0.75),
                         L::denorm_min(),
                         2 * L::denorm_min(),
                         L::min(),
                         2 * L::min(),
                         L::min() - L::denorm_min(),
                         L::min() + L::denorm_min(),
                         L::max(),
                         L::max() / 2,
                         L::infinity(),
                         std::nextafter(L::max(), Real(0))};
  for (const Real start : starts) {
    for (const Real x : {start, -start}) {
      for (long steps = -5; steps <= 5; ++steps) {
        EXPECT_EQ(stepped(x, steps), walked(x, steps)) << x << " and " << steps << " steps";
        if (walked(x, steps) != 0 || steps == 0) continue;
        EXPECT_EQ(std::signbit(stepped(x, steps)), std::signbit(walked(x, steps))) << x << " and " << steps;
      }
    }
  }
}

TEST(Rounding, StepsAreThoseOfTheLibraryFromBothInfinitiesOn) {
  expect_steps_of_the_library<float>();
  expect_steps_of_the_library<double>();
  expect_steps_of_the_library<long double>();
}

TEST(Rounding, StepsBackFromInfinityToTheLargestNumberOfEveryFormat) {
  for (const FloatFormat& format : {float_format<float>(), float_format<double>(),
                                    float_format<MpfrReal<62>>(), FloatFormat{11, -14, 15, true}}) {
    const WideExponentRange wide;
    for (const int sign : {1, -1}) {
      MpfrValue largest(format.precision + 2);
      mpfr_set_inf(largest, sign);
      step_in_format(largest, -sign, format);
      ASSERT_TRUE(mpfr_number_p(largest.get()));
      EXPECT_EQ(binade(largest), format.exponent_max);
      MpfrValue unit(format.precision + 2);
      mpfr_set_si_2exp(unit, sign, format.exponent_max - (format.precision - 1), MPFR_RNDN);
      mpfr_add(unit, unit, largest, MPFR_RNDN);
      EXPECT_EQ(mpfr_cmp_si_2exp(unit, sign, format.exponent_max + 1), 0) << "one unit below the next binade";
      step_in_format(largest, sign, format);
      EXPECT_TRUE(mpfr_inf_p(largest.get()));
      step_in_format(largest, sign, format);
      EXPECT_TRUE(mpfr_inf_p(largest.get())) << "and stays there";
    }
  }
}

TEST(Rounding, StepsWithoutSubnormalsLeapOverThem) {
  const FloatFormat format{24, -126, 127, false};
  const auto stepped_from = [&](double x, long steps) {
    MpfrValue v(53);
    mpfr_set_d(v, x, MPFR_RNDN);
    step_in_format(v, steps, format);
    return mpfr_get_d(v, MPFR_RNDN);
  };
  EXPECT_EQ(stepped_from(0, 1), 0x1p-126);
  EXPECT_EQ(stepped_from(0, -1), -0x1p-126);
  EXPECT_EQ(stepped_from(0, 2), 0x1.000002p-126);
  EXPECT_EQ(stepped_from(0x1p-126, -1), 0);
  EXPECT_EQ(stepped_from(0x1p-126, -2), -0x1p-126);
  EXPECT_EQ(stepped_from(-0x1.000002p-126, 3), 0x1p-126);
  EXPECT_TRUE(std::signbit(stepped_from(-0x1p-126, 1)));
  EXPECT_EQ(stepped_from(0x1p-125, -1), 0x1.fffffep-126);
}

}  // namespace
}  // namespace ulpgate
