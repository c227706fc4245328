// Works through measurements on several threads, a measurement on one at a time; stops within a step on
// Ctrl-C.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "harness/app/store/piece_log.hpp"
#include "harness/core/orders/measurement.hpp"
#include "harness/core/plan/cost_model.hpp"

namespace ulpgate::app {

struct MeasurementJob {
  std::string name;  // in the progress bar
  const std::vector<std::unique_ptr<Measurement>>& measurements;
  std::vector<std::string> names;  // "rk4 kepler double", one a measurement
  // One a measurement, for the progress bar and the order of work: its points, which are steps, are filled in
  // here.
  std::vector<CostModel::Row> costs;
};

// Whether all is measured: false after an interrupt.  Pieces of `log`, which may be null, are taken over
// first, and new ones are kept there.  The results depend neither on `threads` nor on what the log had.
[[nodiscard]] bool run_measurements(const MeasurementJob& job, unsigned threads, PieceLog* log);

}  // namespace ulpgate::app
