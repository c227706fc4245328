// OrdinaryErrors: counts of errors of at most half an ULP, which nearly all samples have, as fast as can be.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "harness/core/records/summary.hpp"

namespace ulpgate {

class OrdinaryErrors {
 public:
  // The buckets of UlpHistogram up to 1/2 ULP, and their upper edges.
  static constexpr std::array<int, 9> buckets = {-24, -20, -16, -12, -8, -7, -6, -5, -4};
  static constexpr std::array<double, 9> upper = {0x1p-6,
                                                  0x1p-5,
                                                  0x1p-4,
                                                  0x1p-3,
                                                  0x1p-2,
                                                  0x1.306fe0a31b715p-2,
                                                  0x1.6a09e667f3bcdp-2,
                                                  0x1.ae89f995ad3adp-2,
                                                  0.5};

  // What scan_ordinary counts goes on in the histogram's quarters of octaves up to 4 ULP: slots of the binade
  // (2^b, 2^(b + 1)], of which the first has `least_binade`, from `least_fine` on four each, `first_fine` the
  // first of them.
  static constexpr int least_binade = -6;
  static constexpr int least_fine = -2;
  static constexpr int first_fine = 5;
  static constexpr std::array<double, 3> quarters = {0x1.306fe0a31b715p0, 0x1.6a09e667f3bcdp0,
                                                     0x1.ae89f995ad3adp0};
  static constexpr std::array<std::uint64_t, 3> quarter_bits = {0x306fe0a31b715U, 0x6a09e667f3bcdU,
                                                                0xae89f995ad3adU};
  static constexpr std::size_t scanned_slots = 21;
  static constexpr double greatest_edge = 4;

  [[nodiscard]] static std::size_t slot(double error) {
    std::size_t n = 0;
    for (std::size_t i = 0; i + 1 < upper.size(); ++i) n += error > upper[i] ? 1U : 0U;
    return n;
  }
  // rounding_threshold of the slot's bucket.
  [[nodiscard]] static double threshold(std::size_t slot, std::uint64_t k) {
    if (slot == 0) return 0;
    const double lower = upper[slot - 1];
    return lower + counter_fraction(k) * (upper[slot] - lower);
  }

  // Counts a correctly rounded sample k whose error lies in [least, greatest], 0 < least, greatest <= 1/2;
  // false, and nothing counted, where that is not enough to know the counts.
  [[nodiscard]] bool count(double least, double greatest, std::uint64_t k) {
    const std::size_t n = slot(least);
    if (greatest > upper[n]) return false;
    const double t = threshold(n, k);
    const bool up = greatest > t;
    if ((least > t) != up) return false;
    ++counts_[n];
    rounded_up_[n] += up ? 1U : 0U;
    first_ = std::min(first_, k);
    return true;
  }

  // Counts verdicts of slots, of the samples from index `first` on.
  void count_scanned(std::span<const std::uint64_t, 2 * 9> verdicts, std::uint64_t first) {
    for (std::size_t n = 0; n < upper.size(); ++n) {
      counts_[n] += verdicts[2 * n] + verdicts[2 * n + 1];
      rounded_up_[n] += verdicts[2 * n + 1];
    }
    first_ = std::min(first_, first);
  }

  void add_to(Summary& s) const {
    const auto finite = static_cast<std::size_t>(Outcome::finite);
    for (std::size_t n = 0; n < upper.size(); ++n) {
      if (counts_[n] == 0) continue;
      s.max_distance = std::max(s.max_distance, 0.0);
      s.samples += counts_[n];
      s.outcomes[finite] += counts_[n];
      s.correctly_rounded += counts_[n];
      s.histogram.counts[buckets[n]] += counts_[n];
      s.sum.add_edges(upper[n], rounded_up_[n]);
      if (n > 0) s.sum.add_edges(upper[n - 1], counts_[n] - rounded_up_[n]);
    }
    s.first_index[finite] = std::min(s.first_index[finite], first_);
  }

 private:
  std::array<std::uint64_t, 9> counts_{};
  std::array<std::uint64_t, 9> rounded_up_{};
  std::uint64_t first_ = no_index;
};

}  // namespace ulpgate
