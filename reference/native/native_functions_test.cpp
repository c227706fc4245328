// Tests of the bounds of native functions: binary64, many at once where the machine can, against MPFR.
#include "reference/native/native_functions.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "reference/native/vector_functions.hpp"
#include "reference/oracle/oracle.hpp"

namespace ulpgate {
namespace {

// Values of binary32: the arguments for which binary64 is a reference.
std::vector<double> floats(std::size_t count) {
  std::mt19937 words(11);
  std::vector<double> list;
  for (std::size_t i = 0; i < count; ++i)
    list.push_back(static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(words()))));
  for (const double x :
       {0.0, -0.0, 1.0, -1.0, 0.5, 2.0, HUGE_VAL, -HUGE_VAL, std::nan(""), 0x1p-149, 0x1p127})
    list.push_back(x);
  for (int i = -500; i <= 500; ++i) list.push_back(i / 8.0);
  return list;
}

// Whether `got` is within `bound` ulp of the exact value, or says of a special value what the header
// promises.
testing::AssertionResult holds(FunctionId id, double x, double got, double bound) {
  if (bound < 0) return testing::AssertionSuccess();
  std::vector<MpfrValue> args;
  args.emplace_back(53);
  mpfr_set_d(args[0], x, MPFR_RNDN);
  std::vector<MpfrValue> exact;
  exact.emplace_back(160);
  exact_value(info_of(id), args, exact);
  const long double value = mpfr_get_ld(exact[0], MPFR_RNDN);
  const auto failure = [&] {
    return testing::AssertionFailure() << info_of(id).name << "(" << std::hexfloat << x << ") = " << got
                                       << ", exact " << static_cast<double>(value) << ", bound " << bound;
  };
  if (std::isnan(got) || std::isnan(value))
    return std::isnan(got) && std::isnan(value) ? testing::AssertionSuccess() : failure();
  if (std::isinf(got))
    return (got > 0 ? value : -value) > 0x1p1023L ? testing::AssertionSuccess() : failure();
  if (std::fabs(got) < 0x1p-1022)
    return std::fabs(value) < 0x1.1p-1022L ? testing::AssertionSuccess() : failure();
  const long double ulp = std::ldexp(1.0L, std::ilogb(got) - 52);
  return std::fabs(got - value) <= bound * ulp ? testing::AssertionSuccess() : failure();
}

TEST(NativeFunctions, KeepTheirBoundsInBinary64) {
  const std::vector<double> args = floats(2000);
  std::vector<double> results(args.size());
  std::vector<double> bounds(args.size());
  for (const FunctionInfo& f : all_functions()) {
    const auto function = bounded_function<double>(f.id);
    if (f.arity != 1 || f.function_class != FunctionClass::real || function == nullptr) continue;
    function(args.data(), results.data(), bounds.data(), args.size(), 24);
    for (std::size_t i = 0; i < args.size(); ++i) EXPECT_TRUE(holds(f.id, args[i], results[i], bounds[i]));
  }
}

// Numbers of 24 bits, 40 in every binade from 2^least on, of both signs.
std::vector<double> large_floats(int least) {
  std::mt19937 words(12);
  std::vector<double> list;
  for (int exponent = least; exponent < 128; ++exponent) {
    for (int i = 0; i < 40; ++i) {
      const double x = std::ldexp(1 + static_cast<double>(words() >> 9U) * 0x1p-23, exponent);
      list.push_back(i % 2 == 0 ? x : -x);
    }
  }
  return list;
}

TEST(NativeFunctions, ReduceLargeAnglesToTheirLastBits) {
  auto args = large_floats(18);
  // Of all binary32 numbers the one closest to a multiple of pi/2 (Muller, "Elementary Functions", 3rd
  // edition, chapter 11), 1.6e-9 from it.
  constexpr double closest = 16367173 * 0x1p72;
  args.insert(args.end(), {closest, -closest, 0x1.fffffep127, -0x1.fffffep127, 0x1p22, 0x1.fffffep21});
  std::vector<double> results(args.size());
  std::vector<double> bounds(args.size());
  for (const FunctionId id : {FunctionId::sin, FunctionId::cos, FunctionId::tan}) {
    bounded_function<double>(id)(args.data(), results.data(), bounds.data(), args.size(), 24);
    for (std::size_t i = 0; i < args.size(); ++i) {
      EXPECT_TRUE(holds(id, args[i], results[i], bounds[i]));
      if (vector_function(id) != nullptr && std::fabs(args[i]) >= 0x1p22) {
        EXPECT_LE(bounds[i], 16);
      }
    }
  }
  double cosine = 0;
  bounded_function<double>(FunctionId::cos)(&closest, &cosine, bounds.data(), 1, 24);
  EXPECT_LT(std::fabs(cosine), 2e-9);
}

