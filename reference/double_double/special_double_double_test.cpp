// Tests of recurrences, leading terms and far exponents in double-double: MPFR finds none beyond its bound,
// and next to none gives up.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "reference/double_double/double_double_functions.hpp"
#include "reference/lanes/levels.hpp"
#include "reference/oracle/oracle.hpp"

namespace ulpgate {
namespace {

using Doubles = std::vector<double>;

class Words {
 public:
  // Of [low, high).
  double on(double low, double high) { return low + (high - low) * unit(); }
  double integer(int low, int high) {
    return low + static_cast<double>(words_() % static_cast<unsigned>(high - low + 1));
  }
  double of_exponents(int low, int high) {
    const double x = std::ldexp(1 + unit(), static_cast<int>(integer(low, high)));
    return words_() % 2 == 0 ? x : -x;
  }

 private:
  double unit() { return static_cast<double>(words_() >> 11U) * 0x1p-53; }
  std::mt19937_64 words_{5};
};

struct Parts {
  std::array<DoubleDouble, 2> values;
  std::array<double, 2> bounds{};
  [[nodiscard]] bool is_known(std::size_t parts) const {
    return bounds[0] >= 0 && (parts == 1 || bounds[1] >= 0);
  }
};

Parts parts_of(FunctionId id, const Doubles& x, std::size_t level, int argument_bits = 53) {
  const std::vector<DoubleDouble> args(x.begin(), x.end());
  Parts p;
  double_double_function(id, level)(args.data(), p.values.data(), p.bounds.data(), 1, argument_bits);
  return p;
}

// Holds what is known of both parts to MPFR, in ulp of 2^-99; a zero or an infinity to what it stands for.
void expect_within_bounds(const Parts& p, std::size_t parts, const std::vector<MpfrValue>& exact) {
  MpfrValue difference(1200);
  for (std::size_t part = 0; part < parts; ++part) {
    const DoubleDouble value = p.values[part];
    const double bound = p.bounds[part];
    mpfr_srcptr x = exact[part];
    if (bound < 0) continue;
    if (value.hi == 0 && bound == 0) {
      EXPECT_TRUE(mpfr_zero_p(x));
    } else if (value.hi == 0) {
      EXPECT_EQ(std::signbit(value.hi), mpfr_signbit(x) != 0);
      EXPECT_TRUE(mpfr_regular_p(x) != 0 && mpfr_get_exp(x) < (bound == 2 ? -20000 : -1100));
    } else if (std::isinf(value.hi)) {
      EXPECT_EQ(value.hi < 0, mpfr_sgn(x) < 0);
      EXPECT_TRUE(mpfr_inf_p(x) != 0 || mpfr_get_exp(x) > (bound == 2 ? 20000 : 1024));
    } else {
      mpfr_sub_d(difference, x, value.hi, MPFR_RNDN);
      mpfr_sub_d(difference, difference, value.lo, MPFR_RNDN);
      mpfr_mul_2si(difference, difference, double_double_bits - 1 - std::ilogb(value.hi), MPFR_RNDN);
      EXPECT_LE(std::fabs(mpfr_get_d(difference, MPFR_RNDA)), bound);
    }
  }
}

// How many of `points` are known on every processor with bounds up to `most`, all of them held to MPFR.
std::size_t count_known(FunctionId id, const std::vector<Doubles>& points, double most) {
  const WideExponentRange wide;
  const FunctionInfo& f = info_of(id);
  const auto parts = static_cast<std::size_t>(f.parts);
  std::vector<MpfrValue> exact;
  for (std::size_t part = 0; part < parts; ++part) exact.emplace_back(1200);  // as 1 - 2^1000 has
  std::size_t known = 0;
  for (const Doubles& x : points) {
    std::vector<MpfrValue> args;
    for (const double a : x) mpfr_set_d(args.emplace_back(53), a, MPFR_RNDN);
    exact_value(f, args, exact);
    bool by_all = true;
    for (std::size_t level = 0; level < instruction_levels(); ++level) {
      const Parts p = parts_of(id, x, level);
      expect_within_bounds(p, parts, exact);
      by_all = by_all && p.is_known(parts) && p.bounds[0] <= most && (parts == 1 || p.bounds[1] <= most);
    }
    known += by_all ? 1 : 0;
    if (::testing::Test::HasFailure()) {
      ADD_FAILURE() << f.name << ' ' << std::hexfloat << x[0] << ' ' << x[1] << ' '
                    << (x.size() > 2 ? x[2] : 0);
      break;
    }
  }
  return known;
}

// Bounds that are only passed on from step to step grow by 2^1.3 a step.
TEST(DoubleDoubleRecurrences, StaySharpOverAHundredSteps) {
  Words words;
  constexpr std::size_t count = 400;
  std::vector<Doubles> laguerre;
  std::vector<Doubles> harmonics;
  std::vector<Doubles> bessel;
  for (std::size_t i = 0; i < count; ++i) {
    laguerre.push_back({words.integer(60, 150), words.integer(0, 100), words.on(0, 100)});
    harmonics.push_back({words.integer(80, 150), words.integer(-9, 9), words.on(0, 0.5), words.on(0, 6)});
    if (i % 2 == 0) harmonics.back()[2] += 2.6;
    const double n = words.integer(60, 150);
    bessel.push_back({n, words.on(0.9 * n, 1.1 * n)});
  }
  EXPECT_GT(count_known(FunctionId::laguerre, laguerre, 0x1p30), count * 98 / 100);
  EXPECT_GT(count_known(FunctionId::spherical_harmonic, harmonics, 0x1p30), count * 95 / 100);
  EXPECT_GT(count_known(FunctionId::cyl_bessel_j, bessel, 0x1p30), count * 95 / 100);
}

TEST(DoubleDoubleRecurrences, LaguerrePolynomialsOfHugeNumbersAreTheirLastTerm) {
  Words words;
  constexpr std::size_t count = 600;
  std::vector<Doubles> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double n = words.integer(i % 3 == 0 ? 1 : 2, i % 3 == 0 ? 6 : 100);
    points.push_back(
        {n, words.integer(0, 100), words.of_exponents(i % 2 == 0 ? 10 : 140, i % 2 == 0 ? 60 : 990)});
  }
  EXPECT_GT(count_known(FunctionId::laguerre, points, 200), count * 90 / 100);
  std::size_t infinite = 0;
  for (const Doubles& x : points)
    infinite += std::isinf(parts_of(FunctionId::laguerre, x, 0).values[0].hi) ? 1 : 0;
  EXPECT_GT(infinite, count / 2);
  EXPECT_LT(infinite, count * 95 / 100);
}

TEST(DoubleDoubleRecurrences, LaguerrePolynomialsOfDegree0And1AreExact) {
  for (const double x : {0x1p-700, -0.1, 3.0, 81.0, 0x1.8p300}) {
    const Parts constant = parts_of(FunctionId::laguerre, {0, 7, x}, 0);
    EXPECT_EQ(constant.bounds[0], 0);
    EXPECT_EQ(constant.values[0], DoubleDouble(1));
    const Parts linear = parts_of(FunctionId::laguerre, {1, 80, x}, 0);
    EXPECT_EQ(linear.bounds[0], 0);
    EXPECT_EQ((linear.values[0] - DoubleDouble(81)).hi, -x);
  }
}

// No argument of theirs has anything to do with it, not one beyond double either.
TEST(DoubleDoubleRecurrences, SphericalHarmonicsWithoutAPolynomialAre0) {
  for (const int argument_bits : {53, 64}) {
    const Parts p = parts_of(FunctionId::spherical_harmonic, {3, -4, 0.5, 0}, 0, argument_bits);
    for (std::size_t part = 0; part < 2; ++part) {
      EXPECT_EQ(p.values[part].hi, 0);
      EXPECT_EQ(p.bounds[part], 0) << argument_bits;
    }
  }
  // 0 of the other kind: sin(m phi), phi beyond double.
  EXPECT_LT(parts_of(FunctionId::spherical_harmonic, {4, 3, 0.5, 0}, 0, 64).bounds[1], 0);
}

// Numbers of all of double's exponents.
TEST(DoubleDoubleFarExponents, ArgumentsAndRootsAndLogarithmsAreKnown) {
  Words words;
  constexpr std::size_t count = 1500;
  std::vector<Doubles> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back({words.of_exponents(-1074, 1023), words.of_exponents(-1074, 1023)});
    if (i % 3 == 0) points.back() = {words.of_exponents(-1074, -700), words.of_exponents(-1074, -700)};
  }
  for (const FunctionId id : {FunctionId::clog, FunctionId::clog10, FunctionId::csqrt, FunctionId::carg})
    EXPECT_GT(count_known(id, points, 0x1p20), count * 85 / 100) << info_of(id).name;
  // Beyond 2^1000 double has no room for the modulus, below 2^-960 no bits, and so for half of the norms.
  EXPECT_GT(count_known(FunctionId::cabs, points, 4), count * 60 / 100);
  EXPECT_GT(count_known(FunctionId::cnorm, points, 4), count * 25 / 100);
}

