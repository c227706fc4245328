// make_stepper(): any integrator of the list, step by step; make_newton_stepper(): one of any number of
// stages.
#pragma once

#include <memory>
#include <string_view>

#include "kernels/ode/coefficients/collocation.hpp"
#include "kernels/ode/integrators/integrators.hpp"
#include "kernels/ode/stepper/error_stepper.hpp"

namespace ulpgate::ode {

// An integrator at the start of a problem.  Throws std::invalid_argument for an unknown name, an empty
// problem, a splitting method on a problem that is not q'' = a(q), and a Rosenbrock method on one without its
// Jacobian.
// Its body is in make_stepper_impl.hpp: the library has it for the types of the build, each in a translation
// unit of its own, since every integrator in one type takes as long to compile as all that uses them.
template <RealType Real>
[[nodiscard]] std::unique_ptr<Stepper<Real>> make_stepper(std::string_view name, Problem<Real> problem);

// A NewtonStepper, with its estimate of errors, whose iteration ends at `tolerance` (0: where rounding ends
// it). Here for the same reason.
template <RealType Real>
[[nodiscard]] std::unique_ptr<ErrorStepper<Real>> make_newton_stepper(Problem<Real> problem,
                                                                      CollocationNodes nodes, int stages,
                                                                      const Real& tolerance = Real(0));

}  // namespace ulpgate::ode
