// What finished records come to by themselves, without budgets: the same for the run, its merge and the gate.
#pragma once

#include <vector>

#include "harness/core/records/row_record.hpp"
#include "harness/core/verdict/verdict.hpp"

namespace ulpgate::app {

// The two oracles must agree wherever no known defect of the family explains the difference: regression
// otherwise.  Tells people on stderr.
[[nodiscard]] Verdict oracle_verdict(const std::vector<RowRecord>& records);

// What its authors promise of a code is broken by any larger error: no budget allows for that.
[[nodiscard]] Verdict claim_verdict(const std::vector<RowRecord>& records);

}  // namespace ulpgate::app
