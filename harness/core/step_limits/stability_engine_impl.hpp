// StabilityEngineOf<Real>: StabilityEngine over the integrators; included only by the one translation unit of
// each type.
#pragma once

#include <cmath>
#include <memory>

#include "harness/core/step_limits/stability_engine.hpp"
#include "kernels/ode/integrators/make_stepper.hpp"

namespace ulpgate {

template <RealType Real>
class StabilityEngineOf final : public StabilityEngine {
 public:
  [[nodiscard]] int significand_bits() const override { return std::numeric_limits<Real>::digits; }

  [[nodiscard]] StepFactor oscillator(std::string_view integrator, double z) const override {
    using std::abs, std::sqrt;
    const bool symplectic = ode::find_integrator(integrator).kind == ode::IntegratorKind::splitting ||
                            integrator.starts_with("gauss");
    const auto acceleration = [](auto q, auto a) { a[0] = -q[0]; };
    StepFactor f;
    const std::vector<Real> first =
        step(integrator, ode::autonomous_second_order_problem<Real>({Real(1)}, {Real(0)}, acceleration), z,
             f.refusal);
    const std::vector<Real> second =
        step(integrator, ode::autonomous_second_order_problem<Real>({Real(0)}, {Real(1)}, acceleration), z,
             f.refusal);
    if (!f.refusal.empty()) return f;
    const Real half = (first[0] + second[1]) / 2;
    const Real determinant = first[0] * second[1] - first[1] * second[0];
    // The eigenvalues are half +- sqrt(half^2 - determinant); those of a symplectic step with determinant 1.
    const Real one(1);
    const Real product = symplectic ? one : determinant;
    const Real square = half * half - product;
    Real growth;
    if (square > 0) {
      growth = abs(half) - one + sqrt(square);
    } else {
      growth = (product - one) / (sqrt(product) + one);
    }
    f.growth = static_cast<double>(growth);
    f.excess = symplectic ? static_cast<double>(Real(abs(half) - one)) : f.growth;
    f.half_trace = static_cast<double>(half);
    f.determinant = static_cast<double>(determinant);
    for (const auto* column : {&first, &second}) {
      for (const Real& x : *column) f.norm = std::fmax(f.norm, static_cast<double>(abs(x)));
    }
    return f;
  }

  [[nodiscard]] StepFactor decay(std::string_view integrator, double z) const override {
    using std::abs;
    const auto slope = [](auto y, auto out) { out[0] = -y[0]; };
    StepFactor f;
    const std::vector<Real> y =
        step(integrator, ode::autonomous_problem<Real>({Real(1)}, slope), z, f.refusal);
    if (!f.refusal.empty()) return f;
    f.half_trace = static_cast<double>(y[0]);
    f.excess = f.growth = static_cast<double>(Real(abs(y[0]) - 1));
    f.norm = std::fabs(f.half_trace);
    return f;
  }

 private:
  [[nodiscard]] static std::vector<Real> step(std::string_view integrator, ode::Problem<Real> problem,
                                              double z, std::string& refusal) {
    const auto stepper = ode::make_stepper<Real>(integrator, std::move(problem));
    try {
      stepper->advance(Real(0), Real(z));
    } catch (const std::runtime_error& e) {
      refusal = e.what();
    }
    return {stepper->state().begin(), stepper->state().end()};
  }
};

}  // namespace ulpgate
