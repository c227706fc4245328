// How true solutions are integrated: a stiff or another method with control of its step, to one time after
// another.  Included by the sources that make truths.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "kernels/ode/error_control/adaptive.hpp"
#include "kernels/ode/error_control/gragg_stepper.hpp"
#include "kernels/ode/integrators/make_stepper.hpp"
#include "kernels/ode/problems/e5_logarithmic.hpp"
#include "kernels/ode/problems/initial_value_cases.hpp"

namespace ulpgate::truth {

template <RealType Real>
struct Prepared {
  ode::Problem<Real> problem;
  bool stiff;
  // The components of the case, of a state of `problem`.
  std::function<std::vector<Real>(std::span<const Real>)> components;
};

// Throws std::invalid_argument where there is no such case, or it has no such end.
template <RealType Real>
[[nodiscard]] Prepared<Real> prepare(std::string_view name, std::string_view end) {
  for (auto& c : ode::initial_value_cases<Real>()) {
    if (c.name != name) continue;
    if (std::ranges::find(c.ends, end) == c.ends.end())
      throw std::invalid_argument("'" + std::string(end) + "' is no end of " + c.name);
    if (name == "e5") return {ode::e5_logarithmic<Real>(), true, ode::e5_components<Real>};
    return {c.problem, c.stiff,
            [](std::span<const Real> y) { return std::vector<Real>(y.begin(), y.end()); }};
  }
  throw std::invalid_argument("no initial value problem is called '" + std::string(name) + "'");
}

// How one integration is made: stages of Radau IIA or columns of the extrapolation, and the tolerance of a
// step.
struct Setting {
  int order;
  double tolerance;
};

// The components at each of the rising times.  Throws std::runtime_error where one is not reached, and
// ode::Stopped.
template <RealType Real>
[[nodiscard]] std::vector<std::vector<Real>> integrated(const Prepared<Real>& p, std::span<const Real> times,
                                                        const Setting& setting, int digits,
                                                        const ode::StopFlag& stop) {
  std::unique_ptr<ode::ErrorStepper<Real>> stepper;
  if (p.stiff) {
    stepper = ode::make_newton_stepper<Real>(p.problem, ode::CollocationNodes::radau, setting.order,
                                             pow(Real(10), -(digits + 12)));
  } else {
    stepper = std::make_unique<ode::GraggStepper<Real>>(p.problem, setting.order);
  }
  stepper->set_stop(stop);
  // Components of an orbit pass through 0, where none of their digits can be asked for; concentrations do
  // not.
  const ode::StepControl control{setting.tolerance, p.stiff ? 0 : setting.tolerance, 4'000'000};
  std::vector<std::vector<Real>> states;
  Real before(0);
  Real first = real<Real>("1e-8");
  for (const Real& time : times) {
    const Real left = time - before;
    const auto run = ode::integrate_adaptively<Real>(*stepper, left, first, control, stop);
    if (run.end != ode::AdaptiveEnd::reached) throw std::runtime_error(std::string(to_string(run.end)));
    states.push_back(p.components(stepper->state()));
    // The last step was cut short by the time; one that is too long is tried again.
    first = run.steps.size() > 1 ? run.steps[run.steps.size() - 2] : std::max<Real>(first, 2 * left);
    before = time;
  }
  return states;
}

// Digits on which two numbers agree, relative to `size`.
template <RealType Real>
[[nodiscard]] double agreement(const Real& a, const Real& b, const Real& size) {
  using std::abs, std::log10;
  if (a == b) return HUGE_VAL;
  if (size == 0) return 0;
  return -static_cast<double>(Real(log10(Real(abs(Real(a - b)) / size))));
}

}  // namespace ulpgate::truth
