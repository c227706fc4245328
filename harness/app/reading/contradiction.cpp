// What no measurement can have led to.
#include <fmt/format.h>

#include <cmath>

#include "harness/app/reading/row_text.hpp"

namespace ulpgate::app {

namespace {

using Contradiction = std::optional<std::string>;

// The error is recorded rounded up to 40 bits and may so leave its bucket, by no more than this.
constexpr double recording = 0x1p-38;

// Sums that a record may claim: beyond 64 bits they do not add up to anything.
class Count {
 public:
  void add(std::uint64_t n) { sum_ += n; }
  [[nodiscard]] bool is(std::uint64_t n) const { return sum_ == n; }

 private:
  unsigned __int128 sum_ = 0;
};

Contradiction of_counts(const RowRecord& r) {
  const Summary& s = r.summary;
  if (s.samples == 0) return "no samples";
  if (s.samples > r.planned) return fmt::format("{} samples of {} planned", s.samples, r.planned);
  Count outcomes;
  for (const auto n : s.outcomes) outcomes.add(n);
  if (!outcomes.is(s.samples)) return "judged and mismatched samples do not add up to samples";
  if (s.correctly_rounded > s.judged()) return "more results are correctly rounded than were judged";
  Count errors;
  errors.add(s.histogram.exact);
  for (const auto& [bucket, n] : s.histogram.counts) {
    errors.add(n);
    const bool octave = bucket > UlpHistogram::finest || bucket % 4 == 0;
    if (bucket < UlpHistogram::least || bucket > UlpHistogram::greatest || !octave)
      return fmt::format("the histogram has no bucket {}", bucket);
    if (n == 0) return fmt::format("bucket {} of the histogram is empty", bucket);
  }
  if (!errors.is(s.judged())) return "the counts of the histogram do not add up to the judged samples";
  for (std::size_t o = 1; o < outcome_count; ++o) {
    if (s.outcomes[o] > 0 && s.first_index[o] >= r.planned)
      return fmt::format("the first '{}' is at no point of the row", outcome_names[o]);
  }
  return std::nullopt;
}

bool in_bucket(double error, int bucket) {
  if (bucket == UlpHistogram::greatest) return error > UlpHistogram::lower_edge(bucket);
  return error > UlpHistogram::lower_edge(bucket) * (1 - recording) &&
         error <= UlpHistogram::upper_edge(bucket) * (1 + recording);
}

Contradiction of_maximum(const RowRecord& r) {
  const Summary& s = r.summary;
  const bool judged = s.judged() > 0;
  if (judged != (s.max_error.value >= 0) || judged != (s.max_error.index != no_index) ||
      judged != (s.max_distance >= 0))
    return judged ? "judged samples without a largest error" : "a largest error without judged samples";
  if (judged == r.points.argmax.empty()) return "'argmax' is not of the largest error";
  if (!judged) return std::nullopt;
  if (s.max_error.index >= r.planned) return "the largest error is at no point of the row";
  const auto& counts = s.histogram.counts;
  const double error = s.max_error.value;
  const bool fits = counts.empty() ? error == 0 : in_bucket(error, counts.rbegin()->first);
  if (!fits) return "'max_ulp' does not lie in the greatest bucket of the histogram";
  return std::nullopt;
}

// Every error counts as one edge of its bucket, at most as 2^60.
Contradiction of_sum(const Summary& s) {
  UlpSum least;
  UlpSum greatest;
  for (const auto& [bucket, n] : s.histogram.counts) {
    least.add_edges(UlpHistogram::lower_edge(bucket), n);
    greatest.add_edges(UlpHistogram::upper_edge(bucket), n);
  }
  const double sum = s.sum.mean(1);
  if (sum < least.mean(1) || sum > greatest.mean(1)) return "'ulp_sum' is none that the histogram allows";
  return std::nullopt;
}

Contradiction of_kernel(const RowRecord& r) {
  const Maximum& normwise = r.summary.normwise;
  if ((normwise.value >= 0) != (normwise.index != no_index) ||
      (normwise.index == no_index) != r.points.normwise_argmax.empty())
    return "'max_normwise' and its state do not belong together";
  if (normwise.index != no_index && normwise.index >= r.planned)
    return "the largest normwise error is at no point of the row";
  return std::nullopt;
}

Contradiction of_oracle(const RowRecord& r) {
  const OracleComparison& o = r.summary.oracle;
  if (o.compared > r.summary.samples || o.disagreed > o.compared)
    return "the oracles disagree oftener than they were compared";
  if ((o.difference.value >= 0) != (o.difference.index != no_index) ||
      (o.difference.index == no_index) != r.points.oracle_argmax.empty())
    return "the largest difference of the oracles and its arguments do not belong together";
  if (o.difference.index != no_index && (o.difference.index >= r.planned || o.compared == 0))
    return "the largest difference of the oracles is at no point that was compared";
  if (o.disagreed > 0 && !(o.difference.value > 0)) return "the oracles disagree without a difference";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> contradiction(const RowRecord& r) {
  if (auto why = of_counts(r)) return why;
  if (auto why = of_maximum(r)) return why;
  if (auto why = of_sum(r.summary)) return why;
  // It begins at 0, so that there is always one.
  if (!(r.summary.max_error_over_condition >= 0)) return "no largest error over the condition number";
  return r.subject_class == kernel_class ? of_kernel(r) : of_oracle(r);
}

}  // namespace ulpgate::app
