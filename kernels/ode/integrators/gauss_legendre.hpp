// Gauss-Legendre collocation: the implicit Runge-Kutta methods of s stages and order 2s.
//
// J. C. Butcher, Math. Comp. 18 (1964) 50; E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration
// (2006), II.1.3 (tableau), VIII.6 (iteration).
#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "kernels/ode/integrators/stepper.hpp"
#include "reference/types/guard_digits.hpp"

namespace ulpgate::ode {

template <RealType Real>
struct CollocationTableau {
  std::vector<Real> c;               // nodes in (0, 1)
  std::vector<Real> b;               // weights
  std::vector<std::vector<Real>> a;  // a[i][j]: weight of stage j in stage i
};

namespace detail {

// P_s(x) and P_s'(x) for |x| < 1 by the three-term recurrence.
template <RealType Real>
[[nodiscard]] std::pair<Real, Real> legendre(int s, const Real& x) {
  Real before(1);
  Real value = x;
  for (int k = 2; k <= s; ++k) {
    const Real next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
    before = value;
    value = next;
  }
  return {value, Real(s * (before - x * value) / (1 - x * x))};
}

template <RealType Real>
[[nodiscard]] Real legendre_root(int s, int i) {
  using std::abs, std::acos, std::cos, std::ldexp;
  // Within a few percent of the root: M. Abramowitz, I. A. Stegun (1964), 22.16.6.
  const Real pi = acos(Real(-1));
  Real x = cos(pi * (4 * i + 3) / (4 * s + 2));
  const Real settled = ldexp(Real(1), -std::numeric_limits<Real>::digits + 8);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const auto [value, slope] = legendre(s, x);
    const Real step = value / slope;
    x -= step;
    if (abs(step) < settled) return x;
  }
  throw std::logic_error("the nodes of Gauss-Legendre quadrature were not found");
}

}  // namespace detail

// The tableau in Real itself; its last digits carry the rounding of the recurrences.
template <RealType Real>
[[nodiscard]] CollocationTableau<Real> compute_gauss_tableau(int stages) {
  const auto s = static_cast<std::size_t>(stages);
  CollocationTableau<Real> t{std::vector<Real>(s), std::vector<Real>(s), {}};
  for (std::size_t i = 0; i < s; ++i) {
    const Real x = -detail::legendre_root<Real>(stages, static_cast<int>(i));
    const Real slope = detail::legendre(stages, x).second;
    t.c[i] = (1 + x) / 2;
    t.b[i] = 1 / ((1 - x * x) * slope * slope);
  }
  // a_ij is the integral of the Lagrange polynomial l_j from 0 to c_i, which the rule itself gives exactly:
  // l_j has degree s - 1.
  t.a.assign(s, std::vector<Real>(s, Real(0)));
  for (std::size_t i = 0; i < s; ++i) {
    for (std::size_t k = 0; k < s; ++k) {
      const Real at = t.c[i] * t.c[k];
      for (std::size_t j = 0; j < s; ++j) {
        Real lagrange(1);
        for (std::size_t m = 0; m < s; ++m) {
          if (m != j) lagrange *= (at - t.c[m]) / (t.c[j] - t.c[m]);
        }
        t.a[i][j] += t.c[i] * t.b[k] * lagrange;
      }
    }
  }
  return t;
}

// The tableau computed with guard digits, rounded once and kept.
template <RealType Real>
[[nodiscard]] const CollocationTableau<Real>& gauss_tableau(int stages) {
  static std::mutex mutex;
  static std::map<int, CollocationTableau<Real>> known;
  const std::scoped_lock lock(mutex);
  if (const auto found = known.find(stages); found != known.end()) return found->second;
  const CollocationTableau<Guarded<Real>> wide = compute_gauss_tableau<Guarded<Real>>(stages);
  CollocationTableau<Real> t;
  for (const auto& x : wide.c) t.c.push_back(rounded<Real>(x));
  for (const auto& x : wide.b) t.b.push_back(rounded<Real>(x));
  for (const auto& row : wide.a) {
    t.a.emplace_back();
    for (const auto& x : row) t.a.back().push_back(rounded<Real>(x));
  }
  return known.emplace(stages, std::move(t)).first->second;
}

// Stages by fixed-point iteration, each using those already renewed, until they stop changing.  Converges for
// h times the Lipschitz constant of f below about 1; otherwise throws std::runtime_error.
template <RealType Real>
class GaussStepper final : public Stepper<Real> {
 public:
  GaussStepper(Problem<Real> problem, const CollocationTableau<Real>& tableau)
      : Stepper<Real>(std::move(problem)),
        t_(tableau),
        stage_(this->state().size()),
        slopes_(tableau.c.size(), stage_) {}

  void advance(const Real& t, const Real& h) override {
    std::vector<Real>& y = this->state_to_advance();
    this->problem().slope(t, y, slopes_[0]);
    for (std::size_t i = 1; i < slopes_.size(); ++i) slopes_[i] = slopes_[0];
    iterate(t, h);
    for (std::size_t d = 0; d < y.size(); ++d) {
      Real sum(0);
      for (std::size_t i = 0; i < slopes_.size(); ++i) sum += t_.b[i] * slopes_[i][d];
      y[d] += h * sum;
    }
  }

 private:
  void iterate(const Real& t, const Real& h) {
    using std::isfinite;
    constexpr int limit = 100 + std::numeric_limits<Real>::digits;
    Real before = std::numeric_limits<Real>::infinity();
    for (int iteration = 0; iteration < limit; ++iteration) {
      const auto [change, size] = renew_stages(t, h);
      if (!isfinite(size) || !isfinite(change)) break;
      // Once a change is a matter of rounding it no longer shrinks, and may never become zero.
      const bool rounding = change <= 64 * std::numeric_limits<Real>::epsilon() * size;
      if (change == 0 || (rounding && change >= before)) return;
      before = change;
    }
    throw std::runtime_error("Gauss-Legendre: the stages do not converge at this step size");
  }

  // One sweep; the largest change of a slope, and the largest slope.
  std::pair<Real, Real> renew_stages(const Real& t, const Real& h) {
    using std::abs;
    const std::span<const Real> y = this->state();
    Real change(0);
    Real size(0);
    std::vector<Real> slope(y.size());
    for (std::size_t i = 0; i < slopes_.size(); ++i) {
      for (std::size_t d = 0; d < y.size(); ++d) {
        Real sum(0);
        for (std::size_t j = 0; j < slopes_.size(); ++j) sum += t_.a[i][j] * slopes_[j][d];
        stage_[d] = y[d] + h * sum;
      }
      this->problem().slope(Real(t + t_.c[i] * h), stage_, slope);
      for (std::size_t d = 0; d < y.size(); ++d) {
        const Real moved = abs(slope[d] - slopes_[i][d]);
        if (!(moved <= change)) change = moved;
        if (abs(slope[d]) > size) size = abs(slope[d]);
      }
      slopes_[i] = slope;
    }
    return {change, size};
  }

  const CollocationTableau<Real>& t_;
  std::vector<Real> stage_;
  std::vector<std::vector<Real>> slopes_;
};

}  // namespace ulpgate::ode
