// What ulpgate history prints: tables with a sparkline under each column, steps in words, JSON.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/app/history/history_steps.hpp"

namespace ulpgate::app {

// The first 12 characters of a hash, other words whole.
[[nodiscard]] std::string short_commit(const std::string& commit);
// One block a value, from the smallest to the largest on a linear scale; a dot where there is none, all low
// where they are the same, "!" where a value is infinite or no number.
[[nodiscard]] std::string sparkline(std::span<const std::optional<double>> values);
// One column of a trend: a value a run, by positions in HistoryFile::runs().
struct TrendColumn {
  RowKey key;
  std::string unit;
  std::vector<std::optional<double>> values;  // of all runs; nothing where the row was not in one
  std::vector<std::string> texts;
};

[[nodiscard]] std::string trend_table(const std::vector<HistoryRun>& runs,
                                      const std::vector<TrendColumn>& columns);
// "WORSE  exp double at 1a2b3c (2024-05-03), before it 0a1b2c: time 12 ns -> 14 ns; glibc 2.36 -> 2.41"
[[nodiscard]] std::string step_line(const std::vector<HistoryRun>& runs, const HistoryStep& step);
[[nodiscard]] Json step_json(const std::vector<HistoryRun>& runs, const HistoryStep& step);
[[nodiscard]] Json run_json(const HistoryRun& run);

}  // namespace ulpgate::app
