// step_plan().
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <tuple>

#include "harness/core/trajectories/trajectory_cases.hpp"
#include "kernels/ode/error_control/adaptive.hpp"
#include "kernels/ode/error_control/gragg_stepper.hpp"
#include "kernels/ode/error_control/newton_stepper.hpp"
#include "kernels/ode/problems/initial_value_cases.hpp"

namespace ulpgate {

namespace {

[[nodiscard]] StepPlan planned(std::string_view problem, std::string_view end, double tolerance) {
  for (const auto& c : ode::initial_value_cases<double>()) {
    if (c.name != problem) continue;
    std::unique_ptr<ode::ErrorStepper<double>> stepper;
    if (c.stiff) {
      stepper = std::make_unique<ode::NewtonStepper<double>>(c.problem, ode::CollocationNodes::radau, 3);
    } else {
      stepper = std::make_unique<ode::GraggStepper<double>>(c.problem, 4);
    }
    // Components of E5 fall below the range of double; what is that small asks for no steps.
    // Components of an orbit pass through 0, and concentrations that begin there rise as a power of time that
    // the method need not follow.
    double size = 0;
    for (const double x : c.problem.start) size = std::max(size, std::abs(x));
    const double absolute = c.name == "e5" ? 1e-36 : c.stiff ? 1e-8 * tolerance * size : tolerance;
    const ode::StepControl control{tolerance, absolute, 1'000'000};
    auto run = ode::integrate_adaptively<double>(*stepper, ode::end_time<double>(end), 1e-6, control);
    if (run.end != ode::AdaptiveEnd::reached)
      throw std::runtime_error("no steps for " + c.name + ": " + std::string(to_string(run.end)));
    run.steps.pop_back();
    return {std::move(run.steps)};
  }
  throw std::invalid_argument("no initial value problem is called '" + std::string(problem) + "'");
}

}  // namespace

const StepPlan& step_plan(std::string_view problem, std::string_view end, double tolerance) {
  static std::mutex mutex;
  static std::map<std::tuple<std::string, std::string, double>, std::unique_ptr<const StepPlan>> known;
  const std::scoped_lock lock(mutex);
  auto& plan = known[{std::string(problem), std::string(end), tolerance}];
  if (!plan) plan = std::make_unique<const StepPlan>(planned(problem, end, tolerance));
  return *plan;
}

}  // namespace ulpgate
