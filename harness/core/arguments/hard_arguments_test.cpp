// Tests of the hard arguments: each list holds what it claims, next to what it claims, in every format.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "harness/core/arguments/argument_lists.hpp"
#include "reference/oracle/oracle.hpp"
#include "reference/types/exchange.hpp"
#include "reference/types/rounding.hpp"

namespace ulpgate {
namespace {

const std::vector<FloatFormat>& formats() {
  static const std::vector<FloatFormat> all = {float_format<float>(), float_format<double>(),
                                               float_format<MpfrReal<62>>()};
  return all;
}

MpfrValue copied(const MpfrValue& x) {
  MpfrValue v(mpfr_get_prec(x.get()));
  mpfr_set(v, x, MPFR_RNDN);
  return v;
}

bool holds(const ArgumentList& list, std::size_t argument, mpfr_srcptr x) {
  for (const auto& point : list) {
    if (mpfr_equal_p(point[argument].get(), x)) return true;
  }
  return false;
}

MpfrValue value_at(const FunctionInfo& f, std::vector<MpfrValue>& at, long bits = 64) {
  std::vector<MpfrValue> y;
  y.emplace_back(bits);
  exact_value(f, at, y);
  return std::move(y[0]);
}

// The exact value lies in the binade of 2^exponent or beyond.
bool reaches(const FunctionInfo& f, const MpfrValue& x, long exponent) {
  std::vector<MpfrValue> at;
  at.push_back(copied(x));
  const MpfrValue y = value_at(f, at);
  if (mpfr_inf_p(y.get())) return true;
  return !mpfr_zero_p(y.get()) && binade(y) >= exponent;
}

// The list holds two neighbours of the format between which |f| begins to reach 2^exponent.
bool holds_crossing(const FunctionInfo& f, const FloatFormat& format, const ArgumentList& list, int sign,
                    long exponent) {
  const WideExponentRange wide;
  for (const auto& point : list) {
    if (mpfr_sgn(point[0].get()) != sign) continue;
    MpfrValue next = copied(point[0]);
    step_in_format(next, 1, format);
    if (!mpfr_number_p(next) || !holds(list, 0, next)) continue;
    if (reaches(f, point[0], exponent) != reaches(f, next, exponent)) return true;
  }
  return false;
}

TEST(HardArguments, EndTheRangeBetweenNeighbours) {
  using enum FunctionId;
  for (const FloatFormat& format : formats()) {
    const long overflow = format.exponent_max + 1;
    for (const auto id : {exp, exp2, expm1, sinh, cosh}) {
      const FunctionInfo& f = info_of(id);
      EXPECT_TRUE(holds_crossing(f, format, hard_arguments(f, format), 1, overflow))
          << f.name << " " << format.precision;
    }
    for (const auto id : {sinh, cosh}) {
      const FunctionInfo& f = info_of(id);
      EXPECT_TRUE(holds_crossing(f, format, hard_arguments(f, format), -1, overflow)) << f.name;
    }
    for (const long exponent : {format.exponent_min, format.exponent_least(), format.exponent_least() - 1}) {
      for (const auto id : {exp, exp2, erfc}) {
        const FunctionInfo& f = info_of(id);
        EXPECT_TRUE(holds_crossing(f, format, hard_arguments(f, format), id == erfc ? 1 : -1, exponent))
            << f.name << " " << format.precision << " 2^" << exponent;
      }
    }
    if (format.exponent_max > 16383) continue;
    const FunctionInfo& f = info_of(tgamma);
    EXPECT_TRUE(holds_crossing(f, format, hard_arguments(f, format), 1, overflow)) << format.precision;
  }
}

TEST(HardArguments, ComeNearOneByEveryPowerOfTwo) {
  for (const FloatFormat& format : formats()) {
    for (const auto& f : all_functions()) {
      const bool gamma = f.hard == HardFamily::gamma;
      if (f.hard != HardFamily::unit && f.hard != HardFamily::range && !gamma) continue;
      const auto list = hard_arguments(f, format);
      for (const long centre : {1L, 2L}) {
        if (centre == 2 && !gamma) continue;
        for (long j = 1; j <= format.precision - centre + 1; ++j) {
          MpfrValue x(format.precision + 2);
          mpfr_set_si_2exp(x, -1, -j, MPFR_RNDN);
          mpfr_add_si(x, x, centre, MPFR_RNDN);
          ASSERT_TRUE(holds(list, 0, x)) << f.name << " " << centre << " - 2^-" << j;
          if (j > format.precision - centre) continue;
          mpfr_set_si_2exp(x, 1, -j, MPFR_RNDN);
          mpfr_add_si(x, x, centre, MPFR_RNDN);
          ASSERT_TRUE(holds(list, 0, x)) << f.name << " " << centre << " + 2^-" << j;
        }
      }
    }
  }
}

TEST(HardArguments, ComeNearThePolesOfGammaFromBothSides) {
  const FunctionInfo& f = info_of(FunctionId::tgamma);
  for (const FloatFormat& format : formats()) {
    const auto list = hard_arguments(f, format);
    for (long n = 0; n <= 30; ++n) {
      for (const int sign : {1, -1}) {
        MpfrValue best(64);
        mpfr_set_si(best, 1, MPFR_RNDN);
        for (const auto& point : list) {
          MpfrValue distance(4 * format.precision);
          mpfr_add_si(distance, point[0], n, MPFR_RNDN);
          if (mpfr_sgn(distance.get()) == sign && mpfr_cmpabs(distance, best) < 0)
            mpfr_set(best, distance, MPFR_RNDN);
        }
        // Steps of three binades; next to n > 0 the format itself ends them.
        const long widest = -(format.precision - 8 - (n > 0 ? std::ilogb(n) : 0));
        EXPECT_LE(binade(best), widest) << format.precision << " pole " << -n << " side " << sign;
      }
    }
  }
}

// Distance from m alpha to the nearest integer, as a fraction of 2^128.
using Fraction = unsigned __int128;
Fraction to_integer(Fraction x) {
  return std::min(x, ~x + 1);
}
// The fraction of 2^exponent * 2/pi.
Fraction fraction_of_two_over_pi(long exponent) {
  MpfrValue v(600);
  mpfr_const_pi(v, MPFR_RNDN);
  mpfr_ui_div(v, 2, v, MPFR_RNDN);
  mpfr_mul_2si(v, v, exponent, MPFR_RNDN);
  Fraction fraction = 0;
  for (int word = 0; word < 4; ++word) {
    mpfr_frac(v, v, MPFR_RNDN);
    mpfr_mul_2ui(v, v, 32, MPFR_RNDN);
    fraction = (fraction << 32U) | mpfr_get_ui(v, MPFR_RNDD);
  }
  return fraction;
}

TEST(HardArguments, NoFloatOfABinadeIsMuchNearerToAMultipleOfHalfPi) {
  const auto list = nearest_to_multiples_of_half_pi(float_format<float>(), 127);
  ASSERT_EQ(list.size(), 3U * 128U);
  int nearest = 0;
  int binades = 0;
  for (long e = 0; e <= 127; e += 9) {
    const Fraction alpha = fraction_of_two_over_pi(e - 23);
    Fraction best = ~Fraction(0);
    Fraction x = alpha << 23U;
    for (std::uint32_t m = 1U << 23U; m < 1U << 24U; ++m, x += alpha) best = std::min(best, to_integer(x));
    Fraction mine = ~Fraction(0);
    for (std::size_t k = 0; k < 3; ++k) {
      const MpfrValue& v = list[3 * static_cast<std::size_t>(e) + k];
      const float y = std::ldexp(mpfr_get_flt(v.get(), MPFR_RNDN), static_cast<int>(23 - e));
      if (binade(v) != e) continue;
      mine = std::min(mine, to_integer(alpha * static_cast<std::uint32_t>(y)));
    }
    // Powers of two times a smaller number stand for its other multiples, of which one may be somewhat
    // nearer.
    EXPECT_LT(static_cast<double>(mine), 1.7 * static_cast<double>(best)) << e;
    nearest += mine == best ? 1 : 0;
    ++binades;
  }
  EXPECT_GE(nearest, binades - 1);
}

TEST(HardArguments, OfTrigonometricFunctionsReachTheLastBinade) {
  for (const auto id : {FunctionId::sin, FunctionId::cos, FunctionId::tan}) {
    for (const FloatFormat& format : formats()) {
      const long last = format.subnormals ? format.exponent_max : 1023;
      const auto list = hard_arguments(info_of(id), format);
      ASSERT_EQ(list.size(), 3U * static_cast<std::size_t>(last + 1));
      for (std::size_t i = 0; i < list.size(); ++i) {
        const auto e = static_cast<long>(i / 3);
        // An intermediate fraction that would need one bit more is the convergent before it, in a lower
        // binade.
        ASSERT_TRUE(i % 3 == 2 ? binade(list[i][0]) <= e : binade(list[i][0]) == e)
            << format.precision << " " << i;
      }
      if (id != FunctionId::sin) continue;
      // Some argument of each list is nearer to a multiple than chance would have it in one binade.
      double least = 1;
      for (const auto& point : list) {
        MpfrValue s(64);
        MpfrValue c(64);
        mpfr_sin_cos(s, c, point[0], MPFR_RNDN);
        least = std::min({least, std::fabs(mpfr_get_d(s, MPFR_RNDN)), std::fabs(mpfr_get_d(c, MPFR_RNDN))});
      }
      EXPECT_LT(least, std::ldexp(1.0, static_cast<int>(-format.precision - 4))) << format.precision;
    }
  }
}

TEST(HardArguments, EncloseTheZerosOfBesselFunctions) {
  const FunctionInfo& f = info_of(FunctionId::cyl_bessel_j);
  for (const FloatFormat& format : {float_format<float>(), float_format<double>()}) {
    const auto list = hard_arguments(f, format);
    // Zeros of J0, J1, J2, J5, J20 and J60 in (0.5, 100), three points and their mirror images each.
    EXPECT_EQ(list.size(), 6U * (32 + 31 + 31 + 29 + 22 + 8));
    for (std::size_t i = 0; i + 5 < list.size(); i += 6) {
      const auto& below = list[i];
      const auto& above = list[i + 4];
      ASSERT_LT(mpfr_cmp(below[1], above[1]), 0);
      int signs = 1;
      for (const auto* point : {&below, &above}) {
        std::vector<MpfrValue> at;
        at.push_back(copied((*point)[0]));
        at.push_back(copied((*point)[1]));
        signs *= mpfr_sgn(value_at(f, at).get());
      }
      EXPECT_EQ(signs, -1) << mpfr_get_d(below[0], MPFR_RNDN) << " " << mpfr_get_d(below[1], MPFR_RNDN);
    }
  }
}

TEST(HardArguments, PowersEndTheRangeBetweenNeighbours) {
  const FunctionInfo& f = info_of(FunctionId::pow);
  for (const FloatFormat& format : formats()) {
    const auto list = hard_arguments(f, format);
    for (const long i : {2L, 3L, 5L, 7L, 10L, 11L, 97L, 1009L}) {
      for (const long target : {format.exponent_max + 1, format.exponent_min, format.exponent_least() - 1}) {
        const WideExponentRange wide;
        int below = 0;
        int beyond = 0;
        for (const auto& [x, y] : [&] {
               std::vector<std::pair<const MpfrValue*, const MpfrValue*>> pairs;
               for (const auto& p : list) pairs.emplace_back(&p[0], &p[1]);
               return pairs;
             }()) {
          if (mpfr_cmp_si(*x, i) != 0) continue;
          // y log2 x - target, against two spacings of y.
          MpfrValue t(format.precision + 64);
          MpfrValue slack(64);
          mpfr_log2(t, *x, MPFR_RNDN);
          mpfr_set(slack, t, MPFR_RNDN);
          mpfr_mul_2si(slack, slack, binade(*y) - format.precision + 4, MPFR_RNDN);
          mpfr_mul(t, t, *y, MPFR_RNDN);
          mpfr_sub_si(t, t, target, MPFR_RNDN);
          if (mpfr_cmpabs(t, slack) > 0) continue;
          (mpfr_sgn(t.get()) < 0 ? below : beyond) += 1;
        }
        EXPECT_EQ(below + beyond, 5) << i << "^y at 2^" << target << " in " << format.precision;
        EXPECT_GE(below, 2);
        EXPECT_GE(beyond, 2);
      }
    }
    // (1 +- 2^-j)^y up to where the exponent of the result is a large part of the range.
    for (const int side : {1, -1}) {
      MpfrValue largest(64);
      mpfr_set_zero(largest, 1);
      for (const auto& p : list) {
        MpfrValue t(format.precision + 64);
        mpfr_sub_ui(t, p[0], 1, MPFR_RNDN);
        mpfr_mul(t, t, p[1], MPFR_RNDN);
        if (mpfr_cmp_d(p[0], 0.4) < 0 || mpfr_cmp_d(p[0], 1.6) > 0 || mpfr_sgn(t.get()) != side) continue;
        if (mpfr_cmpabs(t, largest) > 0) mpfr_set(largest, t, MPFR_RNDN);
      }
      EXPECT_GE(binade(largest), std::ilogb(std::min(format.exponent_max, 16383L)) - 2) << format.precision;
    }
  }
}

}  // namespace
}  // namespace ulpgate
