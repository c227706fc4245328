// Tests of double-double functions: MPFR finds none beyond its bound, and none gives up where it should not.
#include "reference/double_double/double_double_functions.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <span>
#include <sstream>

#include "reference/lanes/levels.hpp"
#include "reference/multi_word/constants.hpp"
#include "reference/oracle/oracle.hpp"

namespace ulpgate {
namespace {

// Arguments of all sizes that a type may have: doubles, and every other one of 64 bits.
class Arguments {
 public:
  DoubleDouble next(DomainMap domain) {
    if (domain == DomainMap::UINT) return DoubleDouble(static_cast<double>(words_() % 101));
    if (domain == DomainMap::INT) return DoubleDouble(static_cast<double>(words_() % 201) - 100);
    double x = 0;
    switch (count_++ % 5) {
      case 0:
        x = 200 * unit() - 100;
        break;
      case 1:
        x = of_exponent(static_cast<int>(words_() % 80) - 60);
        break;
      case 2:
        x = 2 * unit() - 1;
        break;
      case 3:
        x = of_exponent(static_cast<int>(words_() % 2000) - 1000);
        break;
      default:
        // Next to multiples of pi/2 and of ln 2, and next to 1.
        x = std::nearbyint(100 * unit()) * (words_() % 2 == 0 ? 0x1.921fb54442d18p+0 : 0x1.62e42fefa39efp-1);
        if (words_() % 3 == 0) x = 1 + of_exponent(-static_cast<int>(words_() % 52));
        break;
    }
    DoubleDouble value{x, 0};
    if (words_() % 2 == 0)
      value = DoubleDouble(static_cast<long double>(x) * (1 + static_cast<long double>(unit()) * 0x1p-53L));
    return value;
  }

