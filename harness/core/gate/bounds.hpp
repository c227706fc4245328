// What no seed exceeds: bounds of the maxima of drawn strata, extrapolated from the maxima of several seeds.
#pragma once

#include <span>
#include <vector>

#include "harness/core/gate/budgets.hpp"

namespace ulpgate {

// The level that the maximum of another seed exceeds with a probability of about 1e-6.  The logarithms of
// maxima of independent samples follow Gumbel's distribution, both where errors have a largest value and
// where they fall off like a power; it is fitted by its moments, and its scale is widened by twice the
// uncertainty that a scale has which so few numbers determine.  For errors that have a largest value the
// level lies above it by some percent; for those that fall off like a power it is far away, and honest: there
// a maximum says little, the counts above powers of two say more.
// At least three maxima, all positive.
[[nodiscard]] double exceeded_by_no_seed(std::span<const double> maxima);

inline constexpr std::size_t least_seeds = 3;

// Adds bound_ulp and bound_over_condition to the drawn strata of `measured`, from sets of records of other
// seeds; strata of which there are fewer than least_seeds get none.  No bound is below the measured limit or
// below a maximum of those seeds, and all strata of a row share the largest bound_ulp.
void add_bounds(Budgets& measured, const std::vector<std::vector<RowRecord>>& seeds);

}  // namespace ulpgate
