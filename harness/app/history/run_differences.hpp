// Two runs beside each other, row by row: accuracy exactly, speed as far as noise allows.
#pragma once

#include <string>
#include <vector>

#include "harness/app/history/run_summary.hpp"

namespace ulpgate::app {

struct RowDifference {
  RowKey key;
  Change change = Change::none;
  SummaryRow before, after;
  std::string text;  // which figures differ
};

struct TimeDifference {
  RowKey key;
  double before_s = 0, after_s = 0;  // typical_time of the repeats
  double ratio = 1;                  // after over before, the machines' speeds taken out
  double p_value = 1;                // of Mann and Whitney's test, times the rows it stands beside (Holm)
  Change change = Change::none;      // worse is slower
};

struct RunDifferences {
  std::size_t compared = 0;         // rows that both have
  std::vector<RowDifference> rows;  // those that are not the same, worse first
  std::vector<RowKey> only_before, only_after;
  std::vector<TimeDifference> times;  // those judged, the largest change first
  std::string times_not_judged;       // why there is none; may be empty
  double noise = 0;                   // what a ratio must exceed, as a difference of logarithms
  std::string platform;               // what differs of it

  [[nodiscard]] std::size_t count(Change change) const;
  [[nodiscard]] std::size_t count_times(Change change) const;
};

// Times are judged on one processor, where both runs have repeats of three processes at least.  A row is
// slower or faster where Mann and Whitney's test over all repeats, each over the fixed work beside it, says
// so at 1 % over all rows together (S. Holm: A simple sequentially rejective multiple test procedure, Scand.
// J. Stat. 6, 1979), where its typical time differs by more than 5 % and the noise floors of both runs, and
// where the levels of its processes differ as StepRule asks for: how a process lies in memory is noise that
// no repeat within it shows.
[[nodiscard]] RunDifferences compare_runs(const RunSummary& before, const RunSummary& after);

}  // namespace ulpgate::app
