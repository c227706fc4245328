// Tests of native functions: sums that are exact.
#include <gtest/gtest.h>

#include <vector>

#include "reference/native/native_functions.hpp"

namespace ulpgate {
namespace {

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

}  // namespace
}  // namespace ulpgate
