// How the energy error of a run grows.
#include "harness/core/scenes/energy_drift.hpp"

#include <array>
#include <cmath>

namespace ulpgate {

namespace {
constexpr int octaves = 6;
constexpr std::size_t bins = 2 * octaves;
constexpr std::size_t least_records = 8;
constexpr std::size_t least_bins = 6;
}  // namespace

void EnergyDrift::add(double time_s, double error_j) {
  records_.push_back({time_s, error_j});
  const double size = std::fabs(error_j);
  if (!std::isnan(largest_) && !(size <= largest_)) largest_ = size;
}

std::optional<double> EnergyDrift::slope() const {
  if (records_.empty()) return std::nullopt;
  const double end = records_.back().time_s;
  struct Bin {
    double squares = 0;
    double log_times = 0;
    std::size_t count = 0;
  };
  std::array<Bin, bins> histogram;
  for (const Record& r : records_) {
    if (!(r.time_s > 0)) continue;
    // Bin 0 reaches back from the end by half an octave.
    const double back = 2 * std::log2(end / r.time_s);
    if (!(back < static_cast<double>(bins))) continue;
    Bin& bin = histogram[static_cast<std::size_t>(back)];
    bin.squares += r.error_j * r.error_j;
    bin.log_times += std::log2(r.time_s);
    ++bin.count;
  }
  double n = 0;
  double x = 0;
  double y = 0;
  double xx = 0;
  double xy = 0;
  for (const Bin& bin : histogram) {
    if (bin.count < least_records) continue;
    const double count = static_cast<double>(bin.count);
    const double log_error = std::log2(bin.squares / count) / 2;
    if (!std::isfinite(log_error)) return std::nullopt;
    const double log_time = bin.log_times / count;
    n += 1;
    x += log_time;
    y += log_error;
    xx += log_time * log_time;
    xy += log_time * log_error;
  }
  if (n < static_cast<double>(least_bins)) return std::nullopt;
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace ulpgate
