// Properties that a function has whatever its errors: symmetry, range, exact values, monotonicity.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/foreign/claimed_code.hpp"

namespace ulpgate {

struct PropertyFinding {
  std::string property;           // "odd", "even", "range", "exact", "monotone"
  std::uint64_t broken = 0;       // at so many
  std::uint64_t looked_at = 0;    // of so many
  std::vector<std::string> args;  // of the first, hexadecimal
  std::string says;               // "gives 0x1.8p+0, and 0x1.7fp+0 at 0x1.1p+0"
};

// Those that are broken, of a function of one result in f, d or l, inside the domain of its claim; the
// arguments depend on the seed alone.  What a function does not have is not looked at.
[[nodiscard]] std::vector<PropertyFinding> broken_properties(const BatchCode& code, const FunctionInfo& f,
                                                             char element, const ClaimBounds& claim,
                                                             std::uint64_t seed);

// Results at a sample of arguments, the same for every code: two variants of a function may be held side by
// side.
struct SampledResults {
  std::vector<std::string> args;     // hexadecimal
  std::vector<std::string> results;  // likewise
};
[[nodiscard]] SampledResults sampled_results(const BatchCode& code, const FunctionInfo& f, char element,
                                             const ClaimBounds& claim, std::uint64_t seed);

}  // namespace ulpgate
