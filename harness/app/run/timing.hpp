// Timing: nanoseconds per evaluation of every function or kernel of every type (timing.jsonl,
// timing_repeats.jsonl).
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

// Every repeat of a row, for comparing runs: nanoseconds per evaluation, and beside each the time of fixed
// work just before it, in nanoseconds; process by process.
struct RepeatedTimes {
  TimingRecord record;  // of the same repeats
  std::vector<std::vector<double>> ns;
  std::vector<std::vector<double>> baseline_ns;
};
// In `rounds` over all rows, each in another order, so that what the machine does in between falls on all
// rows alike; otherwise as measure_times.  One process.
[[nodiscard]] std::vector<RepeatedTimes> time_in_rounds(const PlanRequest& request, unsigned rounds);
// The same in several processes of this program, one after the other: where a process has its code and data
// decides times as much as any change may (T. Mytkowicz et al.: Producing wrong data without doing anything
// obviously wrong, ASPLOS 2009), and does not change within it.
[[nodiscard]] std::vector<RepeatedTimes> time_in_processes(const PlanRequest& request, unsigned processes,
                                                           unsigned rounds);
// timing_repeats.jsonl; what a process of time_in_processes prints.
[[nodiscard]] std::string repeats_text(const std::vector<RepeatedTimes>& rows);

}  // namespace ulpgate::app
