// ClaimedCode: code of which something is claimed on a domain and down to an absolute error.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "kernels/math/function_table.hpp"
#include "reference/functions/function_info.hpp"

namespace ulpgate {

struct ClaimBounds {
  // Of each argument, ends included; empty: everywhere, NaN included.
  std::vector<std::pair<double, double>> domain;
  // An absolute error that is allowed in any case.
  double floor = 0;

  [[nodiscard]] bool limit() const { return !domain.empty() || floor > 0; }
};

// What a claim does not cover is as right as can be: outside of the domain the code is not called, and there
// as where the error is within the floor the result is the value rounded to the type.  So whoever looks for
// the largest error finds that of the claim.  Crashes and their like within the domain stay what they are.
// `code` outlives it; `element` is f, d, l or q.
[[nodiscard]] std::unique_ptr<BatchCode> make_claimed_code(const BatchCode& code, const FunctionInfo& f,
                                                           char element, ClaimBounds bounds);

}  // namespace ulpgate
