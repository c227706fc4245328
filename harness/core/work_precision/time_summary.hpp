// What repeated times of one setting come to.
#pragma once

#include <cstddef>
#include <vector>

namespace ulpgate {

struct TimeSummary {
  double minimum_s = 0;
  double median_s = 0;
  double spread_s = 0;  // between the quartiles
  std::size_t repeats = 0;
};
// Of at least one time.
[[nodiscard]] TimeSummary summarize_times(std::vector<double> seconds);

// How far a time of the same work may be off on this machine: median over minimum of a baseline that was
// repeated between all others, less one.  0 of fewer than two.
[[nodiscard]] double noise_floor(std::vector<double> baseline_s);

}  // namespace ulpgate
