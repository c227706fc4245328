// RowTally<Real>: the tallies of a unit's parts, and the condition numbers that their records need.
#pragma once

#include <span>
#include <vector>

#include "harness/core/judging/tally.hpp"
#include "harness/core/records/row_hint.hpp"
#include "reference/condition/condition.hpp"
#include "reference/condition/condition_bound.hpp"

namespace ulpgate {

template <RealType Real>
[[nodiscard]] std::vector<MpfrValue> exact_arguments(const FunctionInfo& f, const Real* args) {
  std::vector<MpfrValue> values;
  for (int j = 0; j < f.arity; ++j) {
    values.emplace_back(std::numeric_limits<Real>::digits);
    to_mpfr(values.back().get(), args[j]);
  }
  return values;
}

template <RealType Real>
class RowTally {
 public:
  RowTally(const FunctionInfo& f, RowHint& hint) : function_(f), hint_(hint) {
    for (int part = 0; part < f.parts; ++part)
      parts_.emplace_back(hint.max_error(static_cast<std::size_t>(part)));
  }

  // Whether other units of the row have found maxima, which spare this one most of its search for them.
  [[nodiscard]] bool knows_maxima() const { return hint_.max_error(0).index != no_index; }

  // Of rows of one part, for samples from index `first` on.
  [[nodiscard]] ScanLimits scan_limits(std::uint64_t first) const {
    return parts_[0].scan_limits(hint_.error_over_condition[0].load(std::memory_order_relaxed), first);
  }
  void count_scanned(std::span<const std::uint8_t> verdicts, std::uint64_t first) {
    parts_[0].count_scanned(verdicts, first);
  }

  // Counts the sample if its findings, one a part, say enough; false if a better reference is needed.
  // values[part]: the exact value, to 2^-20 at least.
  bool settle(std::span<const Finding> findings, std::uint64_t k, const Real* args,
              std::span<const long double> values) {
    if (parts_.size() == 1 && parts_[0].count_ordinary(findings[0], k)) return true;
    std::array<Need, max_parts> needs{};
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      const double ratio = hint_.error_over_condition[part].load(std::memory_order_relaxed);
      needs[part] = parts_[part].need(findings[part], k, ratio, [&] {
        return condition_bound(args, values[part], static_cast<int>(part));
      });
      if (needs[part] == Need::better) return false;
    }
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      parts_[part].count(findings[part], k);
      if (needs[part] == Need::condition) update_condition(findings[part], args, part);
    }
    return true;
  }

  [[nodiscard]] OracleComparison& oracle(std::size_t part) { return parts_[part].oracle(); }

  // One summary a part; tells the row's other units the maxima.
  [[nodiscard]] std::vector<Summary> take() {
    std::vector<Summary> summaries;
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      summaries.push_back(parts_[part].take());
      hint_.raise_max_error(part, summaries.back().max_error);
    }
    return summaries;
  }

 private:
  [[nodiscard]] double condition_bound(const Real* args, long double value, int part) const {
    std::array<long double, max_arity> wide{};
    for (std::size_t j = 0; j < static_cast<std::size_t>(function_.arity); ++j)
      wide[j] = static_cast<long double>(args[j]);
    return std::max(1.0, condition_lower_bound(function_, wide.data(), value, part));
  }

  void update_condition(const Finding& finding, const Real* args, std::size_t part) {
    const double error = recorded({finding.greatest}).value;
    const auto values = exact_arguments(function_, args);
    const double condition =
        condition_number(function_, values, static_cast<int>(part), std::numeric_limits<Real>::digits);
    // Where the condition number is not defined the error stands as it is; inf/inf says nothing and is left
    // out.
    double ratio = condition > 1 ? error / condition : error;
    if (ratio != ratio) ratio = 0;
    parts_[part].raise_error_over_condition(ratio);
    hint_.raise_error_over_condition(part, ratio);
  }

  const FunctionInfo& function_;
  RowHint& hint_;
  std::vector<Tally> parts_;
};

}  // namespace ulpgate
