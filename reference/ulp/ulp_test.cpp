// Tests of ULP error, float distance and outcome classes.
#include "reference/ulp/ulp.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/next.hpp>
#include <cmath>

#include "reference/text/text.hpp"

namespace ulpgate {
namespace {

MpfrValue value(const char* text) {
  MpfrValue v(400);
  EXPECT_NE(mpfr_set_str(v, text, 0, MPFR_RNDN), -1) << text;
  return v;
}

struct Case {
  const char* got;
  const char* exact;
  Outcome outcome;
  double ulp;
  const char* why;
};

TEST(Judge, Double) {
  const Case cases[] = {
      {"1", "1", Outcome::finite, 0, "exact"},
      {"1", "0x1.00000000000008p+0", Outcome::finite, 0.5, "half an ulp above 1"},
      {"1", "0x1.ffffffffffffcp-1", Outcome::finite, 4,
       "below 1 the spacing is halved: the binade of the exact value counts"},
      {"0x1.0000000000001p+0", "1", Outcome::finite, 1, "one ulp"},
      {"0x0.0000000000001p-1022", "0x0.00000000000018p-1022", Outcome::finite, 0.5, "subnormal spacing"},
      {"0", "0x1.8p-1075", Outcome::finite, 0.75,
       "flushing 0.75 of the least number is an error below 1 ULP"},
      {"0", "0x1p-1022", Outcome::underflow_spurious, 0, "a normal number became zero"},
      {"@Inf@", "0x1p+1000", Outcome::overflow_spurious, 0, "infinity far inside the range"},
      {"@Inf@", "0x1.fffffffffffff4p+1023", Outcome::finite, 0.75,
       "infinity counts as 2^1024 within 1 ULP of it"},
      {"@Inf@", "0x1p+1025", Outcome::finite, 0, "infinity is right beyond the range"},
      {"0x1.fffffffffffffp+1023", "0x1p+1025", Outcome::overflow_missed, 0, "overflow missed"},
      {"0x1.fffffffffffffp+1023", "0x1.fffffffffffffcp+1023", Outcome::finite, 0.75,
       "the largest number within 1 ULP of what rounds to infinity"},
      {"-@Inf@", "1", Outcome::inf, 0, "infinity of the wrong sign"},
      {"1", "@Inf@", Outcome::inf, 0, "a pole missed"},
      {"@NaN@", "1", Outcome::nan, 0, "NaN for a value"},
      {"1", "@NaN@", Outcome::not_nan, 0, "value for a NaN"},
      {"@NaN@", "@NaN@", Outcome::finite, 0, "agreed NaN"},
      {"0", "-0", Outcome::zero_sign, 0, "sign of zero"},
      {"0x1p-1074", "0", Outcome::nonzero_for_zero, 0, "not zero"},
      {"-1", "1", Outcome::finite, 0x1p+53, "a wrong sign is a large error"},
  };
  for (const auto& c : cases) {
    const Judgement j = judge(value(c.got), value(c.exact), float_format<double>());
    EXPECT_EQ(name_of(j.outcome), name_of(c.outcome)) << c.why;
    if (c.outcome == Outcome::finite) {
      EXPECT_DOUBLE_EQ(j.error.value, c.ulp) << c.why;
    }
  }
}

TEST(Judge, FormatWithoutSubnormalsCannotFlush) {
  const FloatFormat f = float_format<MpfrReal<62>>();
  MpfrValue tiny(300);
  mpfr_set_ui_2exp(tiny, 1, f.exponent_min, MPFR_RNDN);
  MpfrValue zero(64);
  mpfr_set_zero(zero, 1);
  EXPECT_EQ(judge(zero, tiny, f).outcome, Outcome::underflow_spurious);
}

// 2^exponent_min is the least positive number here, and the step from it to 0.
TEST(Judge, TheSpacingNextToZeroIsTheLeastNumber) {
  struct Case {
    double got, exact;  // in units of the least number
    double ulp;
    double distance;
    bool nearest;
    Outcome outcome = Outcome::finite;
  };
  constexpr double far = 0x1p-600;
  for (const FloatFormat& f : {float_format<MpfrReal<62>>(), float_format<MpfrReal<150>>(),
                               float_format<CppBinFloatReal<62>>(), float_format<double>()}) {
    for (const auto& [got, exact, ulp, distance, nearest, outcome] : {
             Case{0, 0.25, 0.25, 0, true},
             Case{0, 0.5, 0.5, 0, true},
             Case{1, 0.5, 0.5, 1, false},
             Case{1, 0.75, 0.25, 0, true},
             Case{0, 0.75, 0.75, 1, false},
             Case{0, far, far, 0, true},
             Case{1, far, 1, 1, false},
             Case{0, -0.25, 0, 0, false, Outcome::zero_sign},
             Case{-1, -0.75, 0.25, 0, true},
             Case{-1, 0.75, 1.75, 2, false},
         }) {
      const WideExponentRange wide;
      MpfrValue a(700), b(700);
      mpfr_set_d(a, got, MPFR_RNDN);
      mpfr_set_d(b, exact, MPFR_RNDN);
      mpfr_mul_2si(a, a, f.exponent_least(), MPFR_RNDN);
      mpfr_mul_2si(b, b, f.exponent_least(), MPFR_RNDN);
      const Judgement j = judge(a, b, f);
      EXPECT_EQ(name_of(j.outcome), name_of(outcome)) << got << " for " << exact;
      if (outcome != Outcome::finite) continue;
      EXPECT_EQ(j.error.value, ulp) << got << " for " << exact;
      EXPECT_EQ(j.distance, distance) << got << " for " << exact;
      EXPECT_EQ(j.correctly_rounded, nearest) << got << " for " << exact;
    }
  }
}

// Of two numbers beside a midpoint the farther one is off by more than half an ULP, however little.
TEST(Judge, MoreThanHalfAnUlpIsMoreThanHalf) {
  MpfrValue exact(400);
  mpfr_set_ui_2exp(exact, 1, -53, MPFR_RNDN);
  mpfr_add_ui(exact, exact, 1, MPFR_RNDN);
  mpfr_nextabove(exact);
  const Judgement down = judge(value("1"), exact, float_format<double>());
  EXPECT_GT(down.error.value, 0.5);
  EXPECT_FALSE(down.correctly_rounded);
  const Judgement up = judge(value("0x1.0000000000001p+0"), exact, float_format<double>());
  EXPECT_LE(up.error.value, 0.5);
  EXPECT_TRUE(up.correctly_rounded);
}

// One step above the largest number where that is the right one.
TEST(Judge, AnInfinityNextToTheThresholdIsOneStepOff) {
  for (const char* sign : {"", "-"}) {
    const auto at = [&](const char* text) { return value((sign + std::string(text)).c_str()); };
    const Judgement j = judge(at("@Inf@"), at("0x1.fffffffffffff4p+1023"), float_format<double>());
    EXPECT_EQ(j.distance, 1);
    EXPECT_FALSE(j.correctly_rounded);
    const Judgement largest =
        judge(at("0x1.fffffffffffffp+1023"), at("0x1.fffffffffffffcp+1023"), float_format<double>());
    EXPECT_EQ(largest.distance, 1);
    EXPECT_FALSE(largest.correctly_rounded);
  }
}

TEST(FloatDistance, AgreesWithBoostWhereBoostIsDefined) {
  const double pairs[][2] = {{1, 2},
                             {1, std::nextafter(1.0, 0)},
                             {0.5, 1e10},
                             {-1, 1},
                             {0x1p-1074, 0x1p-1000},
                             {-0x1p-1074, 0x1p-1074},
                             {3, 3},
                             {0, 0x1p-1022}};
  for (const auto& p : pairs) {
    MpfrValue a(53);
    MpfrValue b(53);
    to_mpfr(a.get(), p[0]);
    to_mpfr(b.get(), p[1]);
    EXPECT_EQ(float_distance(a, b, float_format<double>()),
              std::fabs(boost::math::float_distance(p[0], p[1])))
        << p[0] << " " << p[1];
  }
}

TEST(FloatDistance, CountsAcrossZeroWithoutSubnormals) {
  const FloatFormat f = float_format<MpfrReal<62>>();
  MpfrValue least(207);
  mpfr_set_ui_2exp(least, 1, f.exponent_min, MPFR_RNDN);
  MpfrValue minus(207);
  mpfr_neg(minus, least, MPFR_RNDN);
  EXPECT_EQ(float_distance(least, minus, f), 2) << "-least, 0, least";
}

TEST(Rounding, StepsThroughEveryKindOfNeighbour) {
  const double starts[] = {1, -1, 0x1p-1022, 0x1p-1074, 0, 0x1.fffffffffffffp+1023, 1.5, -0x1p-1030};
  for (const double x : starts) {
    for (const int direction : {1, -1}) {
      MpfrValue v(53);
      to_mpfr(v.get(), x);
      step_in_format(v, direction, float_format<double>());
      EXPECT_EQ(from_mpfr<double>(v), std::nextafter(x, direction * HUGE_VAL)) << x;
    }
  }
}

TEST(Rounding, StepsFromTheLeastNumberToZeroWithoutSubnormals) {
  const FloatFormat f = float_format<MpfrReal<62>>();
  for (const int sign : {1, -1}) {
    MpfrValue v(f.precision);
    mpfr_set_si_2exp(v, sign, f.exponent_least(), MPFR_RNDN);
    step_in_format(v, -sign, f);
    EXPECT_TRUE(mpfr_zero_p(v.get()));
    EXPECT_EQ(mpfr_signbit(v.get()) != 0, sign < 0);
  }
}

}  // namespace
}  // namespace ulpgate
