// A suite of the gate: one directory of records held against one directory of budgets.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "harness/core/gate/budgets.hpp"
#include "harness/core/gate/findings/gate_result.hpp"

namespace ulpgate::app {

// What the command line says of all suites.
struct GateRules {
  bool only_measured = false;
  bool other_plan = false;
  std::optional<std::uint64_t> least_samples;
  bool tighten = false;
  bool update = false;
  std::string reason;              // of --update
  std::vector<std::string> seeds;  // of --update
  // "auto": that of the records; "base": no other than the base.  Empty: auto to judge, base to update.
  std::string platform;

  [[nodiscard]] MissingRecords missing() const {
    return only_measured ? MissingRecords::ignore : MissingRecords::fail;
  }
};

// Judges; with `tighten` and nothing red or incomplete also lowers the budgets.  A Failure becomes a remark
// and the verdict of the result, so that the other suites are judged and every output says it.
[[nodiscard]] GateResult judge_suite(const std::string& records, const std::string& budgets,
                                     const GateRules& rules);

// Platforms, by directory, whose first budgets one command writes: their rows need no reason of their own.
using NewPlatforms = std::set<std::filesystem::path>;
// Writes what was measured.  Prints what would become looser.  Throws a Failure where nothing may be written.
[[nodiscard]] Verdict update_suite(const std::string& records, const std::string& budgets,
                                   const GateRules& rules, NewPlatforms& made);

}  // namespace ulpgate::app