TEST(NativeFunctions, KeepTheirBoundsAtTheEndsOfShortSeries) {
  auto args = large_floats(2);
  for (const double x :
       {0x1p-27, 0x1.fffffep-28, 64.0, 0x1.fffffep5, 171.625, 171.75, 8388607.0, 8388608.0}) {
    args.push_back(x);
    args.push_back(-x);
  }
  for (int exponent = -149; exponent < -20; ++exponent) {
    args.push_back(std::ldexp(1.0, exponent));
    args.push_back(-std::ldexp(1.75, exponent));
  }
  std::vector<double> results(args.size());
  std::vector<double> bounds(args.size());
  for (const FunctionId id : {FunctionId::tgamma, FunctionId::lgamma}) {
    bounded_function<double>(id)(args.data(), results.data(), bounds.data(), args.size(), 24);
    for (std::size_t i = 0; i < args.size(); ++i) EXPECT_TRUE(holds(id, args[i], results[i], bounds[i]));
  }
}

TEST(VectorFunctions, KeepTheirBoundsAtTheEndsOfTheirRanges) {
  // 0 to 30 in steps of 1/32, where hyperbolic and error functions reach their limits, and the ends of exp.
  std::vector<double> args;
  for (int i = 0; i < 960; ++i) args.push_back(i / 32.0);
  for (int i = -64; i <= 64; ++i) {
    for (const double end : {708.5, 709.78, 710.5, 1022.5, 1024.0, 1.0}) args.push_back(end + i * 0x1p-7);
  }
  for (std::size_t i = args.size(); i > 0; --i) args.push_back(-args[i - 1]);
  std::vector<double> results(args.size());
  std::vector<double> bounds(args.size());
  for (const FunctionInfo& f : all_functions()) {
    if (vector_function(f.id) == nullptr) continue;
    bounded_function<double>(f.id)(args.data(), results.data(), bounds.data(), args.size(), 24);
    for (std::size_t i = 0; i < args.size(); ++i) EXPECT_TRUE(holds(f.id, args[i], results[i], bounds[i]));
  }
}

TEST(VectorFunctions, AnswerForEveryCountAlike) {
  if (vector_function(FunctionId::exp, 4) == nullptr) GTEST_SKIP() << "no libmvec on this machine";
  const std::vector<double> args = floats(100);
  for (const FunctionInfo& f : all_functions()) {
    for (const int lanes : {4, 8}) {
      const VectorFunction function = vector_function(f.id, lanes);
      if (function == nullptr) continue;
      std::vector<double> all(args.size());
      function(args.data(), all.data(), args.size());
      for (std::size_t count = 1; count < 20; ++count) {
        std::vector<double> some(count + 1, -7);
        function(args.data(), some.data(), count);
        EXPECT_EQ(some[count], -7) << "nothing is written behind the last";
        for (std::size_t i = 0; i < count; ++i)
          EXPECT_EQ(std::bit_cast<std::uint64_t>(some[i]), std::bit_cast<std::uint64_t>(all[i]))
              << f.name << ", " << lanes << " lanes";
      }
    }
  }
}

// Both are within 4 ulp of the value, so within 8 of each other; out of their ranges they answer the same.
TEST(VectorFunctions, OfFourAndEightLanesAgree) {
  std::vector<double> args = floats(100);
  for (const double end : {0.5, 1.0, 2.0, 6.5, 23.0, 28.0, 41.0, 709.0, 711.0, 1023.0, 1025.0}) {
    args.push_back(end);
    args.push_back(-end);
  }
  for (const FunctionInfo& f : all_functions()) {
    const VectorFunction four = vector_function(f.id, 4);
    const VectorFunction eight = vector_function(f.id, 8);
    if (four == nullptr || eight == nullptr) continue;
    std::vector<double> a(args.size());
    std::vector<double> b(args.size());
    four(args.data(), a.data(), args.size());
    eight(args.data(), b.data(), args.size());
    for (std::size_t i = 0; i < args.size(); ++i) {
      if (std::isnan(b[i])) {
        EXPECT_TRUE(std::isnan(a[i])) << f.name << ' ' << args[i];
      } else if (a[i] != b[i]) {
        EXPECT_LE(std::fabs(a[i] - b[i]), std::fabs(b[i]) * 8 * 0x1p-52) << f.name << ' ' << args[i];
      }
    }
  }
}

}  // namespace
}  // namespace ulpgate
