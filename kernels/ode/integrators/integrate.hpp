// Any integrator of the list on any problem by equal steps.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "kernels/ode/integrators/make_stepper.hpp"

namespace ulpgate::ode {

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