// Products below 2^-2300 are told as zeros that are none, above 2^2300 as infinities.
TEST(DoubleDoubleFarExponents, PartsFarBeyondDoubleAreTold) {
  const WideExponentRange wide;
  const std::vector<Doubles> points = {{40, -0x1p-600}, {80, -0x1p-700}, {100, 0x1p-100}};
  for (const Doubles& bessel : points) {
    std::vector<MpfrValue> args;
    for (const double a : bessel) mpfr_set_d(args.emplace_back(53), a, MPFR_RNDN);
    std::vector<MpfrValue> exact;
    exact.emplace_back(600);
    exact_value(info_of(FunctionId::cyl_bessel_j), args, exact);
    for (std::size_t level = 0; level < instruction_levels(); ++level) {
      const Parts p = parts_of(FunctionId::cyl_bessel_j, bessel, level);
      EXPECT_EQ(p.values[0].hi, 0);
      EXPECT_GE(p.bounds[0], 1);
      expect_within_bounds(p, 1, exact);
    }
  }
}

// At numbers that double has not, special functions are told from numbers nearer to 1.
TEST(DoubleDoubleFarExponents, SpecialFunctionsOfNumbersBeyondDoubleAreKnown) {
  if (std::numeric_limits<long double>::digits != 64) GTEST_SKIP() << "long double is another type here";
  const WideExponentRange wide;
  Words words;
  using Point = std::vector<long double>;
  const auto scaled = [&](int low, int high) {
    return std::ldexp(static_cast<long double>(words.of_exponents(0, 0)),
                      static_cast<int>(words.integer(low, high)));
  };
  const auto hold = [&](FunctionId id, const Point& x) {
    const FunctionInfo& f = info_of(id);
    std::vector<MpfrValue> args;
    for (const long double a : x) mpfr_set_ld(args.emplace_back(64), a, MPFR_RNDN);
    std::vector<MpfrValue> exact;
    exact.reserve(static_cast<std::size_t>(f.parts));
    for (int part = 0; part < f.parts; ++part) exact.emplace_back(200);
    exact_value(f, args, exact);
    std::array<long double, 2> values{};
    std::array<double, 2> bounds{};
    extended_function<long double>(id)(x.data(), values.data(), bounds.data(), 1, 64);
    for (std::size_t part = 0; part < exact.size(); ++part) {
      mpfr_srcptr e = exact[part];
      ASSERT_GE(bounds[part], 0) << f.name << ' ' << static_cast<double>(x[0]);
      ASSERT_TRUE(mpfr_zero_p(e) != 0 || std::signbit(values[part]) == (mpfr_signbit(e) != 0)) << f.name;
      if (bounds[part] == 0) {
        ASSERT_TRUE(mpfr_zero_p(e) != 0 && values[part] == 0) << f.name;
      } else if (values[part] == 0) {
        ASSERT_TRUE(bounds[part] == 2 && (mpfr_zero_p(e) != 0 || mpfr_get_exp(e) < -20000)) << f.name;
      } else if (std::isinf(values[part])) {
        ASSERT_TRUE(bounds[part] == 2 && (mpfr_inf_p(e) != 0 || mpfr_get_exp(e) > 20000)) << f.name;
      } else {
        MpfrValue difference(200);
        mpfr_set_ld(difference, values[part], MPFR_RNDN);
        mpfr_sub(difference, difference, e, MPFR_RNDN);
        mpfr_div(difference, difference, e, MPFR_RNDN);
        ASSERT_LE(std::fabs(mpfr_get_d(difference, MPFR_RNDA)), std::ldexp(bounds[part], -63)) << f.name;
      }
    }
  };
  for (int i = 0; i < 300; ++i) {
    const auto n = static_cast<long double>(words.integer(0, i % 2 == 0 ? 3 : 100));
    const auto m = static_cast<long double>(words.integer(0, 100));
    // Between 2^-16300 and 2^-25000 nothing is told, nor beyond.
    const int least = i % 2 == 0 ? -5000 : -16440;
    const long double tiny = scaled(least, -1000);
    if (std::ilogb(tiny) * n > -16000 || std::ilogb(tiny) * n < -26000)
      hold(FunctionId::cyl_bessel_j, {n, tiny});
    hold(FunctionId::laguerre, {n, m, tiny});
    const long double huge = scaled(1000, -least - 100);
    if (std::ilogb(huge) * n < 16000 || std::ilogb(huge) * n > 26000)
      hold(FunctionId::laguerre, {n, m, huge});
    const long double order = words.integer(0, 1) == 0 ? n : -n;
    if (std::ilogb(tiny) * n > -8000 || std::ilogb(tiny) * n < -26000) {
      const long double phi = i % 3 == 0 ? 1.25L : scaled(-8000, -1000);
      hold(FunctionId::spherical_harmonic, {n + 7, order, tiny, phi});
    }
  }
}

// A part that is small beside the other one has an angle next to a multiple of pi/2, whose error it sees.
TEST(DoubleDoubleFarExponents, PowersKeepTheirSmallerPart) {
  Words words;
  constexpr std::size_t count = 500;
  std::vector<Doubles> points;
  for (std::size_t i = 0; i < count; ++i) {
    Doubles& x = points.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) x.push_back(words.on(-100, 100));
  }
  EXPECT_GT(count_known(FunctionId::cpow, points, 0x1p40), count * 80 / 100);
}

}  // namespace
}  // namespace ulpgate
