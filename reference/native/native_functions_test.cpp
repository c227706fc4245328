// Tests of the bounds of native functions of several arguments in binary64 against MPFR.
#include "reference/native/native_functions.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <random>

#include "reference/double_lanes/double_lanes.hpp"
#include "reference/double_lanes/testing/within_bound.hpp"

namespace ulpgate {
namespace {

// Values of binary32: the arguments for which binary64 is a reference.
std::vector<double> floats(std::size_t count) {
  std::mt19937 words(11);
  const std::array<double, 11> edges = {0.0,      -0.0,      1.0,          -1.0,     0.5,    2.0,
                                        HUGE_VAL, -HUGE_VAL, std::nan(""), 0x1p-149, 0x1p127};
  std::vector<double> list;
  while (list.size() < count) {
    list.push_back(double{std::bit_cast<float>(static_cast<std::uint32_t>(words()))});
    list.push_back(static_cast<double>(static_cast<int>(words() % 2000) - 1000) / 64);
    if (words() % 8 == 0) list.push_back(edges[words() % edges.size()]);
  }
  list.resize(count);
  return list;
}

TEST(NativeFunctions, KeepTheirBoundsInBinary64) {
  constexpr std::size_t count = 4000;
  std::size_t functions = 0;
  for (const FunctionInfo& f : all_functions()) {
    const auto function = bounded_function<double>(f.id);
    if (f.arity < 2 || function == nullptr) continue;
    ++functions;
    const auto arity = static_cast<std::size_t>(f.arity);
    const std::vector<double> args = floats(count * arity);
    std::vector<double> results(count);
    std::vector<double> bounds(count);
    function(args.data(), results.data(), bounds.data(), count, 24);
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_TRUE(is_within_bound(f, {&args[i * arity], arity}, results[i], bounds[i]));
  }
  EXPECT_EQ(functions, 10U);
}

TEST(NativeFunctions, OfOneArgumentInBinary64CallNothingOfTheLibrary) {
  for (const FunctionInfo& f : all_functions()) {
    const auto function = bounded_function<double>(f.id);
    if (f.arity != 1 || function == nullptr || f.id == FunctionId::logb) continue;
    EXPECT_EQ(function, double_lanes_function(f.id)) << f.name;
  }
}

}  // namespace
}  // namespace ulpgate
