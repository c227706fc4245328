// An initial value problem y' = f(t, y), or q'' = a(q) with y = (q, v).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "reference/types/real_types.hpp"

namespace ulpgate::ode {

// out := a(q); q and out have the same length.
template <RealType Real>
using Acceleration = std::function<void(std::span<const Real> q, std::span<Real> out)>;

// out := f(t, y); y and out have the same length.
template <RealType Real>
using Slope = std::function<void(const Real& t, std::span<const Real> y, std::span<Real> out)>;

template <RealType Real>
struct Problem {
  std::vector<Real> start;          // y(0); for q'' = a(q) the positions, then the velocities
  Acceleration<Real> acceleration;  // empty for a problem that is of first order only
  Slope<Real> slope;
};

// q'' = a(q), q(0), q'(0).
template <RealType Real>
[[nodiscard]] Problem<Real> second_order_problem(std::vector<Real> q, const std::vector<Real>& v,
                                                 Acceleration<Real> acceleration) {
  const std::size_t n = q.size();
  q.insert(q.end(), v.begin(), v.end());
  Slope<Real> slope = [acceleration, n](const Real&, std::span<const Real> y, std::span<Real> out) {
    for (std::size_t i = 0; i < n; ++i) out[i] = y[n + i];
    acceleration(y.first(n), out.subspan(n));
  };
  return {std::move(q), std::move(acceleration), std::move(slope)};
}

template <RealType Real>
[[nodiscard]] Problem<Real> first_order_problem(std::vector<Real> y, Slope<Real> slope) {
  return {std::move(y), {}, std::move(slope)};
}

}  // namespace ulpgate::ode
