// Run summary: what a directory of records comes to, row by row, with where and with what it was made.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/app/history/row_kinds.hpp"

namespace ulpgate::app {

struct SummaryRow {
  std::string implementation;  // may be empty
  RowResult result;
};

// Every repeat of what was timed, process by process, and of fixed work beside each; a run that keeps no
// repeats has one time, its best.
struct TimedRow {
  std::vector<double> seconds;
  std::vector<double> baseline_s;  // as many, or none
  std::size_t processes = 1;       // each with an equal part of the repeats

  // Logarithms of the repeats over the typical time of the fixed work in their process, where there is any.
  [[nodiscard]] std::vector<double> relative() const;
  // typical_time of those of each process: what differs between them no repeat within one shows.
  [[nodiscard]] std::vector<double> process_levels() const;
};

struct RunSummary {
  std::filesystem::path directory;
  std::string verb;
  std::string plan;
  std::string version;                          // of ulpgate
  std::map<std::string, std::string> platform;  // processor, libraries, compiler: what decides bits and times
  std::string digest;                           // of context and times: the same run has the same
  std::int64_t time_s = 0;                      // of context.json, seconds since 1970
  std::map<RowKey, SummaryRow> rows;
  std::map<RowKey, TimedRow>
      times;  // kinds "time", "scene time", "setting time"; a setting has no implementation

  // How far equal work may seem to differ in this run, as a difference of logarithms.
  [[nodiscard]] double time_noise() const;
};

// Of a finished run.  Throws a Failure: incomplete where the run or a shard of it is missing,
// nothing_measured where it holds no row of a known kind, bad_input for what the run did not write.
[[nodiscard]] RunSummary read_run_summary(const std::filesystem::path& directory);

// The processor alone decides whether times can be compared.
inline constexpr const char* processor_fact = "cpu";
// "glibc 2.36 -> 2.41, Boost 1.81.0 -> 1.88.0"; "none" stands where one has no such fact.  Empty: no
// difference.
[[nodiscard]] std::string platform_change(const std::map<std::string, std::string>& before,
                                          const std::map<std::string, std::string>& after);

}  // namespace ulpgate::app
