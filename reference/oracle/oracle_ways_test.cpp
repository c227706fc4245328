// Tests of the oracle where it takes another way than MPFR and MPC: sines of huge angles, arguments, powers
// on axes and diagonals and far out, and erfc next to the pole of its rule's error.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "reference/oracle/oracle.hpp"
#include "reference/oracle/oracle_angles.hpp"
#include "reference/oracle/oracle_erf.hpp"
#include "reference/oracle/oracle_hyperbolic.hpp"
#include "reference/oracle/oracle_power.hpp"

namespace ulpgate {
namespace {

constexpr auto nearest = MPFR_RNDN;
constexpr long bits = 300;

struct Point {
  double re, im;
};

std::vector<MpfrValue> power(Point z, Point w) {
  std::vector<MpfrValue> args;
  for (const double x : {z.re, z.im, w.re, w.im}) {
    args.emplace_back(53);
    mpfr_set_d(args.back(), x, nearest);
  }
  std::vector<MpfrValue> out;
  out.emplace_back(bits);
  out.emplace_back(bits);
  exact_value(info_of(FunctionId::cpow), args, out);
  return out;
}

// w log z by MPC, to the bits of `log`.
void set_log_of_power(MpcValue& log, Point z, Point w) {
  MpcValue exponent(64);
  mpc_set_d_d(log, z.re, z.im, MPC_RNDNN);
  mpc_set_d_d(exponent, w.re, w.im, MPC_RNDNN);
  mpc_log(log, log, MPC_RNDNN);
  mpc_mul(log, log, exponent, MPC_RNDNN);
}

// exp(w log z) with five hundred bits more.
void expect_power(Point z, Point w) {
  const WideExponentRange range;
  const auto got = power(z, w);
  MpcValue want(bits + 500);
  set_log_of_power(want, z, w);
  mpc_exp(want, want, MPC_RNDNN);
  MpfrValue modulus(64), difference(64);
  mpc_abs(modulus, want, nearest);
  mpfr_mul_2si(modulus, modulus, -bits, nearest);
  const auto near = [&](const MpfrValue& a, mpfr_srcptr b) {
    mpfr_sub(difference, a, b, nearest);
    return mpfr_cmpabs(difference, modulus) <= 0;
  };
  EXPECT_TRUE(near(got[0], mpc_realref(static_cast<mpc_ptr>(want)))) << z.re << " " << z.im << " ^ " << w.re;
  EXPECT_TRUE(near(got[1], mpc_imagref(static_cast<mpc_ptr>(want)))) << z.re << " " << z.im << " ^ " << w.re;
}

TEST(ComplexPowers, OnAxesAndDiagonalsTurnByTheirAngle) {
  for (const double size : {1.0, 2.0, 0.7}) {
    for (const int re : {-1, 0, 1}) {
      for (const int im : {-1, 0, 1}) {
        if (re == 0 && im == 0) continue;
        for (const double w : {0.3, -0.3, 1.7, -12.625, 100.1, 0x1p-40, 0x1p12 + 0.75})
          expect_power({re * size, im * size}, {w, 0});
      }
    }
  }
}

// Of modulus one: an imaginary part of the exponent does not turn it.
TEST(ComplexPowers, OfUnitsTurnByTheirAngle) {
  for (const Point z : {Point{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    for (const double w : {0.3, -1.7, 3.0, 100.1}) expect_power(z, {w, 0.625});
  }
}

// -2 - 0i lies below the cut of the logarithm (C99 7.3.8.2 and annex G.6.3.2).
TEST(ComplexPowers, BelowTheNegativeAxisTurnTheOtherWay) {
  for (const double w : {0.3, -1.7, 0.5, 2.5}) expect_power({-2, -0.0}, {w, 0});
}

// Of a tiny exponent z^w is next to 1, and the imaginary part next to it by itself: the bits of each part are
// its own, and 2^-900 of the modulus is no error that is small beside it.
TEST(ComplexPowers, OfATinyExponentHaveAllBitsOfBothParts) {
  const WideExponentRange range;
  for (const Point z : {Point{3, 0.25}, {-0x1p-1000, 7}, {1 + 0x1p-40, 0x1p-30}, {0x1.8p900, -0x1p1000}}) {
    for (const Point w : {Point{0x1.4p-900, -0x1p-905}, {0x1p-1074, 0x1p-60}, {-0x1p-300, 0x1.6p-310}}) {
      const auto got = power(z, w);
      MpcValue want(bits + 1500);
      set_log_of_power(want, z, w);
      mpc_exp(want, want, MPC_RNDNN);
      MpfrValue difference(64), allowed(64);
      const auto expect_part = [&](const MpfrValue& part, mpfr_srcptr exact) {
        mpfr_sub(difference, part, exact, nearest);
        mpfr_mul_2si(allowed, exact, -bits, nearest);
        EXPECT_LE(mpfr_cmpabs(difference, allowed), 0) << z.re << " " << z.im << " ^ " << w.re << " " << w.im;
      };
      expect_part(got[0], mpc_realref(static_cast<mpc_ptr>(want)));
      expect_part(got[1], mpc_imagref(static_cast<mpc_ptr>(want)));
    }
  }
}

// Both are the correctly rounded ones, whichever way is taken.
TEST(SinhAndCosh, AreThoseOfMpfr) {
  for (const long precision : {24L, 85L, 213L, 700L}) {
    for (const long exponent : {-1000L, -400L, -120L, -60L, -43L, -20L, 0L, 8L}) {
      MpfrValue x(53), sh(precision), ch(precision), want(precision);
      mpfr_set_si_2exp(x, -12345, exponent - 14, nearest);
      oracle::sinh_and_cosh(sh, ch, x);
      mpfr_sinh(want, x, nearest);
      EXPECT_NE(mpfr_equal_p(sh, want), 0) << precision << " bits, 2^" << exponent;
      mpfr_cosh(want, x, nearest);
      EXPECT_NE(mpfr_equal_p(ch, want), 0) << precision << " bits, 2^" << exponent;
    }
  }
}

// `got` is `want`, or its neighbour where a rounding is close to a tie.
void expect_within_an_ulp(const MpfrValue& got, const MpfrValue& want, const char* what, double x, double y) {
  if (mpfr_equal_p(got, want) != 0) return;
  MpfrValue difference(64);
  mpfr_sub(difference, got, want, nearest);
  EXPECT_LE(mpfr_get_exp(difference.get()), mpfr_get_exp(want.get()) - mpfr_get_prec(want) + 1)
      << what << " of " << x << ", " << y << " in " << mpfr_get_prec(want);
}

// 6381956970095103 2^797 is the binary64 number closest to a multiple of pi/2 (Muller et al., Handbook of
// Floating-Point Arithmetic, section 10.2), 2^-60.9 from it; of the 113 and 400 bits of numbers next to a
// multiple of pi/2 far more than all are lost.
TEST(HugeAngles, HaveTheSinesOfMpfr) {
  const WideExponentRange range;
  int different = 0;
  int count = 0;
  const auto expect = [&](mpfr_srcptr x, long precision) {
    MpfrValue s(precision), c(precision), sine(precision), cosine(precision);
    oracle::sine_and_cosine(s, c, x);
    mpfr_sin_cos(sine, cosine, x, nearest);
    ++count;
    different += mpfr_equal_p(s, sine) == 0 || mpfr_equal_p(c, cosine) == 0 ? 1 : 0;
    expect_within_an_ulp(s, sine, "sine", mpfr_get_d(x, nearest), 0);
    expect_within_an_ulp(c, cosine, "cosine", mpfr_get_d(x, nearest), 0);
  };
  for (const long precision : {24L, 96L, 245L, 600L}) {
    for (const double mantissa :
         {1.0, -1.0, 0x1.6ac5b262ca1ffp0, -0x1.921fb54442d18p0, 0x1.fffffffffffffp0}) {
      for (const long exponent : {199L, 200L, 201L, 512L, 849L, 1023L, 1024L, 5003L, 16383L, 65536L}) {
        MpfrValue x(53);
        mpfr_set_d(x, mantissa, nearest);
        mpfr_mul_2si(x, x, exponent, nearest);
        expect(x, precision);
      }
    }
    for (const long bits_of_x : {113L, 400L, 900L}) {
      for (const unsigned long k : {1UL, 2UL, 3UL, 12345UL}) {
        // The number of these bits that is next to k 2^300 quarter turns.
        MpfrValue x(bits_of_x);
        mpfr_const_pi(x, nearest);
        mpfr_mul_ui(x, x, k, nearest);
        mpfr_mul_2si(x, x, 299, nearest);
        expect(x, precision);
      }
    }
  }
  EXPECT_LE(different, count / 20);
}

TEST(Arguments, AreThoseOfMpfrInEveryDirection) {
  const WideExponentRange range;
  int different = 0;
  int count = 0;
  for (const long precision : {24L, 117L, 300L, 1100L}) {
    for (const double x : {1.0, 0x1.3p-3, 0x1.921fb54442d18p9, 0x1p-1000, 0x1.8p1000}) {
      for (const double y :
           {1.0, 0x1.fffffffffffffp-1, 0x1.7p-5, 0x1.3p-18, 0x1p-19, 0x1.8p-21, 0x1p-400, 0x1.1p500}) {
        for (const double re : {x, -x}) {
          for (const double im : {x * y, -x * y}) {
            if (im == 0 || std::isinf(im)) continue;
            for (const bool turned : {false, true}) {
              MpfrValue a(53), b(53), got(precision), want(precision);
              mpfr_set_d(a, turned ? re : im, nearest);
              mpfr_set_d(b, turned ? im : re, nearest);
              oracle::angle_of(got, a, b);
              mpfr_atan2(want, a, b, nearest);
              ++count;
              different += mpfr_equal_p(got, want) == 0 ? 1 : 0;
              expect_within_an_ulp(got, want, "argument", re, im);
            }
          }
        }
      }
    }
  }
  EXPECT_GT(count, 1000);
  EXPECT_LE(different, count / 20);
}

// On both sides of where the first term of the series for large arguments takes over, in either sign.
// J_order(mantissa 2^exponent) against MPFR's.
void expect_bessel(long precision, long order, double mantissa, long exponent) {
  std::vector<MpfrValue> args, got;
  for (int i = 0; i < 2; ++i) args.emplace_back(64);
  mpfr_set_si(args[0], order, nearest);
  mpfr_set_d(args[1], mantissa, nearest);
  mpfr_mul_2si(args[1], args[1], exponent, nearest);
  got.emplace_back(precision);
  exact_value(info_of(FunctionId::cyl_bessel_j), args, got);
  MpfrValue want(precision);
  mpfr_jn(want, order, args[1], nearest);
  expect_within_an_ulp(got[0], want, "Bessel function", mantissa, static_cast<double>(exponent));
}

TEST(BesselFunctions, OfHugeArgumentsAreThoseOfMpfr) {
  const WideExponentRange range;
  for (const long precision : {24L, 96L, 256L})
    for (const long order : {0L, 1L, 2L, 3L, 10L, 100L})
      for (const double mantissa : {1.25, -0x1.921fb54442d18p0})
        for (const long exponent : {400L, 452L, 460L, 700L, 702L, 720L, 4000L})
          expect_bessel(precision, order, mantissa, exponent);
}

// Where the terms cancel, next to zeros, and where the series takes over from MPFR.
TEST(BesselFunctions, OfModerateArgumentsAreThoseOfMpfr) {
  const WideExponentRange range;
  for (const long precision : {24L, 96L, 256L})
    for (const long order : {0L, 1L, 10L, 40L, 100L, 1000L})
      for (const double x :
           {0x1p-900, -0.3, 2.404825557695773, 20.0, -49.9, 50.1, 65.3, 79.9, 80.1, 199.0, 1500.0})
        expect_bessel(precision, order, x, 0);
}

// Numbers of every size, next to 1 and to what tables are made of.
TEST(Logarithms, AreThoseOfMpfr) {
  const WideExponentRange range;
  std::vector<double> list;
  for (const double x :
       {1.0, 2.0 / 3, 4.0 / 3, 1 + 0x1p-9, 1 - 0x1p-16, 1 + 0x1p-24, 1.5, 0.7, 1.9999, 257.0 / 256})
    for (const double factor : {1 + 0x1p-52, 1 - 0x1p-40, 1 + 0x1p-26, 0x1.8p-900, 0x1.23456789p77})
      list.push_back(x * factor);
  for (const long precision : {60L, 1100L, 150L, 400L}) {
    for (const double x : list) {
      MpfrValue argument(53), got(precision), want(precision);
      mpfr_set_d(argument, x, nearest);
      oracle::logarithm_of(got, argument);
      mpfr_log(want, argument, nearest);
      expect_within_an_ulp(got, want, "logarithm", x, static_cast<double>(precision));
    }
  }
}

// Parts at few bits are those at many, next to the poles, the equator and zeros of P_2 and P_3 as well, where
// the bound of the recurrence's errors asks for more bits.
TEST(SphericalHarmonics, AtFewBitsAreThoseAtMany) {
  const WideExponentRange range;
  const auto parts = [](long n, long m, double theta, long precision) {
    std::vector<MpfrValue> args, out;
    for (int i = 0; i < 4; ++i) args.emplace_back(53);
    mpfr_set_si(args[0], n, nearest);
    mpfr_set_si(args[1], m, nearest);
    mpfr_set_d(args[2], theta, nearest);
    mpfr_set_d(args[3], 0.7, nearest);
    for (int i = 0; i < 2; ++i) out.emplace_back(precision);
    exact_value(info_of(FunctionId::spherical_harmonic), args, out);
    return out;
  };
  for (const long n : {0L, 1L, 2L, 3L, 7L, 40L, 100L}) {
    for (const long m : {0L, 1L, -2L, 7L, 39L, -100L}) {
      if (std::labs(m) > n) continue;
      for (const double theta : {0x1p-300, 0x1p-20, 0.3, std::acos(std::sqrt(1.0 / 3)),
                                 std::acos(std::sqrt(0.6)), 1.5, 0x1.921fb54442d18p0, 0x1.921fb54442d18p1}) {
        const auto many = parts(n, m, theta, 2000);
        for (const long precision : {56L, 96L, 245L}) {
          const auto few = parts(n, m, theta, precision);
          for (std::size_t part = 0; part < 2; ++part) {
            MpfrValue want(precision);
            mpfr_set(want, many[part], nearest);
            expect_within_an_ulp(few[part], want, "spherical harmonic", static_cast<double>(n),
                                 static_cast<double>(m));
          }
        }
      }
    }
  }
}

// Beyond MPFR's range signs are all that is left of the parts.  Next to the negative axis an even Re(w) turns
// back to next to the real axis: the sine of the angle has lost hundreds of bits.
TEST(ComplexPowers, BeyondTheRangeKeepTheirSigns) {
  constexpr mpfr_prec_t enough = 6000;
  int close = 0;
  for (const int exponent : {200, 400, 752, 1000}) {
    for (const int apart : {-1100, -700, -300}) {
      for (const double growth : {0x1.3p-640, -0x1.3p-640}) {
        const Point z{-0x1.5ae9cc006af72p+100, std::ldexp(0x1.1cd6bbfb6e49p+0, std::max(apart + 100, -1000))};
        const Point w{std::ldexp(0x1.4ac7a5741bab3p+0, exponent), growth};
        const auto got = power(z, w);
        MpcValue log_power(enough);
        set_log_of_power(log_power, z, w);
        MpfrValue sine(64), cosine(64);
        mpfr_sin_cos(sine, cosine, mpc_imagref(static_cast<mpc_ptr>(log_power)), nearest);
        close += mpfr_get_exp(sine) < -120 ? 1 : 0;
        EXPECT_FALSE(mpfr_regular_p(got[0].get())) << exponent;
        EXPECT_EQ(mpfr_signbit(got[0].get()), mpfr_signbit(cosine)) << exponent << ' ' << apart;
        EXPECT_EQ(mpfr_signbit(got[1].get()), mpfr_signbit(sine)) << exponent << ' ' << apart;
      }
    }
  }
  EXPECT_GE(close, 6);
}

// ln|z| of (2^-149, -1) is 2^-299.
TEST(ComplexPowers, NextToTheUnitCircleHaveAnAngle) {
  const auto far = power({0x1p-149, -1}, {0, 0x1p127});
  EXPECT_GT(mpfr_sgn(far[0].get()), 0);
  EXPECT_TRUE(mpfr_inf_p(far[0].get()));
  EXPECT_GT(mpfr_sgn(far[1].get()), 0);
  EXPECT_TRUE(mpfr_inf_p(far[1].get()));
  for (const Point z :
       {Point{1, 0x1p-200}, {0x1.fffffffffffffp-1, 0x1p-27}, {0.6, 0.8}, {-0.6, 0x1.999999999999ap-1}})
    for (const Point w : {Point{0.5, 3}, {1, 0x1p60}, {-2.5, -0x1p-30}}) expect_power(z, w);
}

// Exact powers of exponents that large would have more digits than there is memory: none may be looked for.
TEST(ComplexPowers, OfHugeRealExponentsEnd) {
  for (const double w : {0x1p60, -0x1p60, 0x1p40 + 0.5, 0x1.8p30}) expect_power({1.5, 0.3}, {w, 0});
}

TEST(ComplexPowers, OfComplexExponentsWithAHalfIntegerEnd) {
  for (const Point w : {Point{1, 0.3}, {2.5, -7}, {0, 0.1}}) expect_power({1.5, 0.3}, w);
}

// The rule of step pi/a serves arguments away from a alone, and a^2 is an integer times ln 2, for a step that
// makes its error e^(-a^2) some number of bits.
TEST(ErrorFunctions, NextToThePoleOfTheRuleAreThoseOfMpfr) {
  int by_rule = 0;
  for (const long precision : {24L, 53L, 64L, 113L, 150L, 239L, 400L}) {
    for (long n = precision; n < precision + 100; ++n) {
      const double pole = std::sqrt(static_cast<double>(n) * std::log(2.0));
      for (const double x : {pole, pole * (1 + 0x1p-30), pole * (1 - 0x1p-14)}) {
        MpfrValue argument(53), got(precision), want(precision);
        mpfr_set_d(argument, x, nearest);
        const auto rounding = oracle::complementary_error_function(got, argument);
        by_rule += rounding.method == oracle::Method::formula ? 1 : 0;
        const int ternary = mpfr_erfc(want, argument, nearest);
        EXPECT_NE(mpfr_equal_p(got, want), 0) << "erfc " << x << " in " << precision;
        EXPECT_EQ(rounding.ternary > 0, ternary > 0) << "erfc " << x << " in " << precision;
      }
    }
  }
  EXPECT_GT(by_rule, 2000);
}

}  // namespace
}  // namespace ulpgate
