// Runner: works through units on several threads, stops cleanly on Ctrl-C.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "harness/app/run/ranks.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/checkpoint.hpp"
#include "harness/core/plan/cost_model.hpp"
#include "harness/core/records/row_record.hpp"

namespace ulpgate::app {

// Units of any kind of plan.  `evaluate` is called from several threads at once.
struct UnitJob {
  std::string name;  // in the progress bar
  const std::vector<WorkUnit>& units;
  std::vector<CostModel::Row> rows;  // for the progress bar: its points are filled in here
  std::function<std::vector<Summary>(const WorkUnit&)> evaluate;
};

// A guess for the first seconds of the progress bar: the cost of a point grows with the reference's bits.
[[nodiscard]] double prior_cost(const RealDescriptor& type);

struct UnitSummaries {
  std::vector<std::vector<Summary>> rows;  // [row][part]; empty where no unit of the row was done
  bool complete = true;                    // false after an interrupt
};

// Runs the units of the shard (unit i belongs to shard i mod count).  The result does not depend on
// `threads`, nor on which units a checkpoint had.  A ReferenceDisagreement becomes a Failure with exit
// code 1. With `ranks` the calling thread serves the other ranks beside the `threads`.
[[nodiscard]] UnitSummaries run_units(const UnitJob& job, const Shard& shard, unsigned threads,
                                      Checkpoint& checkpoint, Ranks* ranks = nullptr);

struct RunResult {
  std::vector<RowRecord> records;
  bool complete = true;
  // Samples that each stage of the reference decided in this process, those of a checkpoint left out.
  std::array<std::uint64_t, stage_count> decided{};
};
[[nodiscard]] RunResult run_plan(const Plan& plan, const Shard& shard, unsigned threads, ReferenceMode mode,
                                 Checkpoint& checkpoint, Ranks* ranks = nullptr);
// A rank that does not write: takes units of the same plan until there are no more.
void help_plan(const Plan& plan, const Shard& shard, ReferenceMode mode, const RunIdentity& identity,
               Ranks& ranks);

}  // namespace ulpgate::app
