// OrderJob: what `ulpgate integrators` is to measure, from its options.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "harness/app/orders/measurement_run.hpp"
#include "harness/core/orders/order_engine.hpp"
#include "kernels/ode/integrators/integrators.hpp"

namespace ulpgate::app {

struct OrderOptions {
  std::string integrators = "all";
  std::string types = "double";
  std::string problems = "all";
  long most_steps = 2048;
  long drift_units = 0;  // 0: orders
  long steps_per_unit = 64;
  double tolerance = 0.25;
  unsigned threads = 0;
  std::string out;
  bool resume = false;
  bool overwrite = false;
  bool json = false;
};

// The order or the drift of one integrator, by options, in one type on one problem.
struct OrderRow {
  const ode::IntegratorInfo& integrator;
  std::string type;
  std::string problem;
  const LadderMeasurement* ladder = nullptr;
  const DriftMeasurement* drift = nullptr;
};

struct OrderJob {
  std::vector<std::string> types;
  std::vector<OrderRow> rows;
  std::vector<std::unique_ptr<Measurement>> measurements;  // of the rows
  std::vector<CostModel::Row> costs;                       // of the rows
  std::string plan_text;
  std::string plan;  // its hash
};

// Throws a Failure for names that are not known and where no integrator applies to a problem.
[[nodiscard]] OrderJob make_order_job(const OrderOptions& o);

}  // namespace ulpgate::app
