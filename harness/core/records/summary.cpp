// Exact, mergeable summaries.
#include "harness/core/records/summary.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

namespace ulpgate {

namespace {
// 2^(-3/4), 2^(-2/4), 2^(-1/4), 1: correctly rounded constants, so that buckets do not depend on a libm.
constexpr std::array<double, 4> quarter_octaves = {0x1.306fe0a31b715p-1, 0x1.6a09e667f3bcdp-1,
                                                   0x1.ae89f995ad3adp-1, 1.0};
// The edges of the buckets that nearly all errors fall into.
constexpr int tabled = 40;
constexpr auto edges = [] {
  std::array<double, tabled - UlpHistogram::least + 1> table{};
  for (int i = UlpHistogram::least; i <= tabled; ++i) {
    // bucket = 4 (exponent - 1) + quarter + 1 with quarter in 0..3
    const auto power = static_cast<std::uint64_t>(((i - 1) >> 2) + 1 + 1023);
    table[static_cast<std::size_t>(i - UlpHistogram::least)] =
        quarter_octaves[static_cast<std::size_t>((i - 1) & 3)] * std::bit_cast<double>(power << 52U);
  }
  return table;
}();
constexpr double sum_unit = 0x1p-40;
constexpr double sum_limit = 0x1p60;
}  // namespace

int UlpHistogram::bucket(Ulp error) {
  if (!std::isfinite(error.value)) return greatest;
  if (error.value <= 0x1p-6) return least;
  // frexp of a normal number: m in [1/2, 1).
  const auto bits = std::bit_cast<std::uint64_t>(error.value);
  const int exponent = static_cast<int>(bits >> 52U) - 1022;
  const auto m = std::bit_cast<double>((bits & 0xfffffffffffffU) | 0x3fe0000000000000U);
  // (2^-1, 2^-3/4] is the first bucket of the octave; 2^-1 itself is the last of the octave below.
  int quarter = m == 0.5 ? -1 : 0;
  if (quarter == 0) {
    while (m > quarter_octaves[static_cast<std::size_t>(quarter)]) ++quarter;
  }
  const int fine = 4 * (exponent - 1) + quarter + 1;
  if (fine <= finest) return -(-fine / 4 * 4);  // up to the next octave
  return std::min(fine, greatest);
}

double UlpHistogram::upper_edge(int bucket) {
  if (bucket >= least && bucket <= tabled) return edges[static_cast<std::size_t>(bucket - least)];
  return std::ldexp(quarter_octaves[static_cast<std::size_t>((bucket - 1) & 3)], ((bucket - 1) >> 2) + 1);
}

double UlpHistogram::lower_edge(int bucket) {
  if (bucket == least) return 0;
  return upper_edge(bucket <= finest ? bucket - 4 : bucket - 1);
}

void UlpHistogram::add(Ulp error) {
  if (error.value == 0) {
    ++exact;
  } else {
    ++counts[bucket(error)];
  }
}

void UlpHistogram::merge(const UlpHistogram& other) {
  exact += other.exact;
  for (const auto& [i, n] : other.counts) counts[i] += n;
}

double UlpHistogram::quantile(double fraction) const {
  std::uint64_t total = exact;
  for (const auto& [i, n] : counts) total += n;
  if (total == 0) return std::numeric_limits<double>::quiet_NaN();
  const double wanted = fraction * static_cast<double>(total);
  std::uint64_t reached = exact;
  if (static_cast<double>(reached) >= wanted) return 0;
  for (const auto& [i, n] : counts) {
    reached += n;
    if (static_cast<double>(reached) >= wanted) return upper_edge(i);
  }
  return upper_edge(counts.rbegin()->first);
}

double rounding_threshold(int bucket, std::uint64_t k) {
  if (bucket == UlpHistogram::least) return 0;
  const double lower = UlpHistogram::lower_edge(bucket);
  return lower + counter_fraction(k) * (UlpHistogram::upper_edge(bucket) - lower);
}

void UlpSum::add(Ulp error, std::uint64_t k) {
  if (error.value == 0) return;
  const int bucket = UlpHistogram::bucket(error);
  const bool up = error.value > rounding_threshold(bucket, k);
  add_edges(up ? UlpHistogram::upper_edge(bucket) : UlpHistogram::lower_edge(bucket), 1);
}

void UlpSum::add_edges(double edge, std::uint64_t count) {
  units_ += static_cast<unsigned __int128>(std::min(edge, sum_limit) / sum_unit) * count;
}

double UlpSum::mean(std::uint64_t count) const {
  if (count == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(units_) * sum_unit / static_cast<double>(count);
}

std::string UlpSum::to_text() const {
  std::string text;
  for (unsigned __int128 rest = units_; rest != 0; rest >>= 4U) {
    text.insert(text.begin(), "0123456789abcdef"[static_cast<unsigned>(rest & 15U)]);
  }
  return text.empty() ? "0" : text;
}

UlpSum UlpSum::from_text(std::string_view hex) {
  UlpSum sum;
  for (const char c : hex) {
    unsigned digit = 0;
    std::from_chars(&c, &c + 1, digit, 16);
    sum.units_ = (sum.units_ << 4U) | digit;
  }
  return sum;
}

void Summary::add(const Judgement& judgement, std::uint64_t k) {
  ++samples;
  const auto o = static_cast<std::size_t>(judgement.outcome);
  ++outcomes[o];
  first_index[o] = std::min(first_index[o], k);
  if (judgement.outcome != Outcome::finite) return;
  correctly_rounded += judgement.correctly_rounded ? 1U : 0U;
  max_error.add(judgement.error.value, k);
  max_distance = std::max(max_distance, judgement.distance);
  histogram.add(judgement.error);
  sum.add(judgement.error, k);
}

void Summary::merge(const Summary& other) {
  samples += other.samples;
  correctly_rounded += other.correctly_rounded;
  for (std::size_t i = 0; i < outcome_count; ++i) {
    outcomes[i] += other.outcomes[i];
    first_index[i] = std::min(first_index[i], other.first_index[i]);
  }
  max_error.merge(other.max_error);
  max_distance = std::max(max_distance, other.max_distance);
  max_error_over_condition = std::max(max_error_over_condition, other.max_error_over_condition);
  normwise.merge(other.normwise);
  histogram.merge(other.histogram);
  sum.merge(other.sum);
  oracle.merge(other.oracle);
}

}  // namespace ulpgate
