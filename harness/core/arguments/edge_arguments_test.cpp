// Tests of the edges: which special values, ends and corners the list of a function holds in every format.
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "harness/core/arguments/argument_lists.hpp"
#include "reference/types/exchange.hpp"
#include "reference/types/rounding.hpp"

namespace ulpgate {
namespace {

const std::vector<FloatFormat>& formats() {
  static const std::vector<FloatFormat> all = {float_format<float>(), float_format<double>(),
                                               float_format<MpfrReal<62>>()};
  return all;
}

bool same(mpfr_srcptr a, mpfr_srcptr b) {
  if (mpfr_nan_p(a) || mpfr_nan_p(b)) return mpfr_nan_p(a) && mpfr_nan_p(b);
  return mpfr_equal_p(a, b) && (mpfr_signbit(a) != 0) == (mpfr_signbit(b) != 0);
}

bool holds(const ArgumentList& list, std::size_t argument, mpfr_srcptr x) {
  return std::any_of(list.begin(), list.end(), [&](const auto& p) { return same(p[argument], x); });
}

// m 2^exponent and what lies `steps` away in the format.
MpfrValue value_of(const FloatFormat& format, long m, long exponent, long steps = 0) {
  MpfrValue v(std::max(64L, format.precision));
  mpfr_set_si_2exp(v, m, exponent, MPFR_RNDN);
  step_in_format(v, steps, format);
  return v;
}

MpfrValue largest_of(const FloatFormat& format) {
  MpfrValue v(format.precision);
  mpfr_set_ui_2exp(v, 1, format.exponent_max, MPFR_RNDN);
  MpfrValue rest(format.precision);
  mpfr_set_ui_2exp(rest, 1, format.exponent_max - (format.precision - 1), MPFR_RNDN);
  mpfr_sub(rest, v, rest, MPFR_RNDN);
  mpfr_add(v, v, rest, MPFR_RNDN);
  return v;
}

std::set<std::string> texts(const ArgumentList& list, std::size_t argument) {
  std::set<std::string> found;
  for (const auto& point : list) {
    char text[64];
    mpfr_snprintf(text, sizeof text, "%.17Rg", point[argument].get());
    // Newer releases of MPFR print the sign of a NaN.
    found.insert(mpfr_nan_p(point[argument].get()) != 0 ? "nan" : text);
  }
  return found;
}

// How many edges and hard arguments a row holds: a list that loses members must be seen, since a gate sees
// maxima only.
struct Counts {
  std::size_t edges[3];  // float, double, mpfr62
  std::size_t hard[3];
};

Counts expected(const FunctionInfo& f) {
  using enum FunctionId;
  Counts c{};
  switch (f.hard) {
    case HardFamily::none:
      break;
    case HardFamily::unit:  // 2 for each bit
      c = {{}, {48, 106, 414}};
      break;
    case HardFamily::range:  // these, and 14 for each end of the range
      c = {{}, {62, 120, 428}};
      if (f.id == exp || f.id == exp2) c = {{}, {48 + 56, 106 + 56, 414 + 56}};
      if (f.id == erfc) c = {{}, {48 + 42, 106 + 42, 414 + 42}};
      break;
    case HardFamily::trig:  // 3 for each binade
      c = {{}, {384, 3072, 3072}};
      break;
    case HardFamily::power:
      c = {{}, {580, 1576, 1992}};
      break;
    case HardFamily::bessel:
      c = {{}, {918, 918, 918}};
      break;
    case HardFamily::gamma:
      c = {{}, {96, 212, 828}};
      if (f.id == tgamma) c = {{}, {606, 1342, 5106}};
      break;
  }
  const auto edges = [&](std::size_t in_float, std::size_t in_double, std::size_t in_mpfr) {
    c.edges[0] = in_float;
    c.edges[1] = in_double;
    c.edges[2] = in_mpfr;
  };
  if (f.function_class == FunctionClass::complex) {
    const std::size_t each = f.arity == 4 ? 8 : 14;
    const std::size_t all = f.arity == 4 ? each * each * each * each : each * each;
    edges(all, all, all);
  } else if (f.function_class == FunctionClass::real) {
    if (f.arity == 1) edges(595, 595, 587);  // no subnormals, no neighbours of the least normal number
    if (f.arity == 2) edges(41 * 41, 41 * 41, 33 * 33);
    if (f.arity == 3) edges(17 * 17 * 17, 17 * 17 * 17, 17 * 17 * 17);
  } else if (f.id == cyl_bessel_j) {
    edges(5 * 12, 5 * 12, 5 * 12);
  } else if (f.id == factorial) {
    edges(5, 5, 5);
  } else if (f.id == laguerre) {
    edges(5 * 5 * 12, 5 * 5 * 12, 5 * 5 * 12);
  } else {
    edges(5 * 8 * 7 * 7, 5 * 8 * 7 * 7, 5 * 8 * 7 * 7);
  }
  return c;
}

TEST(ArgumentLists, HoldTheirCountsForEveryFunctionAndType) {
  for (const auto& f : all_functions()) {
    const Counts want = expected(f);
    for (std::size_t i = 0; i < formats().size(); ++i) {
      EXPECT_EQ(edge_arguments(f, formats()[i]).size(), want.edges[i]) << f.name << " " << i;
      EXPECT_EQ(hard_arguments(f, formats()[i]).size(), want.hard[i]) << f.name << " " << i;
    }
  }
}

TEST(EdgeArguments, OfRealFunctionsHoldTheSpecialValues) {
  for (const auto& f : all_functions()) {
    for (const FloatFormat& format : formats()) {
      const auto list = edge_arguments(f, format);
      for (std::size_t i = 0; i < static_cast<std::size_t>(f.arity); ++i) {
        const auto held = texts(list, i);
        const bool real = f.function_class == FunctionClass::real;
        for (const char* special : {"inf", "-inf", "nan"})
          EXPECT_EQ(held.contains(special), real) << f.name << " " << i << " " << special;
        const DomainMap map = f.domain[i];
        const bool index = map == DomainMap::UINT || map == DomainMap::INT;
        const bool angle = map == DomainMap::MODPI || map == DomainMap::MOD2PI;
        EXPECT_TRUE(held.contains("0")) << f.name;
        EXPECT_EQ(held.contains("-0"), !index && !angle) << f.name << " " << i;
        EXPECT_TRUE(held.contains("1")) << f.name;
        EXPECT_EQ(held.contains("-1"), map != DomainMap::UINT && !angle) << f.name << " " << i;
      }
    }
  }
}

TEST(EdgeArguments, OfRealFunctionsHoldTheEndsOfTheFormat) {
  for (const auto id :
       {FunctionId::sin, FunctionId::log, FunctionId::tgamma, FunctionId::atan2, FunctionId::pow}) {
    const FunctionInfo& f = info_of(id);
    for (const FloatFormat& format : formats()) {
      const auto list = edge_arguments(f, format);
      // Formats without a bound that matters end at 2^16383 and 2^-16494.
      const bool whole = format.exponent_max <= 16383;
      EXPECT_EQ(sampled_exponents(f, format).greatest, whole ? format.exponent_max : 16383);
      EXPECT_EQ(sampled_exponents(f, format).least, whole ? format.exponent_least() : -16494);
      const auto [least, greatest] = sampled_exponents(f, format);
      for (std::size_t i = 0; i < static_cast<std::size_t>(f.arity); ++i) {
        for (const long sign : {1L, -1L}) {
          EXPECT_TRUE(holds(list, i, value_of(format, sign, least))) << f.name;
          EXPECT_TRUE(holds(list, i, value_of(format, sign, greatest))) << f.name;
          EXPECT_TRUE(holds(list, i, value_of(format, sign, greatest, -1))) << f.name;
          EXPECT_TRUE(holds(list, i, value_of(format, sign, greatest, 1))) << f.name;
          if (format.subnormals) {
            for (const long steps : {-1L, 0L, 1L})
              EXPECT_TRUE(holds(list, i, value_of(format, sign, format.exponent_min, steps))) << f.name;
          }
          if (whole) {
            MpfrValue largest = largest_of(format);
            mpfr_setsign(largest, largest, sign < 0 ? 1 : 0, MPFR_RNDN);
            EXPECT_TRUE(holds(list, i, largest)) << f.name;
          }
        }
      }
    }
  }
}

TEST(EdgeArguments, OfOneArgumentSurroundIntegersHalvesAndTheEndOfExactIntegers) {
  for (const FloatFormat& format : formats()) {
    const auto list = edge_arguments(info_of(FunctionId::sqrt), format);
    const auto expect = [&](long m, long exponent, long steps) {
      for (const long sign : {1L, -1L}) {
        EXPECT_TRUE(holds(list, 0, value_of(format, sign * m, exponent, steps)))
            << sign * m << " * 2^" << exponent << " and " << steps << " steps in " << format.precision;
      }
    };
    // The ends of the domains [-1, 1], [-1, inf), [1, inf) are among them, from both sides.
    for (long steps = -2; steps <= 2; ++steps) expect(1, 0, steps);
    for (long i = 2; i <= 40; ++i) {
      for (long steps = -1; steps <= 1; ++steps) expect(i, 0, steps);
    }
    for (long i = 1; i < 80; i += 2) {
      for (long steps = -1; steps <= 1; ++steps) expect(i, -1, steps);
    }
    for (const long pole : {170L, 171L, 172L, 177L, 184L, 1755L, 1756L}) {
      for (long steps = -2; steps <= 2; ++steps) expect(pole, 0, steps);
    }
    for (long steps = -2; steps <= 2; ++steps) {
      expect(1, format.precision - 1, steps);
      expect(1, format.precision, steps);
    }
  }
}

TEST(EdgeArguments, OfOneArgumentAreTheSameForEveryRealFunction) {
  const auto first = edge_arguments(info_of(FunctionId::sqrt), float_format<double>());
  for (const auto& f : all_functions()) {
    if (f.function_class != FunctionClass::real || f.arity != 1) continue;
    const auto list = edge_arguments(f, float_format<double>());
    ASSERT_EQ(list.size(), first.size()) << f.name;
    for (std::size_t k = 0; k < list.size(); ++k)
      ASSERT_TRUE(same(list[k][0], first[k][0])) << f.name << " " << k;
  }
}

TEST(EdgeArguments, OfSeveralArgumentsAreEveryPairOnce) {
  const auto list = edge_arguments(info_of(FunctionId::atan2), float_format<double>());
  std::set<std::string> pairs;
  for (const auto& point : list) {
    char text[96];
    mpfr_snprintf(text, sizeof text, "%Ra %Ra", point[0].get(), point[1].get());
    pairs.insert(text);
  }
  // Some values stand twice in the list of an argument.
  EXPECT_EQ(pairs.size(), texts(list, 0).size() * texts(list, 1).size());
  EXPECT_TRUE(pairs.contains("inf -0x0p+0"));
  EXPECT_TRUE(pairs.contains("-0x0p+0 inf"));
  EXPECT_TRUE(pairs.contains("0x1p+0 -0x1p+0"));
}

TEST(EdgeArguments, OfIndexArgumentsAreSmallAndLargeDegrees) {
  const FloatFormat format = float_format<double>();
  using Texts = std::set<std::string>;
  const Texts degrees = {"0", "1", "2", "7", "100"};
  EXPECT_EQ(texts(edge_arguments(info_of(FunctionId::factorial), format), 0), degrees);
  EXPECT_EQ(texts(edge_arguments(info_of(FunctionId::cyl_bessel_j), format), 0), degrees);
  const auto laguerre = edge_arguments(info_of(FunctionId::laguerre), format);
  EXPECT_EQ(texts(laguerre, 0), degrees);
  EXPECT_EQ(texts(laguerre, 1), degrees);
  const Texts reals = texts(laguerre, 2);
  for (const char* x : {"0", "-0", "0.5", "-0.5", "1", "-1", "2", "-2", "1.5", "-1.5"})
    EXPECT_TRUE(reals.contains(x)) << x;
  EXPECT_EQ(reals.size(), 12U) << "and the least numbers of both signs, not the greatest";
  const auto harmonic = edge_arguments(info_of(FunctionId::spherical_harmonic), format);
  EXPECT_EQ(texts(harmonic, 0), degrees);
  EXPECT_EQ(texts(harmonic, 1), (Texts{"0", "1", "2", "7", "100", "-1", "-2", "-100"}));
}

TEST(EdgeArguments, OfAnglesEndWithTheirDomain) {
  const auto list = edge_arguments(info_of(FunctionId::spherical_harmonic), float_format<double>());
  for (const std::size_t argument : {std::size_t{2}, std::size_t{3}}) {
    const auto held = texts(list, argument);
    EXPECT_EQ(held.size(), 7U);
    for (const char* x : {"0", "0.5", "1", "2", "8.6736173798840355e-19", "4.9406564584124654e-324"})
      EXPECT_TRUE(held.contains(x)) << argument << " " << x;
    EXPECT_TRUE(held.contains(argument == 2 ? "1.5707963267948966" : "3.1415926535897931")) << argument;
  }
}

TEST(EdgeArguments, OfComplexFunctionsHoldTheAxesAndTheEndsOfDouble) {
  for (const auto id : {FunctionId::csqrt, FunctionId::ctan, FunctionId::cpow}) {
    const FunctionInfo& f = info_of(id);
    for (const FloatFormat& format : formats()) {
      const auto list = edge_arguments(f, format);
      const long least = std::max(format.exponent_least(), -1074L);
      const long greatest = std::min(format.exponent_max, 1023L);
      for (std::size_t i = 0; i < static_cast<std::size_t>(f.arity); ++i) {
        EXPECT_TRUE(holds(list, i, value_of(format, 1, least))) << f.name;
        EXPECT_TRUE(holds(list, i, value_of(format, 1, greatest))) << f.name;
        EXPECT_TRUE(holds(list, i, value_of(format, -3, -1))) << f.name;
        EXPECT_TRUE(holds(list, i, value_of(format, 1, 1))) << f.name;
        EXPECT_EQ(texts(list, i).size(), f.arity == 4 ? 8U : 14U) << f.name;
        if (f.arity == 4) continue;
        EXPECT_TRUE(holds(list, i, value_of(format, -1, least))) << f.name;
        EXPECT_TRUE(holds(list, i, value_of(format, -1, greatest))) << f.name;
        EXPECT_TRUE(holds(list, i, value_of(format, 3, -1))) << f.name;
      }
    }
  }
}

}  // namespace
}  // namespace ulpgate
