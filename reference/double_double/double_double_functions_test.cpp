// Tests of double-double functions: MPFR finds none beyond its bound, and none gives up where it should not.
#include "reference/double_double/double_double_functions.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "reference/lanes/levels.hpp"
#include "reference/multi_word/constants.hpp"
#include "reference/oracle/oracle.hpp"

namespace ulpgate {
namespace {

// Arguments of all sizes that a type may have: doubles, and every other one of 64 bits.
class Arguments {
 public:
  DoubleDouble next() {
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
  if (value.hi == 0 && bound == 1)
    return mpfr_zero_p(exact) != 0 || mpfr_get_exp(exact) <= double_double_zero;
  if (value.hi == 0) return mpfr_zero_p(exact) != 0;
  return (mpfr_sgn(exact) > 0) == (value.hi > 0) && (mpfr_inf_p(exact) != 0 || mpfr_get_exp(exact) > 1024);
}

std::size_t arity_of(const FunctionInfo& f) {
  return static_cast<std::size_t>(f.arity);
}

TEST(DoubleDoubleFunctions, KeepTheirBoundsOnEveryProcessor) {
  constexpr std::size_t count = 4000;
  const WideExponentRange wide;
  std::size_t functions = 0;
  for (const FunctionInfo& f : all_functions()) {
    if (double_double_function(f.id) == nullptr) continue;
    ++functions;
    Arguments drawn;
    std::vector<DoubleDouble> args(count * arity_of(f));
    for (auto& a : args) a = drawn.next();
    std::vector<MpfrValue> exact_args;
    for (std::size_t k = 0; k < arity_of(f); ++k) exact_args.emplace_back(2200);
    std::vector<MpfrValue> exact;
    // Exact are sums and products of numbers of 2^-400 to 2^400.
    exact.emplace_back(f.id <= FunctionId::fma ? 2000 : 400);
    for (std::size_t level = 0; level < instruction_levels(); ++level) {
      std::vector<DoubleDouble> results(count);
      std::vector<double> bounds(count);
      double_double_function(f.id, level)(args.data(), results.data(), bounds.data(), count, 64);
      std::size_t known = 0;
      double largest = 0;
      for (std::size_t i = 0; i < count; ++i) {
        if (bounds[i] < 0) continue;
        ++known;
        ASSERT_LE(bounds[i], 0x1p20) << "the stage looks at 32 bits for a power of two";
        for (std::size_t k = 0; k < arity_of(f); ++k) set(exact_args[k], args[i * arity_of(f) + k]);
        exact_value(f, exact_args, exact);
        if (!std::isfinite(results[i].hi) || results[i].hi == 0) {
          EXPECT_TRUE(is_told_rightly(results[i], bounds[i], exact[0]))
              << f.name << std::hexfloat << ' ' << args[i * arity_of(f)].hi;
          continue;
        }
        const double error = ulps(results[i], exact[0]);
        EXPECT_LE(error, bounds[i]) << f.name << std::hexfloat << ' ' << args[i * arity_of(f)].hi;
        largest = std::max(largest, error / bounds[i]);
      }
      // Of numbers of all sizes acosh has a fifth, and fmod those that are two doubles.
      const bool of_doubles = f.id == FunctionId::fmod || f.id == FunctionId::remainder;
      EXPECT_GT(known, count / (of_doubles ? 10 : 8)) << f.name;
      EXPECT_LT(largest, 0.5) << f.name << ": its bound is close to what is seen";
    }
  }
  EXPECT_EQ(functions, 36U);
}

// What is left over of a batch is evaluated singly.
TEST(DoubleDoubleFunctions, AreTheSameOfOneNumberAndOfMany) {
  constexpr std::size_t count = 4000;
  for (const FunctionInfo& f : all_functions()) {
    if (double_double_function(f.id) == nullptr) continue;
    Arguments drawn;
    std::vector<DoubleDouble> args(count * arity_of(f));
    for (auto& a : args) a = drawn.next();
    for (std::size_t level = 0; level < instruction_levels(); ++level) {
      const auto function = double_double_function(f.id, level);
      std::vector<DoubleDouble> results(count);
      std::vector<double> bounds(count);
      function(args.data(), results.data(), bounds.data(), count, 64);
      for (std::size_t i = 0; i < count; ++i) {
        DoubleDouble single;
        double bound = 0;
        function(&args[i * arity_of(f)], &single, &bound, 1, 64);
        ASSERT_EQ(bound < 0, bounds[i] < 0) << f.name;
        if (bound < 0 || !std::isfinite(single.hi)) continue;
        const double difference = (single.hi - results[i].hi) + (single.lo - results[i].lo);
        const double ulp = std::fabs(single.hi) * std::ldexp(1.0, 1 - double_double_bits);
        ASSERT_LE(std::fabs(difference), ulp * (bound + bounds[i]))
            << f.name << ' ' << args[i * arity_of(f)].hi;
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
    if (function == nullptr) continue;
    std::vector<MpfrValue> exact_args;
    for (std::size_t k = 0; k < arity_of(f); ++k) exact_args.emplace_back(60);
    std::vector<MpfrValue> exact;
    exact.emplace_back(400);
    for (const double x : edges) {
      for (const double y : edges) {
        const std::array<DoubleDouble, 3> args = {DoubleDouble{x, 0}, DoubleDouble{y, 0}, DoubleDouble{1, 0}};
        DoubleDouble result;
        double bound = 0;
        function(args.data(), &result, &bound, 1, 53);
        if (bound < 0 || (std::isfinite(result.hi) && result.hi != 0)) continue;
        EXPECT_TRUE(result.hi != 0 || bound == 0 || std::isfinite(x)) << f.name << '(' << x << ')';
        mpfr_set_d(exact_args[0], x, MPFR_RNDN);
        if (f.arity >= 2) mpfr_set_d(exact_args[1], y, MPFR_RNDN);
        if (f.arity == 3) mpfr_set_ui(exact_args[2], 1, MPFR_RNDN);
        exact_value(f, exact_args, exact);
        EXPECT_TRUE(is_told_rightly(result, bound, exact[0])) << f.name << '(' << x << ", " << y << ')';
        ++told;
        // Of a wider type's number that is beyond double nothing is told.
        function(args.data(), &result, &bound, 1, 64);
        EXPECT_TRUE(bound < 0 || (!std::isnan(result.hi) && result.hi != 0))
            << f.name << '(' << x << ", " << y << ')';
      }
    }
  }
  EXPECT_GT(told, 50U);
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
