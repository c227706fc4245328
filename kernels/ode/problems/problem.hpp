// An initial value problem y' = f(t, y), or q'' = a(q) with y = (q, v).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "kernels/ode/algebra/dual.hpp"

namespace ulpgate::ode {

// out := a(q); q and out have the same length.
template <RealType Real>
using Acceleration = std::function<void(std::span<const Real> q, std::span<Real> out)>;

// out := f(t, y); y and out have the same length.
template <RealType Real>
using Slope = std::function<void(const Real& t, std::span<const Real> y, std::span<Real> out)>;

// out[i * n + j] := df_i/dy_j of n components.
template <RealType Real>
using Jacobian = std::function<void(const Real& t, std::span<const Real> y, std::span<Real> out)>;

template <RealType Real>
struct Problem {
  std::vector<Real> start;          // y(0); for q'' = a(q) the positions, then the velocities
  Acceleration<Real> acceleration;  // empty for a problem that is of first order only
  Slope<Real> slope;
  Jacobian<Real> jacobian;  // of a slope that does not depend on t; empty where it is not known
};

namespace detail {

// The Jacobian of a formula, a column a direction.
template <RealType Real, class Formula>
[[nodiscard]] Jacobian<Real> jacobian_of(Formula formula) {
  return [formula](const Real&, std::span<const Real> y, std::span<Real> out) {
    const std::size_t n = y.size();
    std::vector<Dual<Real>> at(n);
    std::vector<Dual<Real>> slopes(n);
    for (std::size_t i = 0; i < n; ++i) at[i].value = y[i];
    for (std::size_t j = 0; j < n; ++j) {
      at[j].slope = Real(1);
      formula(std::span<const Dual<Real>>(at), std::span<Dual<Real>>(slopes));
      at[j].slope = Real(0);
      for (std::size_t i = 0; i < n; ++i) out[i * n + j] = slopes[i].slope;
    }
  };
}

}  // namespace detail

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
  return {std::move(q), std::move(acceleration), std::move(slope), {}};
}

template <RealType Real>
[[nodiscard]] Problem<Real> first_order_problem(std::vector<Real> y, Slope<Real> slope) {
  return {std::move(y), {}, std::move(slope), {}};
}

// y' = f(y) of a formula for any number: formula(span<const T> y, span<T> out) with T Real or Dual<Real>.
template <RealType Real, class Formula>
[[nodiscard]] Problem<Real> autonomous_problem(std::vector<Real> y, Formula formula) {
  Slope<Real> slope = [formula](const Real&, std::span<const Real> at, std::span<Real> out) {
    formula(at, out);
  };
  return {std::move(y), {}, std::move(slope), detail::jacobian_of<Real>(formula)};
}

// q'' = a(q) of such a formula for a.
template <RealType Real, class Formula>
[[nodiscard]] Problem<Real> autonomous_second_order_problem(std::vector<Real> q, const std::vector<Real>& v,
                                                            Formula formula) {
  const std::size_t n = q.size();
  Problem<Real> problem = second_order_problem<Real>(
      std::move(q), v, [formula](std::span<const Real> at, std::span<Real> out) { formula(at, out); });
  problem.jacobian = detail::jacobian_of<Real>([formula, n]<class T>(std::span<const T> y, std::span<T> out) {
    for (std::size_t i = 0; i < n; ++i) out[i] = y[n + i];
    formula(y.first(n), out.subspan(n));
  });
  return problem;
}

}  // namespace ulpgate::ode