 private:
  double unit() { return static_cast<double>(words_() >> 11U) * 0x1p-53; }
  double of_exponent(int e) {
    const double x = std::ldexp(1 + unit(), e);
    return words_() % 2 == 0 ? x : -x;
  }
  std::mt19937_64 words_{7};
  unsigned count_ = 0;
};

void set(mpfr_ptr to, DoubleDouble x) {
  mpfr_set_d(to, x.hi, MPFR_RNDN);
  mpfr_add_d(to, to, x.lo, MPFR_RNDN);
}

// |value - exact| in ulp of the bounds.
double ulps(DoubleDouble value, mpfr_srcptr exact) {
  MpfrValue difference(mpfr_get_prec(exact));
  mpfr_sub_d(difference, exact, value.hi, MPFR_RNDN);
  mpfr_sub_d(difference, difference, value.lo, MPFR_RNDN);
  int e = std::ilogb(value.hi);
  if (value.hi == std::ldexp(1.0, e) && value.lo < 0) --e;
  mpfr_mul_2si(difference, difference, double_double_bits - 1 - e, MPFR_RNDN);
  return std::fabs(mpfr_get_d(difference, MPFR_RNDA));
}

// Whether a result that is no number, or is 0, is what the header promises.
bool is_told_rightly(DoubleDouble value, double bound, mpfr_srcptr exact) {
  if (std::isnan(value.hi)) return mpfr_nan_p(exact) != 0;
  // Where it is none it may have left even MPFR's range.
  const int least = bound == 2 ? -20000 : double_double_zero;
  const int greatest = bound == 2 ? 20000 : 1024;
  if (value.hi == 0 && bound >= 1) return mpfr_zero_p(exact) != 0 || mpfr_get_exp(exact) <= least;
  if (value.hi == 0) return mpfr_zero_p(exact) != 0;
  return (mpfr_sgn(exact) > 0) == (value.hi > 0) &&
         (mpfr_inf_p(exact) != 0 || mpfr_get_exp(exact) > greatest);
}

std::size_t arity_of(const FunctionInfo& f) {
  return static_cast<std::size_t>(f.arity);
}
std::size_t parts_of(const FunctionInfo& f) {
  return static_cast<std::size_t>(f.parts);
}

struct OfLevel {
  std::vector<DoubleDouble> results;
  std::vector<double> bounds;
  std::size_t known = 0;
  double largest = 0;
};

TEST(DoubleDoubleFunctions, KeepTheirBoundsOnEveryProcessor) {
  constexpr std::size_t count = 4000;
  const WideExponentRange wide;
  std::size_t functions = 0;
  for (const FunctionInfo& f : all_functions()) {
    if (double_double_function(f.id) == nullptr) continue;
    ++functions;
    Arguments drawn;
    std::vector<DoubleDouble> args(count * arity_of(f));
    for (std::size_t i = 0; i < args.size(); ++i) args[i] = drawn.next(f.domain[i % arity_of(f)]);
    std::vector<MpfrValue> exact_args;
    for (std::size_t k = 0; k < arity_of(f); ++k) exact_args.emplace_back(2200);
    std::vector<MpfrValue> exact;
    // Exact are sums and products of numbers of 2^-400 to 2^400, and 1 + m - x.
    for (std::size_t part = 0; part < parts_of(f); ++part)
      exact.emplace_back(f.id <= FunctionId::fma || f.id == FunctionId::laguerre ? 2000 : 400);
    // Of every processor's results at once: the exact value takes longest.
    std::vector<OfLevel> levels(instruction_levels());
    for (std::size_t level = 0; level < levels.size(); ++level) {
      levels[level].results.resize(count * parts_of(f));
      levels[level].bounds.resize(count * parts_of(f));
      double_double_function(f.id, level)(args.data(), levels[level].results.data(),
                                          levels[level].bounds.data(), count, 64);
    }
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < arity_of(f); ++k) set(exact_args[k], args[i * arity_of(f) + k]);
      bool evaluated = false;
      for (std::size_t level = 0; level < levels.size(); ++level) {
        OfLevel& of = levels[level];
        bool is_known = true;
        for (std::size_t part = 0; part < parts_of(f); ++part)
          is_known = is_known && of.bounds[i * parts_of(f) + part] >= 0;
        of.known += is_known ? 1 : 0;
        // MPFR takes its time for complex and special ones; every second is left out.
        if (f.function_class != FunctionClass::real && (level + i) % 2 == 0) continue;
        for (std::size_t part = 0; part < parts_of(f); ++part) {
          const DoubleDouble result = of.results[i * parts_of(f) + part];
          const double bound = of.bounds[i * parts_of(f) + part];
          if (bound < 0) continue;
          ASSERT_LE(bound, f.function_class == FunctionClass::real ? 0x1p20 : 0x1p40)
              << "the stage looks at 32 bits for a power of two";
          if (!evaluated) exact_value(f, exact_args, exact);
          evaluated = true;
          const auto where = [&] {
            std::ostringstream text;
            text << f.name << " part " << part << " level " << level << std::hexfloat;
            for (std::size_t k = 0; k < arity_of(f); ++k) {
              const DoubleDouble x = args[i * arity_of(f) + k];
              text << ' ' << x.hi << '+' << x.lo;
            }
            return text.str();
          };
          if (!std::isfinite(result.hi) || result.hi == 0) {
            EXPECT_TRUE(is_told_rightly(result, bound, exact[part])) << where();
            continue;
          }
          const double error = ulps(result, exact[part]);
          // The exact value has 400 bits itself.
          EXPECT_LE(error, bound > 0 ? bound + 0x1p-298 : 0) << where();
          if (bound > 0x1p-290) of.largest = std::max(of.largest, error / bound);
        }
      }
    }
    for (const OfLevel& of : levels) {
      // Of numbers of all sizes acosh has a fifth, and fmod those that are two doubles.
      const bool of_doubles = f.id == FunctionId::fmod || f.id == FunctionId::remainder;
      const bool harmonic = f.id == FunctionId::spherical_harmonic;  // powers of small sines vanish
      EXPECT_GT(of.known, count / (of_doubles || harmonic ? 16 : 8)) << f.name;
      EXPECT_LT(of.largest, 0.5) << f.name << ": its bound is close to what is seen";
    }
  }
  EXPECT_EQ(functions, 36U + 23U + 4U);
}

// What is left over of a batch is evaluated singly.
TEST(DoubleDoubleFunctions, AreTheSameOfOneNumberAndOfMany) {
  constexpr std::size_t count = 4000;
  for (const FunctionInfo& f : all_functions()) {
    if (double_double_function(f.id) == nullptr) continue;
    Arguments drawn;
    std::vector<DoubleDouble> args(count * arity_of(f));
    for (std::size_t i = 0; i < args.size(); ++i) args[i] = drawn.next(f.domain[i % arity_of(f)]);
    for (std::size_t level = 0; level < instruction_levels(); ++level) {
      const auto function = double_double_function(f.id, level);
      std::vector<DoubleDouble> results(count * parts_of(f));
      std::vector<double> bounds(count * parts_of(f));
      function(args.data(), results.data(), bounds.data(), count, 64);
      for (std::size_t i = 0; i < count; ++i) {
        std::array<DoubleDouble, 2> singles;
        std::array<double, 2> single_bounds{};
        function(&args[i * arity_of(f)], singles.data(), single_bounds.data(), 1, 64);
        for (std::size_t part = 0; part < parts_of(f); ++part) {
          const DoubleDouble single = singles[part];
          const DoubleDouble many = results[i * parts_of(f) + part];
          const double bound = single_bounds[part];
          const double bound_of_many = bounds[i * parts_of(f) + part];
          ASSERT_EQ(bound < 0, bound_of_many < 0) << f.name;
          if (bound < 0 || !std::isfinite(single.hi)) continue;
          const double difference = (single.hi - many.hi) + (single.lo - many.lo);
          const double ulp = std::fabs(single.hi) * std::ldexp(1.0, 1 - double_double_bits);
          ASSERT_LE(std::fabs(difference), ulp * (bound + bound_of_many))
              << f.name << ' ' << args[i * arity_of(f)].hi;
        }
      }
    }
  }
}

