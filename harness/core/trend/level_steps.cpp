// Steps of a level.
#include "harness/core/trend/level_steps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/core/trend/rank_sum.hpp"
#include "harness/core/trend/time_noise.hpp"

namespace ulpgate {

namespace {

// Of a normal distribution: standard deviation over median of |x|, and that of a lower quartile over that of
// a mean.
constexpr double deviation_over_median = 1.4826;
constexpr double quartile_over_mean = 1.3626;

std::vector<double> copy_of(std::span<const double> values) {
  return {values.begin(), values.end()};
}

std::vector<double> distances_to_median(std::span<const double> values) {
  const double level = median(copy_of(values));
  std::vector<double> distances;
  for (const double x : values) distances.push_back(std::fabs(x - level));
  return distances;
}

double cost(std::span<const double> values) {
  double sum = 0;
  for (const double d : distances_to_median(values)) sum += d;
  return sum;
}

// The split of values[begin, end) with the least cost; nothing where it is too short.
std::optional<std::size_t> best_split(std::span<const double> values, std::size_t begin, std::size_t end,
                                      std::size_t least_side) {
  std::optional<std::size_t> best;
  double least = HUGE_VAL;
  for (std::size_t k = begin + least_side; k + least_side <= end; ++k) {
    const double found = cost(values.subspan(begin, k - begin)) + cost(values.subspan(k, end - k));
    if (found >= least) continue;
    least = found;
    best = k;
  }
  return best;
}

struct Interval {
  std::size_t begin = 0, end = 0;
  [[nodiscard]] std::size_t length() const { return end - begin; }
};

// From the shortest to the whole: each length a root of two times the one before, neighbours overlapping by
// half.
std::vector<Interval> seeded_intervals(std::size_t count, std::size_t shortest) {
  std::vector<Interval> intervals;
  for (double length = static_cast<double>(count); length >= static_cast<double>(shortest);
       length /= std::sqrt(2.0)) {
    const auto whole = static_cast<std::size_t>(std::lround(length));
    for (std::size_t begin = 0;; begin += std::max<std::size_t>(1, whole / 2)) {
      const std::size_t end = std::min(begin + whole, count);
      intervals.push_back({end - std::min(whole, end), end});
      if (end == count) break;
    }
  }
  std::ranges::stable_sort(intervals, {}, &Interval::length);
  return intervals;
}

// The splits as bounds of segments: 0, splits, count.
std::vector<std::size_t> bounds_of(const std::vector<std::size_t>& splits, std::size_t count) {
  std::vector<std::size_t> bounds = {0};
  bounds.insert(bounds.end(), splits.begin(), splits.end());
  bounds.push_back(count);
  return bounds;
}

// The step at splits[i] between its neighbours; nothing where it is none.
std::optional<LevelStep> step_between(std::span<const double> values, const std::vector<std::size_t>& bounds,
                                      std::size_t i, double noise, const StepRule& rule) {
  LevelStep found;
  const auto before = values.subspan(bounds[i], bounds[i + 1] - bounds[i]);
  const auto after = values.subspan(bounds[i + 1], bounds[i + 2] - bounds[i + 1]);
  if (!is_step(before, after, noise, rule, found)) return std::nullopt;
  found.at = bounds[i + 1];
  return found;
}

// Moves each split to the best place between its neighbours.
void settle(std::span<const double> values, std::vector<std::size_t>& splits, std::size_t least_side) {
  for (std::size_t i = 0; i < splits.size(); ++i) {
    const auto bounds = bounds_of(splits, values.size());
    if (const auto at = best_split(values, bounds[i], bounds[i + 2], least_side)) splits[i] = *at;
  }
}

// Where intervals that do not share a step have one.
std::vector<std::size_t> narrowest_splits(std::span<const double> values, double noise,
                                          const StepRule& rule) {
  std::vector<std::size_t> splits;
  for (const auto& interval : seeded_intervals(values.size(), 2 * rule.least_side)) {
    const auto taken = [&](std::size_t s) { return s > interval.begin && s < interval.end; };
    if (std::ranges::any_of(splits, taken)) continue;
    const auto at = best_split(values, interval.begin, interval.end, rule.least_side);
    LevelStep found;
    if (at && is_step(values.subspan(interval.begin, *at - interval.begin),
                      values.subspan(*at, interval.end - *at), noise, rule, found))
      splits.push_back(*at);
  }
  std::ranges::sort(splits);
  return splits;
}

}  // namespace

double scatter(std::span<const double> values) {
  std::vector<double> differences;
  for (std::size_t i = 1; i < values.size(); ++i) differences.push_back(std::fabs(values[i] - values[i - 1]));
  if (differences.empty()) return 0;
  return deviation_over_median * median(std::move(differences)) / std::sqrt(2.0);
}

double common_scatter(const std::vector<std::vector<double>>& rows) {
  std::vector<double> scatters;
  for (const auto& row : rows)
    if (row.size() > 3) scatters.push_back(scatter(row));
  if (scatters.empty()) return 0;
  const auto place = scatters.begin() + static_cast<std::ptrdiff_t>(scatters.size() * 3 / 4);
  std::ranges::nth_element(scatters, place);
  return *place;
}

bool is_step(std::span<const double> before, std::span<const double> after, double noise,
             const StepRule& rule, LevelStep& found) {
  if (before.size() < rule.least_side || after.size() < rule.least_side) return false;
  found.before = typical_time(before);
  found.after = typical_time(after);
  std::vector<double> distances = distances_to_median(before);
  for (const double d : distances_to_median(after)) distances.push_back(d);
  const double own = deviation_over_median * median(std::move(distances));
  const auto n = static_cast<double>(before.size());
  const auto m = static_cast<double>(after.size());
  const double error = quartile_over_mean * std::max(noise, own) * std::sqrt(1 / n + 1 / m);
  found.p_value = rank_sum(before, after).p_value;
  return found.p_value <= rule.most_p_value + 1e-12 &&
         std::fabs(found.after - found.before) >= std::max(rule.least_shift, rule.standard_errors * error);
}

std::vector<LevelStep> level_steps(std::span<const double> values, double noise, const StepRule& rule) {
  std::vector<std::size_t> splits = narrowest_splits(values, noise, rule);
  while (true) {
    settle(values, splits, rule.least_side);
    const auto bounds = bounds_of(splits, values.size());
    std::vector<LevelStep> steps;
    std::optional<std::size_t> none;
    for (std::size_t i = 0; i < splits.size(); ++i) {
      const auto step = step_between(values, bounds, i, noise, rule);
      if (step) steps.push_back(*step);
      if (!step) none = i;
    }
    if (!none) return steps;
    splits.erase(splits.begin() + static_cast<std::ptrdiff_t>(*none));
  }
}

}  // namespace ulpgate
