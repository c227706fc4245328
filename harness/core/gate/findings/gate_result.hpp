// GateResult: what the gate came to over one directory of records; every output is made from it.
#pragma once

#include <string>
#include <vector>

#include "harness/core/gate/findings/gate_finding.hpp"
#include "harness/core/verdict/verdict.hpp"

namespace ulpgate {

struct GateResult {
  std::string records_directory;
  std::string budgets_directory;
  // Where the budgets of this platform stand that are laid over those; empty: nowhere.
  std::string platform_directory;
  std::string platform;  // which budgets were used, in words; empty where the budgets name no platform
  std::size_t records = 0;
  std::vector<JudgedRow> rows;
  std::vector<GateFinding> findings;  // sorted
  Verdict verdict;
  // What is wrong beside the findings: why nothing was judged, an incomplete run, oracles that disagree.
  std::vector<std::string> remarks;
};

[[nodiscard]] Standing standing_of(FindingKind kind);

// Findings of a kind in all of them.
[[nodiscard]] std::size_t count_of(const std::vector<GateResult>& results, FindingKind kind);
// "FAIL", "NO BUDGET": the word that a line of a finding begins with.
[[nodiscard]] std::string_view label_of(FindingKind kind);
// Of all results: those that make the gate red or incomplete, the gravest kind and the worst first; notes
// left out.
struct PlacedFinding {
  const GateResult* result;
  const GateFinding* finding;
};
[[nodiscard]] std::vector<PlacedFinding> worst_first(const std::vector<GateResult>& results);
[[nodiscard]] Verdict verdict_of(const std::vector<GateResult>& results);

}  // namespace ulpgate
