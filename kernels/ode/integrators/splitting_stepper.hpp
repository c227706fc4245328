// Advances q'' = a(q) by kicks and drifts.
#pragma once

#include "kernels/ode/integrators/splitting.hpp"
#include "kernels/ode/stepper/stepper.hpp"

namespace ulpgate::ode {

template <RealType Real>
class SplittingStepper final : public Stepper<Real> {
 public:
  SplittingStepper(Problem<Real> problem, const std::vector<Substep<Real>>& sequence)
      : Stepper<Real>(std::move(problem)), sequence_(sequence), a_(this->state().size() / 2) {}

  void advance(const Real& /*t*/, const Real& h) override {
    std::vector<Real>& y = this->state_to_advance();
    const std::size_t n = a_.size();
    for (const Substep<Real>& s : sequence_) {
      const Real dt = s.fraction * h;
      if (s.flow == kKick) {
        // The last kick of a step and the first of the next share one evaluation.
        if (!a_is_current_) this->problem().acceleration(std::span<const Real>(y).first(n), a_);
        a_is_current_ = true;
        for (std::size_t i = 0; i < n; ++i) y[n + i] += dt * a_[i];
      } else {
        for (std::size_t i = 0; i < n; ++i) y[i] += dt * y[n + i];
        a_is_current_ = false;
      }
    }
  }

 protected:
  [[nodiscard]] bool remember(const std::vector<Real>& memory) override {
    // a(q) is computed again, with the bits it had.
    a_is_current_ = false;
    return memory.empty();
  }

 private:
  std::vector<Substep<Real>> sequence_;
  std::vector<Real> a_;
  bool a_is_current_ = false;
};

}  // namespace ulpgate::ode
