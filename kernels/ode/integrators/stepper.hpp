// What every integrator does: own the state of a problem and advance it by a step.
#pragma once

#include <span>
#include <vector>

#include "kernels/ode/problems/problem.hpp"

namespace ulpgate::ode {

template <RealType Real>
class Stepper {
 public:
  explicit Stepper(Problem<Real> problem) : problem_(std::move(problem)), state_(problem_.start) {}
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;
  virtual ~Stepper() = default;

  // From time t to t + h.
  virtual void advance(const Real& t, const Real& h) = 0;
  [[nodiscard]] std::span<const Real> state() const { return state_; }

 protected:
  [[nodiscard]] const Problem<Real>& problem() const { return problem_; }
  [[nodiscard]] std::vector<Real>& state_to_advance() { return state_; }

 private:
  Problem<Real> problem_;
  std::vector<Real> state_;
};

}  // namespace ulpgate::ode
