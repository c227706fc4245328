// The bodies of make_stepper() and make_newton_stepper(); included only by the one translation unit of each
// type.
#pragma once

#include "kernels/ode/error_control/newton_stepper.hpp"
#include "kernels/ode/error_control/rosenbrock.hpp"
#include "kernels/ode/integrators/explicit_runge_kutta.hpp"
#include "kernels/ode/integrators/gauss_legendre.hpp"
#include "kernels/ode/integrators/make_stepper.hpp"
#include "kernels/ode/integrators/odeint_steppers.hpp"
#include "kernels/ode/integrators/splitting_stepper.hpp"

namespace ulpgate::ode {

template <RealType Real>
std::unique_ptr<ErrorStepper<Real>> make_newton_stepper(Problem<Real> problem, CollocationNodes nodes,
                                                        int stages, const Real& tolerance) {
  auto stepper = std::make_unique<NewtonStepper<Real>>(std::move(problem), nodes, stages);
  stepper->set_newton_tolerance(tolerance);
  return stepper;
}

template <RealType Real>
std::unique_ptr<Stepper<Real>> make_stepper(std::string_view name, Problem<Real> problem) {
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

}  // namespace ulpgate::ode
