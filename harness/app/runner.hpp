// Runner: works through a plan's units on several threads, stops cleanly on Ctrl-C.
#pragma once

#include <vector>

#include "harness/app/selection.hpp"
#include "harness/core/row_record.hpp"

namespace ulpgate::app {

struct RunResult {
  std::vector<RowRecord> records;
  bool complete = true;  // false after an interrupt
};

// Runs the units of the shard (unit i belongs to shard i mod count).  The result does not depend on
// `threads`.
[[nodiscard]] RunResult run_plan(const Plan& plan, const Shard& shard, unsigned threads, ReferenceMode mode);

}  // namespace ulpgate::app
