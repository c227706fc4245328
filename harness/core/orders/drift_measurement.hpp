// DriftOf<Real>: the energy error of an integrator along many units of time; a piece is a slice of the steps.
#pragma once

#include "harness/core/orders/order_engine.hpp"
#include "harness/core/orders/piece_text.hpp"
#include "kernels/ode/integrators/make_stepper.hpp"
#include "kernels/ode/problems/problems.hpp"

namespace ulpgate {

template <RealType Real>
class DriftOf final : public DriftMeasurement {
 public:
  // `solved` must outlive the measurement.
  DriftOf(std::string_view integrator, const ode::SolvedProblem<Real>& solved, long steps_per_unit,
          long units)
      : integrator_(integrator),
        solved_(solved),
        steps_per_unit_(steps_per_unit),
        units_(units),
        start_(solved.energy(solved.problem.start)),
        state_(solved.problem.start) {}

  [[nodiscard]] bool complete() const override { return refusal() || unit_ >= units_; }
  [[nodiscard]] const EnergyDrift& drift() const override { return drift_; }
  [[nodiscard]] std::uint64_t steps_done() const override {
    return static_cast<std::uint64_t>(unit_ * steps_per_unit_ + step_);
  }
  [[nodiscard]] std::uint64_t expected_steps_left() const override {
    return complete() ? 0 : static_cast<std::uint64_t>(units_ * steps_per_unit_) - steps_done();
  }

 protected:
  // "STEPS_DONE ERRORS STATE MEMORY": what a new stepper needs to go on.
  [[nodiscard]] std::string measure_piece(long steps, const ode::StopFlag& stop) override {
    // Only now: the coefficients of some methods take a while.
    if (!stepper_) {
      stepper_ = ode::make_stepper<Real>(integrator_, solved_.problem);
      if (steps_done() > 0) stepper_->restore(state_, memory_);
    }
    stepper_->set_stop(stop);
    const Real h = Real(1) / static_cast<Real>(steps_per_unit_);
    std::vector<double> errors;
    std::optional<std::vector<Real>> memory;
    for (long i = 1; unit_ < units_ && !memory; ++i) {
      stop.check();
      stepper_->advance(static_cast<Real>(unit_) + static_cast<Real>(step_) * h, h);
      if (++step_ == steps_per_unit_) {
        errors.push_back(static_cast<double>(Real(solved_.energy(stepper_->state()) - start_)));
        step_ = 0;
        drift_.add(static_cast<double>(++unit_), errors.back());
      }
      if (i >= steps) memory = stepper_->memory();
    }
    return std::to_string(steps_done()) + " " + list_text<double>(errors) + " " +
           list_text<Real>(stepper_->state()) + " " + list_text<Real>(memory.value_or(std::vector<Real>()));
  }
  [[nodiscard]] bool take_piece(std::string_view piece) override {
    const auto words = words_of(piece, ' ');
    if (words.size() != 4) return false;
    const long done = count_of(words[0]);
    const auto errors = list_of<double>(words[1]);
    auto state = list_of<Real>(words[2]);
    auto memory = list_of<Real>(words[3]);
    const long unit = done / steps_per_unit_;
    if (done <= unit_ * steps_per_unit_ + step_ || unit > units_ ||
        static_cast<std::size_t>(unit - unit_) != errors.size() || state.size() != state_.size())
      return false;
    for (const double error : errors) drift_.add(static_cast<double>(++unit_), error);
    step_ = done % steps_per_unit_;
    state_ = std::move(state);
    memory_ = std::move(memory);
    stepper_.reset();
    return true;
  }

 private:
  std::string integrator_;
  const ode::SolvedProblem<Real>& solved_;
  long steps_per_unit_;
  long units_;
  Real start_;  // energy
  long unit_ = 0;
  long step_ = 0;  // of the unit
  EnergyDrift drift_;
  std::unique_ptr<ode::Stepper<Real>> stepper_;
  // Where a stepper that is still to be made starts.
  std::vector<Real> state_;
  std::vector<Real> memory_;
};

}  // namespace ulpgate
