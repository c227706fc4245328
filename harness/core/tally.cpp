// Tally.
#include "harness/core/tally.hpp"

#include <algorithm>

namespace ulpgate {

void Tally::count(const Finding& f, std::uint64_t k) {
  Summary& s = summary_;
  ++s.samples;
  const auto o = static_cast<std::size_t>(f.outcome);
  ++s.outcomes[o];
  s.first_index[o] = std::min(s.first_index[o], k);
  if (f.outcome != Outcome::finite) return;
  s.correctly_rounded += f.correctly_rounded ? 1U : 0U;
  s.max_distance = std::max(s.max_distance, f.distance_known ? f.distance : 0);
  if (f.greatest == 0) {
    ++s.histogram.exact;
    s.max_error.add(0, k);
    return;
  }
  // An error that is not known to the last recorded bit cannot raise the maximum.
  if (reaches(f.greatest, s.max_error.value) && f.error_known())
    s.max_error.add(recorded({f.greatest}).value, k);
  const int bucket = UlpHistogram::bucket({f.greatest});
  const bool up = f.greatest > rounding_threshold(bucket, k);
  if (bucket > flat_greatest) {
    ++s.histogram.counts[bucket];
    s.sum.add_edges(up ? UlpHistogram::upper_edge(bucket) : UlpHistogram::lower_edge(bucket), 1);
    return;
  }
  Bucket& b = flat_[static_cast<std::size_t>(bucket - flat_least)];
  ++b.count;
  b.rounded_up += up ? 1U : 0U;
}

Summary Tally::take() {
  for (int i = flat_least; i <= flat_greatest; ++i) {
    const Bucket& b = flat_[static_cast<std::size_t>(i - flat_least)];
    if (b.count == 0) continue;
    summary_.histogram.counts[i] += b.count;
    summary_.sum.add_edges(UlpHistogram::upper_edge(i), b.rounded_up);
    summary_.sum.add_edges(UlpHistogram::lower_edge(i), b.count - b.rounded_up);
  }
  flat_ = {};
  ordinary_.add_to(summary_);
  ordinary_ = {};
  return std::move(summary_);
}

}  // namespace ulpgate
