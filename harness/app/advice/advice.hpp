// Advice: the cheapest setting that meets an error, why it is not cheaper, and what it rests on.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/app/advice/advice_case.hpp"
#include "harness/app/advice/setting_times.hpp"
#include "harness/app/store/records.hpp"

namespace ulpgate::app {

// A setting that the search looked at.
struct AdvicePlace {
  WorkPrecisionRow row;
  double seconds = 0;
  std::string place;  // "DIR/work_precision.jsonl:12"; empty: measured here
  bool cut = false;   // ended before it was done: no record
};

struct Advice {
  AdviceSearch search;
  std::vector<AdvicePlace> places;  // of the search's points, then those measured to tell what limits
  std::optional<std::size_t> best;  // of the places: meets the error at least time
  std::optional<std::size_t> nearest;
  std::string limit;  // what limits the best, or the nearest where none meets the error
  std::optional<double> measured_order;
  SettingTimes times;
};

// Measures what `records` does not hold.  Throws a Failure where Ctrl-C ends it.
[[nodiscard]] Advice advise(const AdviceCase& advice_case, const AdviceOptions& o);

// One object, all of it.
[[nodiscard]] Json advice_json(const Advice& advice, const AdviceCase& advice_case, const AdviceOptions& o);
void print_advice(const Advice& advice, const AdviceCase& advice_case, const AdviceOptions& o);
// The rows that were measured here.
[[nodiscard]] std::vector<WorkPrecisionRow> measured_rows(const Advice& advice);

}  // namespace ulpgate::app
