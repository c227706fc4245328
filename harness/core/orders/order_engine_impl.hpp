// OrderEngineOf<Real>: OrderEngine over the integrators; included only by the one translation unit of each
// type.
#pragma once

#include <stdexcept>

#include "harness/core/orders/drift_measurement.hpp"
#include "harness/core/orders/ladder_measurement.hpp"
#include "kernels/ode/integrators/splitting.hpp"

namespace ulpgate {

template <RealType Real>
class OrderEngineOf final : public OrderEngine {
 public:
  OrderEngineOf() : problems_(ode::standard_problems<Real>()) {}

  [[nodiscard]] std::vector<std::string> problems() const override {
    std::vector<std::string> names;
    for (const auto& p : problems_) names.push_back(p.name);
    return names;
  }

  [[nodiscard]] bool applies(std::string_view integrator, std::string_view problem) const override {
    return ode::find_integrator(integrator).kind != ode::IntegratorKind::splitting ||
           static_cast<bool>(find(problem).problem.acceleration);
  }

  [[nodiscard]] std::unique_ptr<LadderMeasurement> ladder(std::string_view integrator,
                                                          std::string_view problem,
                                                          long most_steps) const override {
    return std::make_unique<LadderOf<Real>>(integrator, find(problem), most_steps);
  }

  [[nodiscard]] std::vector<dem::FlowText> flow(std::string_view integrator) const override {
    std::vector<dem::FlowText> parts;
    for (const auto& part : ode::splitting<RealHP<4, Real>>(integrator))
      parts.push_back({part.flow == ode::kKick, to_hexfloat(part.fraction)});
    return parts;
  }

  [[nodiscard]] std::unique_ptr<DriftMeasurement> drift(std::string_view integrator, std::string_view problem,
                                                        long steps_per_unit, long units) const override {
    return std::make_unique<DriftOf<Real>>(integrator, find(problem), steps_per_unit, units);
  }

 private:
  [[nodiscard]] const ode::SolvedProblem<Real>& find(std::string_view name) const {
    for (const auto& p : problems_) {
      if (p.name == name) return p;
    }
    throw std::invalid_argument("no problem is called " + std::string(name));
  }

  std::vector<ode::SolvedProblem<Real>> problems_;
};

}  // namespace ulpgate