TEST(DoubleDoubleFunctions, TellWhatIsNoNumber) {
  const WideExponentRange wide;
  const std::vector<double> edges = {0.0,
                                     -0.0,
                                     1.0,
                                     -1.0,
                                     2.0,
                                     -2.5,
                                     HUGE_VAL,
                                     -HUGE_VAL,
                                     std::nan(""),
                                     0x1p-1074,
                                     0x1.fffffffffffffp1023,
                                     172.5,
                                     -170.5,
                                     0.5,
                                     -1e300};
  std::size_t told = 0;
  for (const FunctionInfo& f : all_functions()) {
    const auto function = double_double_function(f.id);
    // MPC takes seconds for powers of what has such exponents.
    if (function == nullptr || f.id == FunctionId::cpow) continue;
    std::vector<MpfrValue> exact_args;
    for (std::size_t k = 0; k < arity_of(f); ++k) exact_args.emplace_back(60);
    std::vector<MpfrValue> exact;
    for (std::size_t part = 0; part < 2; ++part) exact.emplace_back(400);
    for (const double x : edges) {
      for (const double y : edges) {
        const std::array<DoubleDouble, 4> args = {DoubleDouble{x, 0}, DoubleDouble{y, 0}, DoubleDouble{1, 0},
                                                  DoubleDouble{1, 0}};
        std::array<DoubleDouble, 2> results;
        std::array<double, 2> bounds{};
        const DoubleDouble& result = results[0];
        const double& bound = bounds[0];
        function(args.data(), results.data(), bounds.data(), 1, 53);
        if (bound < 0 || (std::isfinite(result.hi) && result.hi != 0)) continue;
        EXPECT_TRUE(result.hi != 0 || bound == 0 || std::isfinite(x)) << f.name << '(' << x << ')';
        mpfr_set_d(exact_args[0], x, MPFR_RNDN);
        if (f.arity >= 2) mpfr_set_d(exact_args[1], y, MPFR_RNDN);
        for (std::size_t k = 2; k < arity_of(f); ++k) mpfr_set_ui(exact_args[k], 1, MPFR_RNDN);
        exact_value(f, exact_args, std::span(exact).first(parts_of(f)));
        EXPECT_TRUE(is_told_rightly(result, bound, exact[0])) << f.name << '(' << x << ", " << y << ')';
        ++told;
        // Of a wider type's number that is beyond double nothing is told.
        function(args.data(), results.data(), bounds.data(), 1, 64);
        const bool zero_of_indices = f.id == FunctionId::spherical_harmonic && bound == 0;
        EXPECT_TRUE(bound < 0 || bound == 2 || zero_of_indices || (!std::isnan(result.hi) && result.hi != 0))
            << f.name << '(' << x << ", " << y << ')';
      }
    }
  }
  EXPECT_GT(told, 50U);
}

// Below the negative axis by 2^-1594 of the real part, which is -0 beside it: the angle is -pi, and z^(iw)
// e^(pi w).
TEST(DoubleDoubleFunctions, TellTheSideOfTheCutHoweverNearItIs) {
  const std::array<DoubleDouble, 4> args{{{-0x1.8p912, 0}, {-0x1.8p-681, 0}, {0x1p-311, 0}, {0x1p-44, 0}}};
  for (std::size_t level = 0; level < instruction_levels(); ++level) {
    std::array<DoubleDouble, 2> results;
    std::array<double, 2> bounds{};
    double_double_function(FunctionId::cpow, level)(args.data(), results.data(), bounds.data(), 1, 53);
    EXPECT_GT(bounds[0], 0);
    EXPECT_GT(results[0].hi, 1) << level;
    double_double_function(FunctionId::carg, level)(args.data(), results.data(), bounds.data(), 1, 53);
    EXPECT_GT(bounds[0], 0);
    EXPECT_LT(results[0].hi, -3) << level;
  }
}

