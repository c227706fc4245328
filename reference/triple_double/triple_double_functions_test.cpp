// Tests of triple-double functions: MPFR finds none beyond its bound, and none gives up where it should not.
#include "reference/triple_double/triple_double_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "reference/lanes/levels.hpp"
#include "reference/oracle/oracle.hpp"
#include "reference/triple_double/large_angles.hpp"

namespace ulpgate {
namespace {

// Numbers of 113 bits, of all sizes that a function may be asked for.
class Arguments {
 public:
  TripleDouble next() {
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
        x = of_exponent(static_cast<int>(words_() % 800) - 400);
        break;
      default:
        // Next to multiples of pi/2, and next to 1.
        x = std::nearbyint(100 * unit()) * 0x1.921fb54442d18p+0;
        if (words_() % 2 == 0) x = 1 + of_exponent(-static_cast<int>(words_() % 52));
        break;
    }
    const int e = x == 0 ? 0 : std::ilogb(x);
    // Below half a unit of x, and 60 bits in all.
    const double mid = std::ldexp(unit() - 0.5, e - 53);
    const double lo = std::ldexp(std::nearbyint(64 * (unit() - 0.5)), e - 112);
    const double a = mid + lo;
    return {x, a, (mid - a) + lo};
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

void set(mpfr_ptr to, const TripleDouble& x) {
  mpfr_set_d(to, x.hi, MPFR_RNDN);
  mpfr_add_d(to, to, x.mid, MPFR_RNDN);
  mpfr_add_d(to, to, x.lo, MPFR_RNDN);
}

// |value - exact| in ulp of the bounds.
double ulps(const TripleDouble& value, mpfr_srcptr exact) {
  MpfrValue difference(mpfr_get_prec(exact));
  for (const double part : {value.hi, value.mid, value.lo})
    mpfr_sub_d(difference, part == value.hi ? exact : difference.get(), part, MPFR_RNDN);
  int e = std::ilogb(value.hi);
  if (value.hi == std::ldexp(1.0, e) && value.mid < 0) --e;
  mpfr_mul_2si(difference, difference, triple_double_bits - 1 - e, MPFR_RNDN);
  return std::fabs(mpfr_get_d(difference, MPFR_RNDA));
}

TEST(TripleDoubleFunctions, KeepTheirBoundsOnEveryProcessor) {
  constexpr std::size_t count = 1603;  // no multiple of any width
  const WideExponentRange wide;
  std::size_t functions = 0;
  for (const FunctionInfo& f : all_functions()) {
    if (triple_double_function(f.id) == nullptr) continue;
    ++functions;
    const auto arity = static_cast<std::size_t>(f.arity);
    Arguments drawn;
    std::vector<TripleDouble> args(count * arity);
    for (auto& a : args) a = drawn.next();
    std::vector<MpfrValue> exact_args;
    for (std::size_t k = 0; k < arity; ++k) exact_args.emplace_back(2200);
    std::vector<MpfrValue> exact;
    exact.emplace_back(600);
    for (std::size_t level = 0; level < instruction_levels(); ++level) {
      std::vector<TripleDouble> results(count);
      std::vector<double> bounds(count);
      std::vector<double> scales(count);
      triple_double_function(f.id, level)(args.data(), results.data(), scales.data(), bounds.data(), count);
      std::size_t known = 0;
      double largest = 0;
      for (std::size_t i = 0; i < count; ++i) {
        if (bounds[i] < 0) continue;
        ++known;
        if (!std::isfinite(results[i].hi) || results[i].hi == 0) continue;
        for (std::size_t k = 0; k < arity; ++k) set(exact_args[k], args[i * arity + k]);
        exact_value(f, exact_args, exact);
        mpfr_mul_2si(exact[0], exact[0], -static_cast<long>(scales[i]), MPFR_RNDN);
        const double error = ulps(results[i], exact[0].get());
        ASSERT_LE(error, bounds[i]) << f.name << std::hexfloat << ' ' << args[i * arity].hi;
        largest = std::max(largest, error / bounds[i]);
      }
      EXPECT_GT(known, count / 8) << f.name;
      EXPECT_LT(largest, 0.5) << f.name << ": its bound is close to what is seen";
    }
  }
  EXPECT_EQ(functions, 32U);
}

// 2/pi x = 4 n + quadrant + fraction.
TEST(LargeAngles, AreWhatMpfrSays) {
  const WideExponentRange wide;
  std::mt19937_64 words(3);
  constexpr mpfr_prec_t bits = 17500;
  MpfrValue two_over_pi(bits);
  mpfr_const_pi(two_over_pi, MPFR_RNDN);
  mpfr_ui_div(two_over_pi, 2, two_over_pi, MPFR_RNDN);
  MpfrValue x(128);
  MpfrValue turns(bits);
  MpfrValue whole(bits);
  for (const int exponent : {0, 1, 29, 63, 111, 112, 113, 114, 115, 178, 1023, 9999, 16383}) {
    for (int i = 0; i < 20; ++i) {
      const std::uint64_t high = (words() >> 16U) | 0x1000000000000U;
      const std::uint64_t low = words();
      mpfr_set_uj(x, high, MPFR_RNDN);
      mpfr_mul_2ui(x, x, 64, MPFR_RNDN);
      mpfr_add_d(x, x, static_cast<double>(low >> 32U) * 0x1p32, MPFR_RNDN);
      mpfr_add_ui(x, x, low & 0xffffffffU, MPFR_RNDN);
      mpfr_mul_2si(x, x, exponent - 112, MPFR_RNDN);
      mpfr_mul(turns, x, two_over_pi, MPFR_RNDN);
      mpfr_round(whole, turns);
      mpfr_sub(turns, turns, whole, MPFR_RNDN);
      MpfrValue quadrant(64);
      mpfr_fmod_ui(quadrant, whole, 4, MPFR_RNDN);
      const QuarterTurns found = quarter_turns(high, low, exponent);
      EXPECT_EQ(static_cast<unsigned long>(found.quadrant), mpfr_get_ui(quadrant, MPFR_RNDN)) << exponent;
      EXPECT_LE(ulps(found.fraction, turns), 0x1p-6) << exponent;
    }
  }
}

}  // namespace
}  // namespace ulpgate
