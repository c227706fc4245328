// Tally.
#include "harness/core/judging/tally.hpp"

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

void Tally::count_scanned(std::span<const std::uint8_t> verdicts, std::uint64_t first) {
  // Neighbours are alike, and one counter in turn would wait for itself.
  constexpr std::size_t codes = 32;
  static_assert(verdict::agreed < codes - 1 && verdict::unsettled % codes == codes - 1);
  std::array<std::array<std::uint32_t, codes>, 4> some{};
  std::size_t i = 0;
  for (; i + 4 <= verdicts.size(); i += 4) {
    for (std::size_t j = 0; j < 4; ++j) ++some[j][verdicts[i + j] % codes];
  }
  for (; i < verdicts.size(); ++i) ++some[0][verdicts[i] % codes];
  std::array<std::uint64_t, codes> counts{};
  for (const auto& list : some)
    for (std::size_t code = 0; code < codes; ++code) counts[code] += list[code];
  const auto first_where = [&](auto&& wanted) {
    return first + static_cast<std::uint64_t>(std::ranges::find_if(verdicts, wanted) - verdicts.begin());
  };
  const std::uint64_t agreed = counts[verdict::agreed];
  const std::uint64_t settled = verdicts.size() - counts[codes - 1];
  if (agreed > 0) {
    const std::uint64_t k = first_where([](std::uint8_t v) { return v == verdict::agreed; });
    count({}, k);
    summary_.samples += agreed - 1;
    summary_.outcomes[static_cast<std::size_t>(Outcome::finite)] += agreed - 1;
    summary_.correctly_rounded += agreed - 1;
    summary_.histogram.exact += agreed - 1;
  }
  if (settled > agreed) {
    ordinary_.count_scanned(std::span(counts).first<verdict::agreed>(),
                            first_where([](std::uint8_t v) { return v < verdict::agreed; }));
  }
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
