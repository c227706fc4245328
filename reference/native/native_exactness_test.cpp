// Tests of native functions: sums that are exact, and the reduction of large angles where it is hardest.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "reference/native/large_angles.hpp"
#include "reference/native/native_functions.hpp"
#include "reference/types/mpfr_value.hpp"

namespace ulpgate {
namespace {

constexpr auto nearest = MPFR_RNDN;

template <class W>
void expect_bounds_of_sums() {
  const auto bound = [](FunctionId id, std::vector<W> args) {
    W result = 0;
    double bound = -1;
    bounded_function<W>(id)(args.data(), &result, &bound, 1, 24);
    return bound;
  };
  using enum FunctionId;
  const W tiny = 0x1p-120L;
  EXPECT_EQ(bound(add, {1.5, 2.25}), 0);
  EXPECT_EQ(bound(add, {1.5, -2.25}), 0);
  EXPECT_EQ(bound(add, {tiny, 0}), 0);
  EXPECT_EQ(bound(sub, {1.5, 2.25}), 0);
  EXPECT_EQ(bound(fma, {1.5, 2.25, -7}), 0);
  for (const W sign : {W(1), W(-1)}) {
    EXPECT_EQ(bound(add, {1, sign * tiny}), 0.5);
    EXPECT_EQ(bound(add, {sign * tiny, 1}), 0.5);
    EXPECT_EQ(bound(sub, {1, sign * tiny}), 0.5);
    EXPECT_EQ(bound(sub, {sign * tiny, 1}), 0.5);
    EXPECT_EQ(bound(fma, {1, 1, sign * tiny}), 0.5);
    EXPECT_EQ(bound(fma, {1, sign * tiny, 1}), 0.5);
  }
}

TEST(NativeFunctions, KnowWhichSumsAreExact) {
  expect_bounds_of_sums<double>();
  expect_bounds_of_sums<long double>();
#ifdef ULPGATE_HAVE_FLOAT128
  expect_bounds_of_sums<Binary128>();
#endif
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

TEST(LargeAngles, NextToMultiplesOfAQuarterTurnAreReducedToTwoUlp) {
  MpfrValue two_over_pi(600), turns(600), whole(600), half_pi(600), difference(600);
  mpfr_const_pi(half_pi, nearest);
  mpfr_div_2ui(half_pi, half_pi, 1, nearest);
  mpfr_ui_div(two_over_pi, 1, half_pi, nearest);
  double least = 1;
  for (int exponent = 22; exponent < 128; ++exponent) {
    mpfr_mul_2si(turns, two_over_pi, exponent - 23, nearest);
    mpfr_frac(turns, turns, nearest);
    std::vector<double> args;
    for (const double m : closest_multipliers(mpfr_get_ld(turns, nearest))) {
      args.push_back(std::ldexp(m, exponent - 23));
      args.push_back(-args.back());
    }
    std::vector<double> angles(args.size());
    std::vector<std::uint8_t> quadrants(args.size());
    reduce_large_angles(args.data(), args.size(), angles.data(), quadrants.data());
    for (std::size_t i = 0; i < args.size(); ++i) {
      mpfr_mul_d(turns, two_over_pi, args[i], nearest);
      mpfr_rint(whole, turns, nearest);
      mpfr_sub(turns, turns, whole, nearest);
      mpfr_mul(turns, turns, half_pi, nearest);
      mpfr_sub_d(difference, turns, angles[i], nearest);
      const double angle = mpfr_get_d(turns, nearest);
      const double ulp = std::ldexp(1.0, std::ilogb(angle) - 52);
      EXPECT_LE(std::fabs(mpfr_get_d(difference, nearest)), 2 * ulp) << args[i] << " " << angle;
      mpfr_fmod_ui(whole, whole, 4, nearest);
      EXPECT_EQ(quadrants[i], (mpfr_get_si(whole, nearest) + 4) % 4) << args[i];
      least = std::min(least, std::fabs(angle));
    }
  }
  // The closest of all (Muller, "Elementary Functions", 3rd edition, chapter 11).
  EXPECT_LT(least, 2e-9);
}

}  // namespace
}  // namespace ulpgate
