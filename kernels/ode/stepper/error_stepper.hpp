// ErrorStepper: a stepper that estimates the error of a step before it takes it.
#pragma once

#include "kernels/ode/stepper/stepper.hpp"

namespace ulpgate::ode {

template <RealType Real>
class ErrorStepper : public Stepper<Real> {
 public:
  using Stepper<Real>::Stepper;

  // Tries the step from t to t + h; false where its equations have no solution that is found.
  [[nodiscard]] virtual bool attempt(const Real& t, const Real& h) = 0;
  // Of the last attempt that came back with true: the state at t + h, and an estimate of its error, which
  // falls with the power error_order() of h.
  [[nodiscard]] std::span<const Real> candidate() const { return candidate_; }
  [[nodiscard]] std::span<const Real> error() const { return error_; }
  [[nodiscard]] virtual int error_order() const = 0;
  void accept() { this->state_to_advance() = candidate_; }

  // Throws std::runtime_error where attempt() finds no solution.
  void advance(const Real& t, const Real& h) override {
    if (!attempt(t, h)) throw std::runtime_error(failure());
    accept();
  }

 protected:
  // What an attempt that failed is called.
  [[nodiscard]] virtual std::string failure() const = 0;

  std::vector<Real> candidate_;
  std::vector<Real> error_;
};

}  // namespace ulpgate::ode
