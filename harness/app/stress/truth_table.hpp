// `ulpgate stress --truth`: the true solutions of the initial value problems.
#pragma once

#include <string>

#include "harness/core/verdict/verdict.hpp"

namespace ulpgate::app {

// Prints "case <tab> t <tab> component <tab> value" for each component (from 1) at each end of the problems
// that `cases` names, and to stderr of each component in print how many of its digits hold, and which values
// are wrong.  Throws a Failure for unknown names.
[[nodiscard]] Verdict print_truth(const std::string& cases, int digits, unsigned threads);

}  // namespace ulpgate::app
