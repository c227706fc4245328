// Tests of the lower bounds of condition numbers: for every function, against differences of the oracle.
#include "reference/condition/condition_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "reference/condition/condition.hpp"

namespace ulpgate {
namespace {

constexpr auto nearest = MPFR_RNDN;
using Numbers = std::vector<long double>;
// The condition number itself is good to 2^-90 of 1.
constexpr long double uncertain = 0x1p-88L;

// Arguments of one function, the same in every run.
class Arguments {
 public:
  explicit Arguments(const FunctionInfo& f) : function_(f) {}

  Numbers next() {
    Numbers a;
    for (int i = 0; i < function_.arity; ++i) a.push_back(of(function_.domain[static_cast<std::size_t>(i)]));
    return a;
  }

 private:
  long double unit() { return static_cast<long double>(words_()) * 0x1p-64L; }
  int integer(int least, int greatest) {
    return least + static_cast<int>(words_() % static_cast<unsigned>(greatest - least + 1));
  }
  int exponent() {
    if (function_.function_class == FunctionClass::complex) return integer(-50, 5);
    const int greatest = function_.hard == HardFamily::gamma ? 10 : 40;
    return integer(0, 9) == 0 ? integer(-3000, greatest == 40 ? 3000 : 10) : integer(-40, greatest);
  }

  // Ordinary numbers; of every size; next to zeros and singularities at 1, 2 and multiples of pi/2.
  long double any() {
    const long double sign = integer(0, 1) == 0 ? 1 : -1;
    switch (function_.function_class == FunctionClass::special ? 0 : integer(0, 4)) {
      case 0:
        return sign * 100 * unit();
      case 1:
        return sign * 3 * unit();
      case 2:
        return sign * std::ldexp(1 + unit(), exponent());
      case 3:
        return sign * (integer(1, 2) + (unit() - 0.5L) * std::ldexp(1.0L, -integer(0, 50)));
      default:
        return sign * integer(1, 30) * std::numbers::pi_v<long double> / 2 *
               (1 + (unit() - 0.5L) * std::ldexp(1.0L, -integer(2, 62)));
    }
  }

  long double of(DomainMap map) {
    switch (map) {
      case DomainMap::UINT:
        return integer(0, 12);
      case DomainMap::INT:
        return integer(-12, 12);
      case DomainMap::MODPI:
        return unit() * std::numbers::pi_v<long double>;
      case DomainMap::MOD2PI:
        return unit() * 2 * std::numbers::pi_v<long double>;
      default:
        break;
    }
    for (;;) {
      const long double x = any();
      const bool outside = (map == DomainMap::PM1 && std::fabs(x) > 1) ||
                           (map == DomainMap::GTM1 && x <= -1) || (map == DomainMap::GT1 && x < 1) ||
                           (map == DomainMap::GT0 && x <= 0);
      if (!outside) return x;
    }
  }

