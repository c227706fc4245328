// Times of settings.
#include "harness/core/work_precision/time_summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "harness/core/arguments/random_words.hpp"

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

std::vector<std::size_t> interleaved_order(std::size_t count, std::uint64_t round) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const RandomStream stream(1, "work_precision", "interleaving");
  // Fisher and Yates; the bias of a modulus of 64 bits shows to nobody.
  for (std::size_t i = count; i > 1; --i) {
    std::array<std::uint64_t, 1> word{};
    stream.fill(round, i, word);
    std::swap(order[i - 1], order[word[0] % i]);
  }
  return order;
}

}  // namespace ulpgate
