// What the gate came to.
#include "harness/core/gate/findings/gate_result.hpp"

#include <algorithm>
#include <array>

namespace ulpgate {

Standing standing_of(FindingKind kind) {
  switch (kind) {
    case FindingKind::regression:
    case FindingKind::other_results:
      return Standing::regression;
    case FindingKind::another_plan:
      return Standing::another_plan;
    case FindingKind::could_lower:
      return Standing::pass;
    default:
      return Standing::incomplete;
  }
}

std::size_t count_of(const std::vector<GateResult>& results, FindingKind kind) {
  std::size_t n = 0;
  for (const auto& r : results)
    n += static_cast<std::size_t>(std::ranges::count(r.findings, kind, &GateFinding::kind));
  return n;
}

std::string_view label_of(FindingKind kind) {
  constexpr std::array<std::string_view, finding_kind_count> names = {
      "FAIL",         "OTHER RESULTS", "ANOTHER PLAN", "NO BUDGET",
      "NOT MEASURED", "INCOMPLETE",    "LOST CASES",   "note"};
  return names[static_cast<std::size_t>(kind)];
}

std::vector<PlacedFinding> worst_first(const std::vector<GateResult>& results) {
  std::vector<PlacedFinding> placed;
  for (const auto& r : results) {
    for (const auto& f : r.findings)
      if (f.kind != FindingKind::could_lower) placed.push_back({&r, &f});
  }
  std::ranges::stable_sort(placed, {}, [](const PlacedFinding& p) { return finding_rank(*p.finding); });
  return placed;
}

Verdict verdict_of(const std::vector<GateResult>& results) {
  Verdict verdict;
  for (const auto& r : results) verdict |= r.verdict;
  return verdict;
}

}  // namespace ulpgate
