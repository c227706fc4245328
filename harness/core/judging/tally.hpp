// Tally: counts findings of one part of one row into a Summary, as soon as nothing that is recorded can
// depend on what they leave open.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "harness/core/records/summary.hpp"
#include "harness/core/stages/finding.hpp"
#include "harness/core/stages/ordinary_errors.hpp"
#include "harness/core/stages/ordinary_scan.hpp"

namespace ulpgate {

// What a finding still needs before it can be counted.
enum class Need {
  nothing,    // count it
  condition,  // it may raise max_error_over_condition: count it, then look at the condition number
  better,     // a better reference
};

class Tally {
 public:
  // `seen`: the maximum that other units of the row have found.
  explicit Tally(Maximum seen) : seen_(seen) {}

  // Counts the finding where that can be said at once: a correctly rounded result that is no maximum.
  [[nodiscard]] bool count_ordinary(const Finding& f, std::uint64_t k) {
    if (!(f.least > 0) || f.greatest > 0.5 || f.outcome != Outcome::finite || !f.correctly_rounded)
      return false;
    if (reaches(f.greatest, largest_error())) return false;
    return ordinary_.count(f.least, f.greatest, k);
  }

  // Counts what scan_ordinary settled of the samples from index `first` on, which rises from call to call.
  void count_scanned(std::span<const std::uint8_t> verdicts, std::uint64_t first);

  // condition_bound() is a lower bound of the condition number at the sample, called only where it matters;
  // `ratio_seen` is the largest error over condition so far.
  template <class ConditionBound>
  [[nodiscard]] Need need(const Finding& f, std::uint64_t k, double ratio_seen,
                          ConditionBound&& condition_bound) const {
    if (f.outcome != Outcome::finite || f.greatest == 0) return Need::nothing;
    if (f.least != f.greatest) {
      if (f.least == 0 || !same_bucket(f, k)) return Need::better;
      if (could_raise_maximum(f, k) && !f.error_known()) return Need::better;
    }
    if (!f.distance_known && f.distance > summary_.max_distance) return Need::better;
    if (f.greatest > 0.5 && could_raise_ratio(f.greatest, ratio_seen, condition_bound)) {
      return f.error_known() ? Need::condition : Need::better;
    }
    return Need::nothing;
  }

  // Of a finding that needs nothing better.
  void count(const Finding& f, std::uint64_t k);

  void raise_error_over_condition(double ratio) {
    summary_.max_error_over_condition = std::max(summary_.max_error_over_condition, ratio);
  }
  // What a scan of samples from index `first` on may settle now; `ratio_seen` as of need().
  [[nodiscard]] ScanLimits scan_limits(double ratio_seen, std::uint64_t first) const {
    const Maximum& most = most_seen();
    // Of equal errors the earliest is recorded.
    const bool half_is_seen = most.value > 0.5 || (most.value == 0.5 && most.index < first);
    return {most.value, ratio_seen, summary_.max_distance, half_is_seen};
  }
  // An error that could be as large as this is no ordinary one.
  [[nodiscard]] double largest_error() const { return most_seen().value; }
  [[nodiscard]] Maximum max_error() const { return summary_.max_error; }
  [[nodiscard]] OracleComparison& oracle() { return summary_.oracle; }
  // The summary of everything counted; ends the tally.
  [[nodiscard]] Summary take();

 private:
  // Counts of one bucket; an error is rounded to one of its edges for the mean.
  struct Bucket {
    std::uint64_t count = 0;
    std::uint64_t rounded_up = 0;
  };
  // Flat counts for errors up to 2^10 ULP; rarer ones go to the summary's map.
  static constexpr int flat_least = UlpHistogram::least;
  static constexpr int flat_greatest = 40;

  // Whether an error may be as large as a recorded one: rounding up to 40 bits adds less than this.
  [[nodiscard]] static bool reaches(double error, double recorded_error) {
    return error * (1 + 0x1p-38) + 0x1p-39 >= recorded_error;
  }
  // What is divided by the condition number is the recorded error, so that is what must reach the ratio: two
  // errors that are recorded as one are told apart by their condition numbers, whichever comes first.
  template <class ConditionBound>
  [[nodiscard]] static bool could_raise_ratio(double error, double ratio_seen,
                                              ConditionBound& condition_bound) {
    if (!reaches(error, ratio_seen)) return false;
    const double recorded_error = recorded({error}).value;
    return recorded_error > ratio_seen && recorded_error >= ratio_seen * (1 - 0x1p-38) * condition_bound();
  }
  [[nodiscard]] static bool same_bucket(const Finding& f, std::uint64_t k) {
    const int bucket = UlpHistogram::bucket({f.least});
    if (f.greatest > UlpHistogram::upper_edge(bucket)) return false;
    const double threshold = rounding_threshold(bucket, k);
    return (f.least > threshold) == (f.greatest > threshold);
  }
  // Of equal ones that of this unit.
  [[nodiscard]] const Maximum& most_seen() const {
    return seen_.value > summary_.max_error.value ? seen_ : summary_.max_error;
  }
  [[nodiscard]] bool could_raise_maximum(const Finding& f, std::uint64_t k) const {
    const Maximum& most = most_seen();
    if (!reaches(f.greatest, most.value)) return false;
    const double error = recorded({f.greatest}).value;
    // The sample that made the maximum says so again when its unit is evaluated once more.
    return error > most.value || (error == most.value && k <= most.index);
  }

  // Counts what count_scanned noted.
  void settle_scanned();

  // Eight lists: neighbours are alike, and one counter in turn would wait for itself.
  static constexpr std::size_t verdict_codes = 64;
  std::array<std::array<std::uint64_t, verdict_codes>, 8> scanned_{};
  std::uint64_t first_agreed_ = no_index;
  std::uint64_t first_scanned_ = no_index;  // and not agreed

  Summary summary_;
  Maximum seen_;
  OrdinaryErrors ordinary_;
  std::array<Bucket, flat_greatest - flat_least + 1> flat_{};
};

}  // namespace ulpgate
