// Tally.
#include "harness/core/judging/tally.hpp"

#include <algorithm>
#include <cstring>

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
  static_assert(2 * OrdinaryErrors::scanned_slots <= verdict::agreed && verdict::agreed < verdict_codes - 1 &&
                verdict::unsettled % verdict_codes == verdict_codes - 1);
  std::size_t i = 0;
  constexpr std::size_t words = 4;
  for (; i + words * scanned_.size() <= verdicts.size(); i += words * scanned_.size()) {
    std::array<std::uint64_t, words> eight{};
    std::memcpy(eight.data(), &verdicts[i], sizeof eight);
    // Neighbours are often all alike.
    const std::uint8_t code = verdicts[i] % verdict_codes;
    const std::uint64_t alike = 0x0101010101010101U * verdicts[i];
    if (((eight[0] ^ alike) | (eight[1] ^ alike) | (eight[2] ^ alike) | (eight[3] ^ alike)) == 0) {
      scanned_[0][code] += words * scanned_.size();
      continue;
    }
    for (const std::uint64_t word : eight) {
#pragma GCC unroll 8
      for (std::size_t j = 0; j < scanned_.size(); ++j) ++scanned_[j][(word >> 8 * j) % verdict_codes];
    }
  }
  for (; i < verdicts.size(); ++i) ++scanned_[0][verdicts[i] % verdict_codes];
  const auto note_first = [&](std::uint64_t& noted, auto&& wanted) {
    if (noted != no_index) return;
    const auto at = std::ranges::find_if(verdicts, wanted);
    if (at != verdicts.end()) noted = first + static_cast<std::uint64_t>(at - verdicts.begin());
  };
  // Whole rows have none.
  const auto agreed_in = [](const auto& list) { return list[verdict::agreed] > 0; };
  if (std::ranges::any_of(scanned_, agreed_in))
    note_first(first_agreed_, [](std::uint8_t v) { return v == verdict::agreed; });
  note_first(first_scanned_, [](std::uint8_t v) { return v < verdict::agreed; });
}

void Tally::settle_scanned() {
  std::array<std::uint64_t, verdict_codes> counts{};
  for (const auto& list : scanned_)
    for (std::size_t code = 0; code < verdict_codes; ++code) counts[code] += list[code];
  scanned_ = {};
  constexpr auto finite = static_cast<std::size_t>(Outcome::finite);
  if (first_agreed_ != no_index) {
    const std::uint64_t more = counts[verdict::agreed] - 1;
    count({}, first_agreed_);
    summary_.samples += more;
    summary_.outcomes[finite] += more;
    summary_.correctly_rounded += more;
    summary_.histogram.exact += more;
  }
  if (first_scanned_ != no_index) {
    constexpr std::size_t halves = 2 * OrdinaryErrors::buckets.size();
    ordinary_.count_scanned(std::span(counts).first<halves>(), first_scanned_);
    for (std::size_t slot = halves / 2; slot < OrdinaryErrors::scanned_slots; ++slot) {
      const std::uint64_t all = counts[2 * slot] + counts[2 * slot + 1];
      const int bucket = OrdinaryErrors::buckets.back() + 1 + static_cast<int>(slot - halves / 2);
      Bucket& b = flat_[static_cast<std::size_t>(bucket - flat_least)];
      b.count += all;
      b.rounded_up += counts[2 * slot + 1];
      summary_.samples += all;
      summary_.outcomes[finite] += all;
    }
  }
  first_agreed_ = no_index;
  first_scanned_ = no_index;
}

Summary Tally::take() {
  settle_scanned();
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
