// Adapters to Boost.odeint's explicit methods.
//
// Its tableaux of Cash-Karp and Fehlberg and its extrapolation coefficients are ratios of integers formed in
// the value type, so they hold in every Real; the tests check them by their order conditions.  The double
// literals of its bulirsch_stoer only steer the step size.
#pragma once

#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/extrapolation_stepper.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "kernels/ode/stepper/stepper.hpp"

namespace ulpgate::ode {

template <RealType Real>
using CashKarp54 =
    boost::numeric::odeint::runge_kutta_cash_karp54<std::vector<Real>, Real, std::vector<Real>, Real>;
template <RealType Real>
using Fehlberg78 =
    boost::numeric::odeint::runge_kutta_fehlberg78<std::vector<Real>, Real, std::vector<Real>, Real>;
template <RealType Real>
using Extrapolation8 =
    boost::numeric::odeint::extrapolation_stepper<8, std::vector<Real>, Real, std::vector<Real>, Real>;

// One step of Method per call, from one vector into another: in place, extrapolation_stepper of Boost 1.81
// overwrites the start of the step before it has read it for the last time.
template <RealType Real, class Method>
class OdeintStepper final : public Stepper<Real> {
 public:
  using Stepper<Real>::Stepper;
  void advance(const Real& t, const Real& h) override {
    const auto system = [this](const std::vector<Real>& y, std::vector<Real>& out, const Real& at) {
      this->problem().slope(at, y, out);
    };
    next_.resize(this->state().size());
    method_.do_step(system, this->state_to_advance(), t, next_, h);
    this->state_to_advance() = next_;
  }

 private:
  Method method_;
  std::vector<Real> next_;
};

// range_algebra with a norm that compiles: that of Boost 1.81 asks each number for its value_type until none
// is left, which never ends for Boost.Multiprecision.
template <RealType Real>
struct RangeAlgebra : boost::numeric::odeint::range_algebra {
  [[nodiscard]] static Real norm_inf(const std::vector<Real>& y) {
    using std::abs;
    Real largest(0);
    for (const Real& x : y) {
      if (!(abs(x) <= largest)) largest = abs(x);
    }
    return largest;
  }
};

// As many controlled steps per call as hold the error of each below 2^8 units of rounding.  Throws
// std::runtime_error when that takes more than a million trials.
//
// It always steps forward, in time reflected where h < 0: bulirsch_stoer of Boost 1.81 compares works per
// step as if they were positive, and backward its steps shrink to nothing.
template <RealType Real>
class BulirschStoerStepper final : public Stepper<Real> {
 public:
  explicit BulirschStoerStepper(Problem<Real> problem)
      : Stepper<Real>(std::move(problem)), method_(tolerance(), tolerance()) {}

  void advance(const Real& t, const Real& h) override {
    const Real sign = h < 0 ? Real(-1) : Real(1);
    const auto system = [this, sign](const std::vector<Real>& y, std::vector<Real>& out, const Real& at) {
      this->problem().slope(Real(sign * at), y, out);
      if (sign < 0) {
        for (Real& x : out) x = -x;
      }
    };
    Real now = sign * t;
    const Real end = now + sign * h;
    Real step = proposed_ == 0 ? Real(sign * h) : proposed_;
    for (int trial = 0; trial < 1'000'000; ++trial) {
      this->stop().check();
      const bool last = step >= end - now;
      // What is left is shorter than the proposal: take it, and remember the proposal for the next call.
      if (last) {
        proposed_ = step;
        step = end - now;
      }
      const Real tried = step;
      const bool accepted =
          method_.try_step(system, this->state_to_advance(), now, step) == boost::numeric::odeint::success;
      last_ = step;
      if (accepted && last) return;
      // After two rejections odeint may propose the same step for ever.
      if (!accepted && !(step < tried)) step = tried / 2;
    }
    throw std::runtime_error("Bulirsch-Stoer: a million trials did not reach the end of the step");
  }

  // The method forgets everything when it is given another step size than it proposed last, as it nearly
  // always is at the start of a call: the proposal from before the call's end was cut to what was left.
  [[nodiscard]] std::optional<std::vector<Real>> memory() const override {
    if (proposed_ == last_ && proposed_ != 0) return std::nullopt;
    return std::vector<Real>{proposed_};
  }

 protected:
  [[nodiscard]] bool remember(const std::vector<Real>& memory) override {
    if (memory.size() != 1) return false;
    proposed_ = memory[0];
    last_ = Real(0);
    method_.reset();
    return true;
  }

 private:
  [[nodiscard]] static Real tolerance() { return 256 * std::numeric_limits<Real>::epsilon(); }

  boost::numeric::odeint::bulirsch_stoer<std::vector<Real>, Real, std::vector<Real>, Real, RangeAlgebra<Real>>
      method_;
  Real proposed_{0};
  Real last_{0};  // what the method proposed last
};

}  // namespace ulpgate::ode
