// Noise of times.
#include "harness/core/trend/time_noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ulpgate {

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

double typical_time(std::span<const double> times) {
  if (times.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> sorted(times.begin(), times.end());
  const auto quarter = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) / 4);
  std::ranges::nth_element(sorted, quarter);
  return *quarter;
}

double baseline_noise(const std::vector<std::vector<double>>& groups) {
  if (groups.size() < 2) return 0;
  std::vector<double> all;
  for (const auto& group : groups) all.insert(all.end(), group.begin(), group.end());
  const double of_all = typical_time(all);
  double largest = 0;
  for (const auto& group : groups) {
    if (!group.empty()) largest = std::max(largest, std::fabs(std::log(typical_time(group) / of_all)));
  }
  return largest;
}

}  // namespace ulpgate
