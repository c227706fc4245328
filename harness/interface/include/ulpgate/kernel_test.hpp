// Kernels as tests: what ulpgate_add_accuracy_test() compiles.
//
// A kernel is a function template of some numbers of one type,
//
//   template <class Real> Real length(Real x, Real y);                  // or std::array<Real, N>, or a
//   struct of Reals (Fields)
//
// which is instantiated here for a built-in type, with the options of this file, and for ulpgate::Wide.
#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

#include "ulpgate/wide.hpp"

namespace ulpgate {

// How a result is taken apart: a number is one part, an array as many as it has.
template <class Result>
struct Parts {
  static constexpr std::size_t count = 1;
  template <std::size_t I>
  static const Result& get(const Result& r) {
    return r;
  }
};
template <class Real, std::size_t N>
struct Parts<std::array<Real, N>> {
  static constexpr std::size_t count = N;
  template <std::size_t I>
  static const Real& get(const std::array<Real, N>& r) {
    return r[I];
  }
};

// A struct template of Reals as a result:
//   template <class Real> struct Force { Real normal, shear; };
//   template <class Real> struct ulpgate::Parts<Force<Real>> : ulpgate::Fields<&Force<Real>::normal,
//   &Force<Real>::shear> {};
template <auto... Members>
struct Fields {
  static constexpr std::size_t count = sizeof...(Members);
  template <std::size_t I, class Struct>
  static const auto& get(const Struct& s) {
    constexpr auto members = std::make_tuple(Members...);
    return s.*std::get<I>(members);
  }
};

namespace detail {

// Whatever the kernel's result is, its type follows from the argument's.
template <class Call, class Real, std::size_t... I>
auto call(const Real* x, std::index_sequence<I...>) {
  return Call::call(x[I]...);
}

template <class Call, class Real, std::size_t N>
using ResultOf = decltype(call<Call, Real>(static_cast<const Real*>(nullptr), std::make_index_sequence<N>()));

template <class Result, class Store, std::size_t... I>
void store(const Result& r, Store&& put, std::index_sequence<I...>) {
  (put(I, Parts<Result>::template get<I>(r)), ...);
}

template <class Call, class Real, std::size_t N>
void evaluate(const void* args, void* results, std::size_t count) {
  using Result = ResultOf<Call, Real, N>;
  constexpr std::size_t parts = Parts<Result>::count;
  const auto* x = static_cast<const Real*>(args);
  auto* y = static_cast<Real*>(results);
  for (std::size_t i = 0; i < count; ++i) {
    const Result r = call<Call, Real>(x + i * N, std::make_index_sequence<N>());
    store(
        r, [&](std::size_t part, const Real& value) { y[i * parts + part] = value; },
        std::make_index_sequence<parts>());
  }
}

template <class Call, std::size_t N>
void evaluate_wide(const ulpgate_wide* const* args, ulpgate_wide* const* results) {
  using Result = ResultOf<Call, Wide, N>;
  std::array<Wide, N> x;
  for (std::size_t i = 0; i < N; ++i) ulpgate_wide_assign(x[i].handle(), args[i]);
  const Result r = call<Call, Wide>(x.data(), std::make_index_sequence<N>());
  store(
      r, [&](std::size_t part, const Wide& value) { ulpgate_wide_assign(results[part], value.handle()); },
      std::make_index_sequence<Parts<Result>::count>());
}

}  // namespace detail

// Of Call, which has a static template call(x...), in Real; the arrays have N entries and outlive the
// program.
template <class Call, class Real, std::size_t N>
ulpgate_kernel kernel(const char* name, const char* type, const char* const* names, const double* low,
                      const double* high) {
  using Result = detail::ResultOf<Call, Real, N>;
  static_assert(Parts<Result>::count == Parts<detail::ResultOf<Call, Wide, N>>::count);
  return {name,
          type,
          static_cast<int>(N),
          static_cast<int>(Parts<Result>::count),
          names,
          low,
          high,
          &detail::evaluate<Call, Real, N>,
          &detail::evaluate_wide<Call, N>};
}

}  // namespace ulpgate
