// OrderEngineOf<Real>: OrderEngine over the integrators; included only by the one translation unit of each
// type.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "harness/core/orders/order_engine.hpp"
#include "kernels/ode/integrators/error_ladder.hpp"
#include "reference/text/text.hpp"

namespace ulpgate {

template <RealType Real>
class OrderEngineOf final : public OrderEngine {
 public:
  explicit OrderEngineOf(std::string token)
      : token_(std::move(token)), problems_(ode::standard_problems<Real>()) {}

  [[nodiscard]] const std::string& token() const override { return token_; }

  [[nodiscard]] std::vector<std::string> problems() const override {
    std::vector<std::string> names;
    for (const auto& p : problems_) names.push_back(p.name);
    return names;
  }

  [[nodiscard]] bool applies(std::string_view integrator, std::string_view problem) const override {
    return ode::find_integrator(integrator).kind != ode::IntegratorKind::splitting ||
           static_cast<bool>(find(problem).problem.acceleration);
  }

  [[nodiscard]] OrderLadder ladder(std::string_view integrator, std::string_view problem,
                                   long most_steps) const override {
    using std::ldexp;
    const ode::SolvedProblem<Real>& solved = find(problem);
    const int exponent = interval_exponent(ode::find_integrator(integrator).order, most_steps);
    const Real t = ldexp(Real(1), exponent);
    // The floor of rounding is highest where weights are large and of both signs, as in extrapolation.
    const Real floor = 4096 * std::numeric_limits<Real>::epsilon();
    OrderLadder out;
    out.t_end = static_cast<double>(t);
    int below = 0;
    Real before(0);
    for (long steps = 1; steps <= most_steps && below < 2; steps *= 2) {
      const Real error = ode::error_at(integrator, solved, t, steps);
      OrderRung rung{
          steps, static_cast<double>(t) / static_cast<double>(steps), static_cast<double>(error), {}};
      using std::log2;
      if (before > 0 && error > 0) rung.order = static_cast<double>(log2(Real(before / error)));
      const bool above = error >= floor;
      if (above && rung.order) out.measured_order = rung.order;
      if (!above) ++below;
      out.rungs.push_back(rung);
      before = error;
    }
    return out;
  }

  [[nodiscard]] std::vector<dem::FlowText> flow(std::string_view integrator) const override {
    std::vector<dem::FlowText> parts;
    for (const auto& part : ode::splitting<RealHP<4, Real>>(integrator))
      parts.push_back({part.flow == ode::kKick, to_hexfloat(part.fraction)});
    return parts;
  }

  [[nodiscard]] EnergyDrift drift(std::string_view integrator, std::string_view problem, long steps_per_unit,
                                  long units) const override {
    const ode::SolvedProblem<Real>& solved = find(problem);
    const auto stepper = ode::make_stepper<Real>(integrator, solved.problem);
    const Real start = solved.energy(stepper->state());
    const Real h = Real(1) / static_cast<Real>(steps_per_unit);
    EnergyDrift drift;
    for (long unit = 0; unit < units; ++unit) {
      for (long i = 0; i < steps_per_unit; ++i)
        stepper->advance(static_cast<Real>(unit) + static_cast<Real>(i) * h, h);
      drift.add(static_cast<double>(unit + 1),
                static_cast<double>(Real(solved.energy(stepper->state()) - start)));
    }
    return drift;
  }

 private:
  [[nodiscard]] const ode::SolvedProblem<Real>& find(std::string_view name) const {
    for (const auto& p : problems_) {
      if (p.name == name) return p;
    }
    throw std::invalid_argument("no problem is called " + std::string(name));
  }

  // Of two: 0 for the unit interval.
  static int interval_exponent(std::optional<int> order, long most_steps) {
    if (!order) return 0;
    const double p = *order;
    const double floor = 6 - std::numeric_limits<Real>::digits;
    const double reached = p * (std::log2(static_cast<double>(most_steps)) - 1);
    return std::min(0, static_cast<int>(std::lround((floor + reached) / (p + 1))));
  }

  std::string token_;
  std::vector<ode::SolvedProblem<Real>> problems_;
};

}  // namespace ulpgate