// Powers with tiny exponents lie next to 1: on which side, and how near, is told.
TEST(DoubleDoubleFunctions, TellHowNearTo1APowerIs) {
  const WideExponentRange wide;
  std::mt19937_64 words(11);
  const auto of_exponents = [&](int least, int greatest) {
    const double significand = 1 + static_cast<double>(words() >> 11U) * 0x1p-53;
    const double x =
        std::ldexp(significand, least + static_cast<int>(words() % static_cast<unsigned>(greatest - least)));
    return words() % 2 == 0 ? x : -x;
  };
  std::vector<MpfrValue> exact_args;
  for (std::size_t k = 0; k < 4; ++k) exact_args.emplace_back(60);
  std::vector<MpfrValue> exact;
  for (std::size_t part = 0; part < 2; ++part) exact.emplace_back(2200);
  MpfrValue difference(2200);
  std::size_t told = 0;
  constexpr std::size_t count = 600;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<DoubleDouble, 4> args{};
    for (std::size_t k = 0; k < 4; ++k)
      args[k] = {k < 2 ? of_exponents(-300, 300) : of_exponents(i % 5 == 0 ? -1070 : -840, -75), 0};
    for (std::size_t k = 0; k < 4; ++k) set(exact_args[k], args[k]);
    exact_value(info_of(FunctionId::cpow), exact_args, exact);
    mpfr_sub_ui(difference, exact[0], 1, MPFR_RNDN);
    ASSERT_EQ(mpfr_regular_p(difference.get()), 1);
    for (std::size_t level = 0; level < instruction_levels(); ++level) {
      std::array<DoubleDouble, 2> results;
      std::array<double, 2> bounds{};
      double_double_function(FunctionId::cpow, level)(args.data(), results.data(), bounds.data(), 1, 53);
      // Where both terms leave the range it is 1 to the bits of a pair.
      if (bounds[0] < 0 || bounds[0] >= 1) continue;
      ++told;
      ASSERT_EQ(results[0].hi, 1);
      ASSERT_EQ(results[0].lo > 0, mpfr_sgn(difference.get()) > 0) << i;
      const double error = ulps(results[0], exact[0]);
      EXPECT_LE(error, bounds[0] / 2) << i << " level " << level;
      EXPECT_LE(bounds[0], std::fabs(results[0].lo) * 0x1p98) << "a quarter of it";
    }
  }
  EXPECT_GT(told, count * instruction_levels() * 9 / 10);
}

// The imaginary part of e^-1000 is 0 and not merely small.
TEST(DoubleDoubleFunctions, TellNothingOfComplexNumbersOnAnAxisThatVanish) {
  for (const FunctionId id : {FunctionId::cexp, FunctionId::ctan, FunctionId::ctanh}) {
    const bool across = id == FunctionId::ctan;
    const std::array<DoubleDouble, 2> z = {DoubleDouble{across ? 0.0 : -3000.0, 0},
                                           DoubleDouble{across ? -3000.0 : 0.0, 0}};
    std::array<DoubleDouble, 2> parts;
    std::array<double, 2> bounds{};
    double_double_function(id)(z.data(), parts.data(), bounds.data(), 1, 53);
    EXPECT_LT(bounds[across ? 0 : 1], 0) << info_of(id).name;
  }
}

TEST(DoubleDoubleFunctions, TellNoZeroOfWhatIsBelowDouble) {
  // As a DoubleDouble it is 0; its sine is not, and a library that says so is wrong.
  if (std::numeric_limits<long double>::min_exponent > -10000) GTEST_SKIP() << "long double is double here";
  const DoubleDouble small(0x1p-12000L);
  ASSERT_EQ(small.hi, 0);
  for (const FunctionId id : {FunctionId::sin, FunctionId::tan}) {
    DoubleDouble result;
    double bound = 0;
    double_double_function(id)(&small, &result, &bound, 1, 64);
    EXPECT_LT(bound, 0);
  }
}

TEST(DoubleDouble, TakesNumbersOf64BitsWithoutError) {
  const long double x = 1 + 0x1p-63L;
  const DoubleDouble d(x);
  EXPECT_EQ(d.hi, 1);
  EXPECT_EQ(d.lo, 0x1p-63);
  EXPECT_EQ(static_cast<long double>(d), x);
  EXPECT_EQ((d - DoubleDouble(1)).hi, 0x1p-63);
  EXPECT_TRUE(DoubleDouble(1) < d);
  const DoubleDouble infinite(static_cast<long double>(HUGE_VAL));
  EXPECT_EQ(infinite.lo, 0) << "no NaN behind an infinity";
}

TEST(DoubleDoubleConstants, AreWhatMpfrSays) {
  const auto& c = multi_word::constants<DoubleDouble>();
  EXPECT_EQ(c.power[32].hi, 1);
  EXPECT_EQ(c.power[32].lo, 0);
  EXPECT_EQ(c.power_less_1[32].hi, 0);
  EXPECT_EQ(c.ln2.hi, 0x1.62e42fefa39efp-1);
  EXPECT_EQ(c.half_pi[0], 0x1.921fb54442d18p+0);
  EXPECT_EQ(c.two_over_pi[0], 0xa2f9836e4e441529U);
  EXPECT_EQ(c.two_over_pi[1], 0xfc2757d1f534ddc0U);
}

}  // namespace
}  // namespace ulpgate