  const FunctionInfo& function_;
  std::mt19937_64 words_{5};
};

std::vector<MpfrValue> wide(const Numbers& a) {
  std::vector<MpfrValue> v;
  for (const long double x : a) {
    v.emplace_back(64);
    mpfr_set_ld(v.back(), x, nearest);
  }
  return v;
}

Numbers exact(const FunctionInfo& f, const Numbers& a) {
  std::vector<MpfrValue> out;
  for (int i = 0; i < f.parts; ++i) out.emplace_back(120);
  exact_value(f, wide(a), out);
  Numbers values;
  for (const MpfrValue& v : out) values.push_back(mpfr_get_ld(v, nearest));
  return values;
}

double bound_of(const FunctionInfo& f, const Numbers& a, long double value, int part) {
  // What lies behind the arguments of f is none of them.
  std::array<long double, max_arity + 2> args;
  args.fill(1e6L);
  std::ranges::copy(a, args.begin());
  return condition_lower_bound(f, args.data(), value, part);
}

double condition_of(const FunctionInfo& f, const Numbers& a, int part) {
  return condition_number(f, wide(a), part, 53);
}

bool has_bound(const FunctionInfo& f) {
  using enum FunctionId;
  // Piecewise, at most 2, or of an integer.
  return std::ranges::count(std::array{cbrt, fmod, remainder, logb, cconj, cproj, cabs, cnorm, factorial},
                            f.id) == 0;
}

// How far the bound may fall below the number beyond its margin: 2^-30 of the whole derivative, doubled, and
// what a difference that gives it is good to.  Values and condition numbers are those of both parts.
long double allowance(const FunctionInfo& f, const Numbers& a, const Numbers& values,
                      const Numbers& conditions, std::size_t part) {
  const long double v = std::fabs(values[part]);
  const auto size_of = [&](FunctionId id, const Numbers& args) {
    return std::fabs(exact(info_of(id), args)[0]);
  };
  switch (f.id) {
    case FunctionId::tgamma:
      return 0x1p-29L * (1 + std::fabs(a[0]));
    case FunctionId::lgamma:
      return 0x1p-29L * (1 + std::fabs(a[0])) / v;
    case FunctionId::cyl_bessel_j: {
      // The terms of x J_n' = x J_(n-1) - n J_n (DLMF 10.6.2), and the C library's J good to its amplitude.
      const long double neighbour = size_of(f.id, {a[0] == 0 ? 1 : a[0] - 1, a[1]});
      const long double x = std::fabs(a[1]);
      return (0x1p-29L * (x + a[0]) * std::max(neighbour, v) + 0x1p-39L * x) / v;
    }
    case FunctionId::laguerre:
      // The derivative, -L_(n-1)^(m+1)(x) (DLMF 18.9.23), with all its terms positive.
      if (a[0] == 0) return 0;
      return 0x1p-29L * std::fabs(a[2]) * size_of(f.id, {a[0] - 1, a[1] + 1, -std::fabs(a[2])}) / v;
    case FunctionId::spherical_harmonic:
      // Where the number is large the Legendre function, a sum of terms far larger, is next to a zero.
      return 0x1p-22L * conditions[part] * conditions[part];
    default:
      break;
  }
  if (f.parts == 1) return 0;
  // |x| + |y| times |Re f'| + |Im f'|
  return 0x1p-29L *
         ((conditions[0] + uncertain) * std::fabs(values[0]) +
          (conditions[1] + uncertain) * std::fabs(values[1])) /
         v;
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const FunctionInfo& f : all_functions()) names.emplace_back(f.name);
  return names;
}

class ConditionBound : public testing::TestWithParam<std::string> {};

TEST_P(ConditionBound, LiesBelowTheConditionNumberAndClose) {
  const FunctionInfo f = find_function(GetParam()).value();
  const auto ordinary = [](long double x) {
    return x == 0 || (std::fabs(x) > 0x1p-5000L && std::fabs(x) < 0x1p5000L);
  };
  Arguments arguments(f);
  int close = 0;
  for (int i = 0; i < 400; ++i) {
    const Numbers a = arguments.next();
    const Numbers values = exact(f, a);
    Numbers conditions;
    for (int part = 0; part < f.parts; ++part) conditions.push_back(condition_of(f, a, part));
    for (std::size_t part = 0; part < values.size(); ++part) {
      const long double condition = conditions[part];
      if (std::isnan(condition)) continue;
      const double bound = bound_of(f, a, values[part], static_cast<int>(part));
      const auto where = [&] {
        std::string text = std::string(part_name(f, static_cast<int>(part))) + " at";
        for (const long double x : a) text += " " + testing::PrintToString(x);
        return text;
      };
      EXPECT_LE(bound, condition + uncertain) << where();
      EXPECT_GE(bound, 0) << where();
      if (!has_bound(f) || values[part] == 0 || !ordinary(values[part]) || condition > 1e300L) continue;
      ++close;
      // 2^-12 is the margin.
      EXPECT_GE(bound, condition * (1 - 0x1p-11L) - uncertain - allowance(f, a, values, conditions, part))
          << where();
    }
  }
  EXPECT_GE(close, has_bound(f) ? 150 : 0);
}

INSTANTIATE_TEST_SUITE_P(OfEveryFunction, ConditionBound, testing::ValuesIn(all_names()),
                         [](const auto& info) { return info.param; });

// Numbers that large are common there, and their condition numbers no less.
TEST(ConditionBounds, OfLargeAnglesAreTheConditionNumbersWhereADoubleHoldsThem) {
  for (const FunctionId id : {FunctionId::sin, FunctionId::cos, FunctionId::tan}) {
    const FunctionInfo& f = info_of(id);
    for (const int exponent : {300, 900, 5100, 10000}) {
      const Numbers a = {std::ldexp(1.3L, exponent)};
      const double bound = bound_of(f, a, exact(f, a)[0], 0);
      const double condition = condition_of(f, a, 0);
      EXPECT_LE(bound, condition) << f.name << " at 2^" << exponent;
      EXPECT_GE(bound, std::min(condition * (1 - 0x1p-11), 1e300)) << f.name << " at 2^" << exponent;
    }
    const Numbers infinite = {HUGE_VALL};
    EXPECT_EQ(bound_of(f, infinite, 0.5L, 0), 0) << f.name;
  }
}

TEST(ConditionBounds, AreNothingWhereAnIntermediateResultCouldOverflow) {
  const auto bound = [](FunctionId id, const Numbers& a, long double value) {
    return bound_of(info_of(id), a, value, 0);
  };
  EXPECT_EQ(bound(FunctionId::log, {0x1p6000L}, 4158), 0) << "an argument";
  EXPECT_EQ(bound(FunctionId::log, {0x1p-6000L}, -4158), 0) << "a small one";
  EXPECT_EQ(bound(FunctionId::hypot, {3, 0x1p6000L}, 0x1p6000L), 0) << "the second one";
  EXPECT_EQ(bound(FunctionId::exp, {4158}, 0x1p5998L), 0) << "a value";
  EXPECT_EQ(bound(FunctionId::log, {1}, 0), 0) << "a zero of the function";
  EXPECT_EQ(bound(FunctionId::add, {0x1p4000L, -0x1p4000L}, 0x1p-4000L), 0) << "more than a double holds";
}

}  // namespace
}  // namespace ulpgate
