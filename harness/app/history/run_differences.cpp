// Two runs beside each other.
#include "harness/app/history/run_differences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/core/trend/level_steps.hpp"
#include "harness/core/trend/rank_sum.hpp"
#include "harness/core/trend/time_noise.hpp"

namespace ulpgate::app {

namespace {

constexpr std::size_t least_processes = 3;
constexpr double least_change = 0.0488;  // 5 %
constexpr double most_p_value = 0.05;

void hold_p_values_together(std::vector<TimeDifference>& times) {
  std::ranges::sort(times, {}, &TimeDifference::p_value);
  double largest = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    largest = std::max(largest, std::min(1.0, static_cast<double>(times.size() - i) * times[i].p_value));
    times[i].p_value = largest;
  }
}

// Of the levels of processes about that of their row, common to the rows of both runs.
double scatter_of_processes(const RunSummary& before, const RunSummary& after) {
  std::vector<std::vector<double>> levels;
  for (const auto* run : {&before, &after})
    for (const auto& [key, row] : run->times)
      if (row.processes >= least_processes) levels.push_back(row.process_levels());
  return common_scatter(levels);
}

std::string why_not_judged(const RunSummary& before, const RunSummary& after) {
  if (before.times.empty() || after.times.empty()) return "no times in one of the runs";
  const auto processor = [](const RunSummary& run) {
    const auto it = run.platform.find(processor_fact);
    return it == run.platform.end() ? std::string("unknown") : it->second;
  };
  if (processor(before) != processor(after)) return "times of two processors";
  return "";
}

void compare_times(const RunSummary& before, const RunSummary& after, RunDifferences& found) {
  found.times_not_judged = why_not_judged(before, after);
  if (!found.times_not_judged.empty()) return;
  found.noise = std::max(least_change, before.time_noise() + after.time_noise());
  for (const auto& [key, old_row] : before.times) {
    const auto it = after.times.find(key);
    if (it == after.times.end()) continue;
    const TimedRow& new_row = it->second;
    const bool paired = old_row.baseline_s.empty() == new_row.baseline_s.empty();
    if (std::min(old_row.processes, new_row.processes) < least_processes || !paired) continue;
    const auto old_times = old_row.relative();
    const auto new_times = new_row.relative();
    TimeDifference row{key, typical_time(old_row.seconds), typical_time(new_row.seconds)};
    row.ratio = std::exp(typical_time(new_times) - typical_time(old_times));
    row.p_value = rank_sum(old_times, new_times).p_value;
    found.times.push_back(std::move(row));
  }
  if (found.times.empty()) {
    found.times_not_judged =
        fmt::format("no row has repeats of {} processes in both runs (--timing repeats)", least_processes);
    return;
  }
  hold_p_values_together(found.times);
  const double scatter = scatter_of_processes(before, after);
  for (auto& row : found.times) {
    const auto old_levels = before.times.at(row.key).process_levels();
    const auto new_levels = after.times.at(row.key).process_levels();
    LevelStep level;
    if (row.p_value > most_p_value || std::fabs(std::log(row.ratio)) <= found.noise ||
        !is_step(old_levels, new_levels, scatter, StepRule{}, level))
      continue;
    row.change = row.ratio > 1 ? Change::worse : Change::better;
  }
  std::ranges::stable_sort(found.times, std::greater<>(),
                           [](const TimeDifference& t) { return std::fabs(std::log(t.ratio)); });
}

}  // namespace

std::size_t RunDifferences::count(Change change) const {
  return static_cast<std::size_t>(std::ranges::count(rows, change, &RowDifference::change));
}

std::size_t RunDifferences::count_times(Change change) const {
  return static_cast<std::size_t>(std::ranges::count(times, change, &TimeDifference::change));
}

RunDifferences compare_runs(const RunSummary& before, const RunSummary& after) {
  RunDifferences found;
  found.platform = platform_change(before.platform, after.platform);
  for (const auto& [key, old_row] : before.rows) {
    const auto it = after.rows.find(key);
    if (it == after.rows.end()) {
      found.only_before.push_back(key);
      continue;
    }
    ++found.compared;
    const RowKind* kind = find_row_kind(key.kind);
    const Change change = change_of(kind, old_row.result, it->second.result);
    if (change == Change::none) continue;
    found.rows.push_back(
        {key, change, old_row, it->second, change_text(kind, old_row.result, it->second.result)});
  }
  for (const auto& [key, row] : after.rows)
    if (!before.rows.contains(key)) found.only_after.push_back(key);
  const auto gravity = [](const RowDifference& row) {
    return row.change == Change::worse ? 0 : row.change == Change::better ? 1 : 2;
  };
  std::ranges::stable_sort(found.rows, {}, gravity);
  compare_times(before, after, found);
  return found;
}

}  // namespace ulpgate::app
