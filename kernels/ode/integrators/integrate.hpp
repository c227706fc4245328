// Any integrator of the list on any problem: integrate() and, step by step, make_stepper().
#pragma once

#include <memory>

#include "kernels/ode/error_control/newton_stepper.hpp"
#include "kernels/ode/error_control/rosenbrock.hpp"
#include "kernels/ode/integrators/explicit_runge_kutta.hpp"
#include "kernels/ode/integrators/gauss_legendre.hpp"
#include "kernels/ode/integrators/integrators.hpp"
#include "kernels/ode/integrators/odeint_steppers.hpp"
#include "kernels/ode/integrators/splitting_stepper.hpp"

namespace ulpgate::ode {

// An integrator at the start of a problem.  Throws std::invalid_argument for an unknown name, an empty
// problem, a splitting method on a problem that is not q'' = a(q), and a Rosenbrock method on one without its
// Jacobian.
template <RealType Real>
[[nodiscard]] std::unique_ptr<Stepper<Real>> make_stepper(std::string_view name, Problem<Real> problem) {
  const IntegratorInfo& info = find_integrator(name);
  if (problem.start.empty() || !problem.slope) {
    throw std::invalid_argument("a problem needs a start and a slope");
  }
  if (info.kind == IntegratorKind::splitting) {
    if (!problem.acceleration) {
      throw std::invalid_argument(info.name + " integrates q'' = a(q) only; this problem is of first order");
    }
    return std::make_unique<SplittingStepper<Real>>(std::move(problem), splitting<Real>(name));
  }
  if (info.kind == IntegratorKind::collocation_newton) {
    const auto nodes = info.name.starts_with("radau") ? CollocationNodes::radau : CollocationNodes::gauss;
    auto stepper = std::make_unique<NewtonStepper<Real>>(std::move(problem), nodes, info.stages);
    // Steps of a given size need no estimate.
    stepper->estimate_errors(false);
    return stepper;
  }
  if (info.kind == IntegratorKind::rosenbrock) {
    return std::make_unique<RosenbrockStepper<Real>>(std::move(problem));
  }
  if (info.kind == IntegratorKind::collocation) {
    return std::make_unique<GaussStepper<Real>>(std::move(problem), gauss_tableau<Real>(*info.order / 2));
  }
  if (const ExplicitTableau* tableau = find_explicit_tableau(info.name)) {
    return std::make_unique<ExplicitRungeKuttaStepper<Real>>(std::move(problem), *tableau);
  }
  if (info.name == "cash_karp54") {
    return std::make_unique<OdeintStepper<Real, CashKarp54<Real>>>(std::move(problem));
  }
  if (info.name == "fehlberg78") {
    return std::make_unique<OdeintStepper<Real, Fehlberg78<Real>>>(std::move(problem));
  }
  if (info.name == "extrapolation8") {
    return std::make_unique<OdeintStepper<Real, Extrapolation8<Real>>>(std::move(problem));
  }
  if (info.name == "bulirsch_stoer") return std::make_unique<BulirschStoerStepper<Real>>(std::move(problem));
  throw std::logic_error(info.name + " is listed but not built");
}

// y(t_end) from y(0) by `steps` steps of equal size; for q'' = a(q) the positions, then the velocities.
// Throws std::invalid_argument as make_stepper does, for steps < 1 and for a t_end that is not finite, and
// Stopped when `stop` is raised.
template <RealType Real>
[[nodiscard]] std::vector<Real> integrate(std::string_view name, const Problem<Real>& problem,
                                          const Real& t_end, long steps, const StopFlag& stop = {}) {
  using std::isfinite;
  if (steps < 1) throw std::invalid_argument("integrate: steps must be at least 1");
  if (!isfinite(t_end)) throw std::invalid_argument("integrate: the end of time must be finite");
  const std::unique_ptr<Stepper<Real>> stepper = make_stepper<Real>(name, problem);
  stepper->set_stop(stop);
  const Real h = t_end / static_cast<Real>(steps);
  for (long i = 0; i < steps; ++i) {
    stop.check();
    stepper->advance(static_cast<Real>(i) * h, h);
  }
  return {stepper->state().begin(), stepper->state().end()};
}

}  // namespace ulpgate::ode
