// Times of settings.
#include "harness/core/work_precision/time_summary.hpp"

#include <algorithm>
#include <cmath>

namespace ulpgate {

namespace {

// Of sorted numbers, interpolated between the two nearest.
double quantile(const std::vector<double>& sorted, double fraction) {
  const double place = fraction * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

TimeSummary summarize_times(std::vector<double> seconds) {
  std::ranges::sort(seconds);
  return {seconds.front(), quantile(seconds, 0.5), quantile(seconds, 0.75) - quantile(seconds, 0.25),
          seconds.size()};
}

double noise_floor(std::vector<double> baseline_s) {
  if (baseline_s.size() < 2) return 0;
  const TimeSummary times = summarize_times(std::move(baseline_s));
  return times.median_s / times.minimum_s - 1;
}

}  // namespace ulpgate
