// Texts that outputs of the gate share.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "harness/core/gate/findings/gate_result.hpp"

namespace ulpgate::app {

// Bytes that are no UTF-8 become U+FFFD: paths may have any.
[[nodiscard]] std::string valid_utf8(const std::string& text);

// "passes", "red: 3 rows fail", "incomplete: ..."
[[nodiscard]] std::string verdict_words(const std::vector<GateResult>& results);

// What a finding says beside its message, as names and values in the order to show: reproduce, argument, got,
// wanted, the command that measures the row again.  Numbers as hexfloat and decimal.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> details_of(const GateFinding& finding);

// Where the budget of a finding stands.
struct BudgetPlace {
  std::string file;
  std::size_t line = 1;
};
// The line of its row, the first line where it has none yet; files are read once a call of `budget_places`.
[[nodiscard]] std::vector<BudgetPlace> budget_places(const std::vector<PlacedFinding>& findings);

}  // namespace ulpgate::app
