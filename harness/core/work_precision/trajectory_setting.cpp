// TrajectorySetting.
#include "harness/core/work_precision/trajectory_setting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/core/trajectories/truth.hpp"
#include "kernels/ode/integrators/integrators.hpp"

namespace ulpgate {

namespace {

// A state so many times as large as the solution has nothing to do with it any more.
constexpr double diverged_error = 1e3;
// Of an implicit method or one that chooses its order.
constexpr double iterations = 8;

double decimal_digits(int significand_bits) {
  return significand_bits * std::numbers::log10e_v<double> * std::numbers::ln2_v<double>;
}

}  // namespace

SharedTruth shared_truth(const std::string& problem, const std::string& end, int digits) {
  return std::make_shared<Shared<TrajectoryTruth>>([=](const ode::StopFlag& stop) {
    TrajectoryTruth truth;
    double least = 0;
    for (const auto& component : true_solution(problem, end, digits, stop)) {
      least = truth.state.empty() ? component.digits : std::min(least, component.digits);
      truth.state.push_back(component.value);
    }
    truth.error = std::pow(10.0, -least);
    return truth;
  });
}

double evaluations_of_step(std::string_view integrator) {
  const auto& info = ode::find_integrator(integrator);
  return info.evaluations_per_step.value_or(iterations * std::max(info.stages, 4));
}

TrajectorySetting::TrajectorySetting(WorkSetting setting, const TrajectoryEngine& engine, SharedTruth truth,
                                     double budget)
    : SettingMeasurement(std::move(setting)), engine_(engine), truth_(std::move(truth)), budget_(budget) {}

Trajectory TrajectorySetting::run(const ode::StopFlag& stop) const {
  const WorkSetting& s = setting();
  return engine_.equal_steps(s.name, s.integrator, s.end, s.steps, stop);
}

SettingMeasurement::Work TrajectorySetting::prepare() const {
  return [this](const ode::StopFlag& stop) { static_cast<void>(run(stop)); };
}

WorkOutcome TrajectorySetting::measure(const ode::StopFlag& stop) {
  const double expected = evaluations_of_step(setting().integrator) * static_cast<double>(setting().steps);
  if (expected > budget_) {
    throw std::runtime_error(
        fmt::format("about {:.3g} evaluations are more than the budget of {:.3g}", expected, budget_));
  }
  const TrajectoryTruth& truth = truth_->get(stop);
  const Trajectory got = run(stop);
  WorkOutcome o;
  o.steps = got.steps;
  o.evaluations = got.evaluations;
  if (!got.refusal.empty()) {
    o.failure = WorkFailure::refused;
    o.why = got.refusal;
    return o;
  }
  const double error = got.finite ? relative_distance(got.state, truth.state) : HUGE_VAL;
  // Written so that an error that is no number has diverged.
  if (!(error <= diverged_error)) {
    o.failure = WorkFailure::diverged;
    if (!got.finite) o.steps = got.first_not_finite;
    o.why = got.finite ? fmt::format("the state is off by {:.3g} times the solution", error)
                       : fmt::format("the state is not finite behind step {}", got.first_not_finite);
    return o;
  }
  o.final_error = error;
  o.reference_error = truth.error;
  if (got.largest_invariant_error && std::isfinite(*got.largest_invariant_error))
    o.energy_error = got.largest_invariant_error;
  o.correct_digits =
      correct_digits_of(std::max(error, truth.error), decimal_digits(engine_.significand_bits()));
  return o;
}

}  // namespace ulpgate
