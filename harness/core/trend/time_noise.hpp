// What repeated times come to that others on the same processor disturb: one figure, and how far it may be
// off.
#pragma once

#include <span>
#include <vector>

namespace ulpgate {

// The middle one, or the mean of the middle two.  NaN of nothing.
[[nodiscard]] double median(std::vector<double> values);
// The lower quartile: disturbances add time, so the faster part of the repeats is of the work itself; the
// very fastest one is a single value, and no steadier.  NaN of nothing.
[[nodiscard]] double typical_time(std::span<const double> times);

// Noise floor of a run: times of the same work taken between all others, in one group for each of the others.
// Each group is treated as if it were times of a subject; the largest |ln| of its typical time over that of
// all is what the machine makes out of no difference at all.  0 of fewer than two groups.
[[nodiscard]] double baseline_noise(const std::vector<std::vector<double>>& groups);

}  // namespace ulpgate
