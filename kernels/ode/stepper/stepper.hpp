// What every integrator does: own the state of a problem and advance it by a step.
#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "kernels/ode/problems/problem.hpp"
#include "kernels/ode/stepper/stop_flag.hpp"

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

  // What a new stepper of the same kind must be given beside the state to go on with the same bits; nothing
  // where that cannot be told at this moment: ask again after the next step.
  [[nodiscard]] virtual std::optional<std::vector<Real>> memory() const { return std::vector<Real>(); }
  // Throws std::invalid_argument where the numbers are not as many as state() and memory() give.
  void restore(std::vector<Real> state, const std::vector<Real>& memory) {
    if (state.size() != state_.size() || !remember(memory))
      throw std::invalid_argument("the state is not one of this stepper");
    state_ = std::move(state);
  }
  // A step that may take long looks at it; it then ends by Stopped.
  void set_stop(const StopFlag& stop) { stop_ = stop; }

 protected:
  // Takes over what memory() gave; false where it is none of this kind.
  [[nodiscard]] virtual bool remember(const std::vector<Real>& memory) { return memory.empty(); }
  [[nodiscard]] const StopFlag& stop() const { return stop_; }
  [[nodiscard]] const Problem<Real>& problem() const { return problem_; }
  [[nodiscard]] std::vector<Real>& state_to_advance() { return state_; }

 private:
  Problem<Real> problem_;
  std::vector<Real> state_;
  StopFlag stop_;
};

}  // namespace ulpgate::ode
