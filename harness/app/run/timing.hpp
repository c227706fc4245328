// Timing: nanoseconds per evaluation of every function or kernel of every type (timing.jsonl).
#pragma once

#include <string>
#include <vector>

#include "harness/core/plan/plan.hpp"

namespace ulpgate::app {

struct TimingRecord {
  std::string what;
  std::string type;
  double ns_per_eval;
  int repeats;
  std::size_t batch;
};

// The minimum of repeats over one fixed batch of uniform arguments or typical states, after a warm-up; one
// thread.
[[nodiscard]] std::vector<TimingRecord> measure_times(const PlanRequest& request);
[[nodiscard]] std::string timing_text(const std::vector<TimingRecord>& records);

}  // namespace ulpgate::app
