// Runner: works through units on several threads, stops cleanly on Ctrl-C.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/app/selection.hpp"
#include "harness/core/row_record.hpp"

namespace ulpgate::app {

// Units of any kind of plan.  `evaluate` is called from several threads at once.
struct UnitJob {
  std::string name;  // in the progress bar
  const std::vector<WorkUnit>& units;
  std::size_t rows;
  std::function<std::vector<Summary>(const WorkUnit&)> evaluate;
  std::function<double(const WorkUnit&)> cost;  // for the progress bar alone
};

struct UnitSummaries {
  std::vector<std::vector<Summary>> rows;  // [row][part]; empty where no unit of the row was done
  bool complete = true;                    // false after an interrupt
};

// Runs the units of the shard (unit i belongs to shard i mod count).  The result does not depend on
// `threads`.  A ReferenceDisagreement becomes a Failure with exit code 1.
[[nodiscard]] UnitSummaries run_units(const UnitJob& job, const Shard& shard, unsigned threads);

struct RunResult {
  std::vector<RowRecord> records;
  bool complete = true;
};
[[nodiscard]] RunResult run_plan(const Plan& plan, const Shard& shard, unsigned threads, ReferenceMode mode);

}  // namespace ulpgate::app
