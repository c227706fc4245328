// Tests of functions in lanes of double: MPFR finds none beyond its bound, with every instruction set.
#include "reference/double_lanes/double_lanes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>

#include "reference/double_lanes/testing/within_bound.hpp"
#include "reference/lanes/levels.hpp"

namespace ulpgate {
namespace {

constexpr auto nearest = MPFR_RNDN;

// Numbers of 24 bits, in every binade and where functions change from one formula to the next.
std::vector<double> many_floats(std::size_t count) {
  std::mt19937_64 words(11);
  std::vector<double> list = {0.0,       -0.0,         1.0,      -1.0,           HUGE_VAL,
                              -HUGE_VAL, std::nan(""), 0x1p-149, -0x1p-149,      0x1p127,
                              0x1p22,    0x1p23,       -0x1p23,  0x1.fffffep127, -0x1.fffffep127};
  const auto add = [&](double x) { list.push_back(double{static_cast<float>(x)}); };
  const auto unit = [&] { return static_cast<double>(words() >> 11U) * 0x1p-53; };
  const auto either_sign = [&](double x) { return words() % 2 == 0 ? x : -x; };
  for (std::size_t i = 0; i < count; ++i) {
    add(double{std::bit_cast<float>(static_cast<std::uint32_t>(words()))});
    add(either_sign(2 * unit()));
    add(either_sign(200 * unit()));
    add(either_sign(std::ldexp(unit(), static_cast<int>(words() % 40) - 20)));
    // Zeros of log and lgamma, ends of asin and acosh.
    for (const double x : {1.0, 2.0})
      add(either_sign(x + either_sign(std::ldexp(unit(), -static_cast<int>(words() % 24)))));
    add(static_cast<double>(words() % 2000000) * (std::numbers::pi / 2));
  }
  for (int i = -4000; i <= 4000; ++i) add(i / 16.0);
  // Ends of the ranges of exponential functions, of erfc and gamma, of series.
  for (int i = -32; i <= 32; ++i) {
    for (const double end :
         {20.0, 700.0, 709.5, 1000.0, 1024.0, 25.0, 27.5, 160.0, 171.625, 10.0, 0x1p-27, 0x1p22})
      for (const double sign : {1.0, -1.0}) add(sign * end * (1 + i * 0x1p-23));
  }
  return list;
}

// exact_value of gamma functions takes seconds far out, where they say no more than nearer by.
bool is_slow(FunctionId id, double x) {
  return (id == FunctionId::tgamma || id == FunctionId::lgamma) && std::isfinite(x) && (x < -2000 || x > 1e6);
}

constexpr RangeOfResults lanes_range{0x1p900, 0x1p-900};

TEST(DoubleLanes, KeepTheirBoundsOnEveryProcessor) {
  const std::vector<double> args = many_floats(300);
  std::size_t functions = 0;
  for (const FunctionInfo& f : all_functions()) {
    if (double_lanes_function(f.id) == nullptr) continue;
    ++functions;
    ASSERT_EQ(f.arity, 1);
    for (std::size_t level = 0; level < instruction_levels(); ++level) {
      std::vector<double> results(args.size());
      std::vector<double> bounds(args.size());
      double_lanes_function(f.id, level)(args.data(), results.data(), bounds.data(), args.size(), 24);
      double share = 0;
      std::size_t known = 0;
      for (std::size_t i = 0; i < args.size(); ++i) {
        known += bounds[i] >= 0 ? 1U : 0U;
        ASSERT_LE(bounds[i], 0x1p20) << "the stage looks at 32 bits for a power of two";
        if (is_slow(f.id, args[i])) continue;
        EXPECT_TRUE(is_within_bound(f, {&args[i], 1}, results[i], bounds[i], lanes_range, &share))
            << "level " << level;
      }
      EXPECT_GT(known, args.size() * 9 / 10) << f.name;
      if (f.id != FunctionId::sqrt) {
        EXPECT_LT(share, 0.5) << f.name << ": its bound is close to what is seen";
      }
    }
  }
  EXPECT_EQ(functions, 25U);
}

TEST(DoubleLanes, GammaFarOutIsInfiniteZeroOrAtAPole) {
  for (std::size_t level = 0; level < instruction_levels(); ++level) {
    const std::array<double, 6> args = {0x1p127, -0x1p127, -0x1p23, -8388607.5, -2000.5, -2001.5};
    std::array<double, 6> gamma{};
    std::array<double, 6> log_gamma{};
    std::array<double, 6> bounds{};
    double_lanes_function(FunctionId::tgamma, level)(args.data(), gamma.data(), bounds.data(), args.size(),
                                                     24);
    double_lanes_function(FunctionId::lgamma, level)(args.data(), log_gamma.data(), bounds.data(),
                                                     args.size(), 24);
    EXPECT_EQ(gamma[0], HUGE_VAL);
    for (const std::size_t pole : {1U, 2U}) {
      EXPECT_TRUE(std::isnan(gamma[pole]));
      EXPECT_EQ(log_gamma[pole], HUGE_VAL);
    }
    // DLMF 5.5.3: positive between -2k and -2k + 1.
    for (std::size_t i = 3; i < 6; ++i) EXPECT_EQ(gamma[i], 0);
    EXPECT_FALSE(std::signbit(gamma[3]));
    EXPECT_TRUE(std::signbit(gamma[4]));
    EXPECT_FALSE(std::signbit(gamma[5]));
    EXPECT_TRUE(is_within_bound(info_of(FunctionId::lgamma), {&args[0], 1}, log_gamma[0], bounds[0]));
  }
}

TEST(DoubleLanes, AnswerForEveryCountAlike) {
  const std::vector<double> args = many_floats(4);
  for (const FunctionInfo& f : all_functions()) {
    for (std::size_t level = 0; level < instruction_levels(); ++level) {
      const auto function = double_lanes_function(f.id, level);
      if (function == nullptr) continue;
      std::vector<double> all(args.size());
      std::vector<double> bounds(args.size());
      function(args.data(), all.data(), bounds.data(), args.size(), 24);
      for (std::size_t count = 1; count < 20; ++count) {
        std::vector<double> some(count + 1, -7);
        std::vector<double> some_bounds(count + 1, -7);
        function(args.data(), some.data(), some_bounds.data(), count, 24);
        EXPECT_EQ(some[count], -7) << "nothing is written behind the last";
        EXPECT_EQ(some_bounds[count], -7);
        for (std::size_t i = 0; i < count; ++i) {
          // The sign of a NaN says nothing.
          EXPECT_TRUE((std::isnan(some[i]) && std::isnan(all[i])) ||
                      std::bit_cast<std::uint64_t>(some[i]) == std::bit_cast<std::uint64_t>(all[i]))
              << f.name << " " << some[i] << " " << all[i];
          EXPECT_EQ(some_bounds[i], bounds[i]) << f.name;
        }
      }
    }
  }
}

// The integers m of 24 bits for which m x is closest to an integer: multiples of denominators of the
// convergents of x.
std::vector<double> closest_multipliers(long double x) {
  std::vector<double> list;
  long double before = 0;
  long double q = 1;
  while (q < 0x1p24L) {
    for (long double m = q * std::ceil(0x1p23L / q); m < 0x1p24L && m < 0x1p23L + 4 * q; m += q)
      list.push_back(static_cast<double>(m));
    if (x == 0) break;
    x = 1 / x;
    const long double whole = std::floor(x);
    x -= whole;
    const long double next = whole * q + before;
    before = q;
    q = next;
  }
  return list;
}

// Where an error of the remainder is the largest one of the result: the closest of all is 1.6e-9 away
// (Muller, "Elementary Functions", 3rd edition, chapter 11).
TEST(DoubleLanes, KeepTheirBoundsNextToMultiplesOfAQuarterTurn) {
  MpfrValue two_over_pi(600);
  MpfrValue turns(600);
  mpfr_const_pi(two_over_pi, nearest);
  mpfr_ui_div(two_over_pi, 2, two_over_pi, nearest);
  std::vector<double> args;
  for (int exponent = 0; exponent < 128; ++exponent) {
    mpfr_mul_2si(turns, two_over_pi, exponent - 23, nearest);
    mpfr_frac(turns, turns, nearest);
    for (const double m : closest_multipliers(mpfr_get_ld(turns, nearest))) {
      args.push_back(std::ldexp(m, exponent - 23));
      args.push_back(-args.back());
    }
  }
  double least = 1;
  for (std::size_t level = 0; level < instruction_levels(); ++level) {
    std::vector<double> results(args.size());
    std::vector<double> bounds(args.size());
    for (const FunctionId id : {FunctionId::sin, FunctionId::cos, FunctionId::tan}) {
      double_lanes_function(id, level)(args.data(), results.data(), bounds.data(), args.size(), 24);
      double share = 0;
      for (std::size_t i = 0; i < args.size(); ++i) {
        EXPECT_TRUE(is_within_bound(info_of(id), {&args[i], 1}, results[i], bounds[i], {}, &share))
            << "level " << level;
        least = std::min(least, std::fabs(results[i]));
      }
      EXPECT_LT(share, 0.5);
    }
  }
  EXPECT_LT(least, 2e-9);
}

}  // namespace
}  // namespace ulpgate
