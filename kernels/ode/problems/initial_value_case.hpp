// InitialValueCase: an initial value problem with its end times and what its solution keeps.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/ode/problems/problem.hpp"
#include "reference/text/literal.hpp"

namespace ulpgate::ode {

template <RealType Real>
struct InitialValueCase {
  std::string name;
  bool stiff;
  std::vector<std::string> ends;  // times: decimal text, or "2 pi"
  Problem<Real> problem;          // autonomous; with its Jacobian
  // What the solution keeps, of a state; empty where nothing is known.
  std::function<Real(std::span<const Real> y)> invariant;
};

// The number of an end's text: "40", "1e11", "2 pi".
template <RealType Real>
[[nodiscard]] Real end_time(std::string_view text) {
  using std::acos;
  if (text == "2 pi") return 2 * acos(Real(-1));
  return real<Real>(text);
}

namespace detail {

template <RealType Real>
[[nodiscard]] std::vector<Real> read_all(std::initializer_list<std::string_view> texts) {
  std::vector<Real> numbers;
  for (const auto text : texts) numbers.push_back(real<Real>(text));
  return numbers;
}

}  // namespace detail

}  // namespace ulpgate::ode
