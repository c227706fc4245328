// Gauss-Legendre collocation: the implicit Runge-Kutta methods of s stages and order 2s.
//
// J. C. Butcher, Math. Comp. 18 (1964) 50; E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration
// (2006), II.1.3 (tableau), VIII.6 (iteration).
#pragma once

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "kernels/ode/coefficients/collocation.hpp"
#include "kernels/ode/stepper/stepper.hpp"

namespace ulpgate::ode {

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
