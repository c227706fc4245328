// OrderEngine: integrators on exactly solved problems, behind an interface that knows no number type.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/core/orders/measurement.hpp"
#include "harness/core/scenes/energy_drift.hpp"
#include "kernels/dem/engine/engine.hpp"

namespace ulpgate {

// The error after `steps` equal steps of dt.
struct OrderRung {
  long steps = 0;
  double dt = 0;
  double error = 0;             // largest component of the state against the exact solution
  std::optional<double> order;  // log2 of the ratio to the rung before
};

struct OrderLadder {
  double t_end = 0;
  std::vector<OrderRung> rungs;
  // Of the last rung whose error is above the floor of rounding, 1024 units of it at the size of the
  // solution; empty where fewer than two are.
  std::optional<double> measured_order;
};

class LadderMeasurement : public Measurement {
 public:
  [[nodiscard]] virtual const OrderLadder& ladder() const = 0;
};

class DriftMeasurement : public Measurement {
 public:
  [[nodiscard]] virtual const EnergyDrift& drift() const = 0;
};

class OrderEngine {
 public:
  OrderEngine() = default;
  OrderEngine(const OrderEngine&) = delete;
  OrderEngine& operator=(const OrderEngine&) = delete;
  virtual ~OrderEngine() = default;

  // Names of problems whose exact solutions need no solver (kernels/ode/problems/problems.hpp).
  [[nodiscard]] virtual std::vector<std::string> problems() const = 0;
  // Splitting methods integrate q'' = a(q) only.
  [[nodiscard]] virtual bool applies(std::string_view integrator, std::string_view problem) const = 0;

  // Steps double from one until the error has met the floor of rounding on two rungs or `most_steps` is
  // reached.  The interval is 1, or so much shorter that about `most_steps` steps lead to the floor: a method
  // of order p errs by some t^(p+1)/n^p.
  [[nodiscard]] virtual std::unique_ptr<LadderMeasurement> ladder(std::string_view integrator,
                                                                  std::string_view problem,
                                                                  long most_steps) const = 0;

  // The kicks and drifts of a splitting method at RealHP<4>, so that they round once to the type and to its
  // reference.  Throws std::invalid_argument for a method of another kind.
  [[nodiscard]] virtual std::vector<dem::FlowText> flow(std::string_view integrator) const = 0;

  // Energy error along `units` units of time at `steps_per_unit` (a power of two, so that the step is exact).
  [[nodiscard]] virtual std::unique_ptr<DriftMeasurement> drift(std::string_view integrator,
                                                                std::string_view problem, long steps_per_unit,
                                                                long units) const = 0;
};

// Null where `token` was not built in.
[[nodiscard]] const OrderEngine* find_order_engine(std::string_view token);

}  // namespace ulpgate
