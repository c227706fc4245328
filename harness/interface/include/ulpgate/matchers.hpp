// What GoogleTest and Catch2 say of an error in ULP; gtest.hpp and catch2.hpp use it.
//
//   EXPECT_ULP_LE(my_sin(x), ulpgate::call("sin", x), 1.0);     // against the function's exact value
//   EXPECT_ULP_LE(sum, 0.3, 2);                                // against a number of the same type
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <type_traits>

#include "ulpgate/ulpgate.h"

namespace ulpgate {

template <class Real>
constexpr const char* type_name() {
  static_assert(
      std::is_same_v<Real, float> || std::is_same_v<Real, double> || std::is_same_v<Real, long double>,
      "ulpgate: errors are measured in float, double and long double");
  return std::is_same_v<Real, float> ? "float" : std::is_same_v<Real, double> ? "double" : "long double";
}

// A function of `ulpgate list functions` at numbers of one type.
template <class Real, std::size_t N>
struct Call {
  const char* function;
  std::array<Real, N> args;
};
template <class Real, class... More>
Call<Real, 1 + sizeof...(More)> call(const char* function, Real x, More... more) {
  return {function, {x, static_cast<Real>(more)...}};
}

struct UlpResult {
  bool good = false;
  double ulp = 0;
  std::string text;  // all that is known, or why nothing is
};

namespace detail {
inline UlpResult result(int code, double ulp, double limit, const std::array<char, 2048>& text) {
  if (code != 0) return {false, 0, std::string("ulpgate: ") + ulpgate_last_error()};
  return {ulp <= limit, ulp, text.data()};
}
}  // namespace detail

template <class Real>
UlpResult ulp_of(Real got, Real exact, double limit) {
  std::array<char, 2048> text{};
  double ulp = 0;
  const int code =
      ulpgate_describe_value(type_name<Real>(), &got, &exact, limit, &ulp, text.data(), text.size());
  return detail::result(code, ulp, limit, text);
}
template <class Real, std::size_t N>
UlpResult ulp_of(Real got, const Call<Real, N>& exact, double limit) {
  if (ulpgate_arity(exact.function) != static_cast<int>(N))
    return {false, 0, std::string("ulpgate: ") + exact.function + " is no function of so many arguments"};
  std::array<char, 2048> text{};
  double ulp = 0;
  const int code = ulpgate_describe_call(type_name<Real>(), &got, exact.function, exact.args.data(), limit,
                                         &ulp, text.data(), text.size());
  return detail::result(code, ulp, limit, text);
}

}  // namespace ulpgate
