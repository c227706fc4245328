// Listed arguments: the edges and the structured hard cases of a function in a format, as exact MPFR values.
#pragma once

#include <vector>

#include "harness/core/arguments/strata.hpp"
#include "reference/functions/function_info.hpp"
#include "reference/types/format.hpp"
#include "reference/types/mpfr_value.hpp"

namespace ulpgate {

// Each entry is one point: `arity` values of the format, all within the domain of the function's index
// arguments.
using ArgumentList = std::vector<std::vector<MpfrValue>>;

// Where the points of one row of a run come from.  `list` is set for listed strata.
struct StratumSource {
  Stratum stratum = Stratum::uniform;
  std::uint64_t seed = 1;
  std::uint64_t count = 0;
  const ArgumentList* list = nullptr;
};

// The exponents that are drawn.  MPFR's and cpp_bin_float's ranges reach 2^(2^30), where an argument
// reduction needs a billion digits of pi: they are sampled over the exponents of binary128.  Complex
// functions are sampled over the exponents of binary64 in every type: between parts of sizes further apart
// MPC works for seconds a point.
struct ExponentRange {
  long least;
  long greatest;
};
[[nodiscard]] ExponentRange sampled_exponents(const FunctionInfo& f, const FloatFormat& format);

// Zeros, infinities, NaN, extremes, 1 and neighbours, integers, halves, poles and their neighbours; the
// product over the arguments, from a shorter list where there are three or four.
[[nodiscard]] ArgumentList edge_arguments(const FunctionInfo& f, const FloatFormat& format);

// The family of hard arguments that the function's row names; empty for `none`.
[[nodiscard]] ArgumentList hard_arguments(const FunctionInfo& f, const FloatFormat& format);

// For every binade of the format from 1 to 2^greatest: its numbers nearest to a multiple of pi/2, found from
// the continued fraction of the binade's spacing over pi/2 (Kahan's method; Muller, Elementary Functions, 3rd
// ed., section 11.3.2).
[[nodiscard]] std::vector<MpfrValue> nearest_to_multiples_of_half_pi(const FloatFormat& format,
                                                                     long greatest);

}  // namespace ulpgate
