// What a budget limits.
#include "harness/core/gate/limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "harness/core/plan/plan.hpp"

namespace ulpgate {

const std::array<LimitColumn, 4>& limit_columns() {
  static const std::array<LimitColumn, 4> columns = {{
      {"max_ulp", "maximum error in ULP", &Budget::max_ulp, &Budget::bound_ulp,
       [](const Summary& s) { return s.max_error.value; }},
      {"mean_ulp", "mean error in ULP", &Budget::mean_ulp, nullptr,
       [](const Summary& s) { return s.sum.mean(s.judged()); }},
      {"p99_ulp", "99th percentile of the error in ULP", &Budget::p99_ulp, nullptr,
       [](const Summary& s) { return s.histogram.quantile(0.99); }},
      {"over_condition", "error over condition number", &Budget::over_condition,
       &Budget::bound_over_condition, [](const Summary& s) { return s.max_error_over_condition; }},
  }};
  return columns;
}

double round_up(double x) {
  if (!(x > 0) || !std::isfinite(x)) return x;
  for (double up = x;; up = std::nextafter(up * (1 + 1e-4), HUGE_VAL)) {
    // strtod, unlike stod, gives infinity beyond the range: the next limit above 1.79e308.
    const double rounded = std::strtod(fmt::format("{:.2e}", up).c_str(), nullptr);
    if (rounded >= x) return rounded;
  }
}

namespace {

std::uint64_t count_above_bucket(const UlpHistogram& histogram, int bucket) {
  std::uint64_t n = 0;
  for (auto it = histogram.counts.upper_bound(bucket); it != histogram.counts.end(); ++it) n += it->second;
  return n;
}

}  // namespace

std::uint64_t count_above(const UlpHistogram& histogram, int exponent) {
  return count_above_bucket(histogram, 4 * exponent);
}

std::uint64_t count_above_edge(const UlpHistogram& histogram, double edge) {
  // Of exact results only: whatever is not exact is above.
  if (!(edge > 0)) return count_above_bucket(histogram, UlpHistogram::least - 1);
  return count_above_bucket(histogram, UlpHistogram::bucket({edge}));
}

WinsorizedMean winsorized_mean(const UlpHistogram& histogram, double cap) {
  double n = static_cast<double>(histogram.exact);
  double sum = 0;
  double squares = 0;
  for (const auto& [bucket, count] : histogram.counts) {
    const double edge = UlpHistogram::upper_edge(bucket);
    const double error = edge > cap ? cap : (edge + UlpHistogram::lower_edge(bucket)) / 2;
    const auto times = static_cast<double>(count);
    n += times;
    sum += times * error;
    squares += times * error * error;
  }
  if (n == 0) return {};
  const double mean = sum / n;
  return {mean, std::max(0.0, squares / n - mean * mean)};
}

std::uint64_t allowed_count(std::uint64_t seen, std::uint64_t seen_samples, std::uint64_t samples) {
  const double ratio =
      static_cast<double>(samples) / static_cast<double>(std::max<std::uint64_t>(seen_samples, 1));
  const double expected = static_cast<double>(seen) * ratio;
  return static_cast<std::uint64_t>(std::ceil(expected + 5 * std::sqrt(expected * (1 + ratio)) + 5));
}

double mean_allowance(double variance, double range, std::uint64_t samples, std::uint64_t other_samples) {
  constexpr double log_of_chance = 16.8;  // ln(2 / 1e-7)
  const auto one_side = [&](std::uint64_t n) {
    const double size = std::max(2.0, static_cast<double>(n));
    return std::sqrt(2 * variance * log_of_chance / size) + 7 * range * log_of_chance / (3 * (size - 1));
  };
  return one_side(samples) + one_side(other_samples);
}

std::uint64_t budgeted_samples(const RowRecord& r, const TypeBudgets& type, const Budget& budget) {
  const auto then = budget.samples.find(r.stratum);
  if (then != budget.samples.end()) return then->second;
  const auto stratum = find_stratum(r.stratum);
  if (!stratum || !is_drawn(*stratum)) return r.planned;
  const auto kind = r.subject_class == kernel_class ? SubjectKind::kernel : SubjectKind::function;
  return drawn_count(kind, *stratum, type.samples, {Stratum::uniform, Stratum::stratified});
}

bool is_of_plan(const RowRecord& r, const TypeBudgets& type, const Budget& budget) {
  const auto stratum = find_stratum(r.stratum);
  if (!stratum) return false;
  if (is_drawn(*stratum) && type.seed != r.seed) return false;
  return budgeted_samples(r, type, budget) == r.planned;
}

bool is_part_of_plan(const RowRecord& r, const TypeBudgets& type, const Budget& budget) {
  const auto stratum = find_stratum(r.stratum);
  return stratum && is_drawn(*stratum) && *stratum != Stratum::stratified && type.seed == r.seed &&
         r.planned <= budgeted_samples(r, type, budget);
}

std::string mismatch_key(const RowRecord& r, std::size_t outcome) {
  return fmt::format("{}.{}", r.stratum, outcome_names[outcome]);
}

bool is_of_stratum(const std::string& mismatch_key, const std::string& stratum) {
  return mismatch_key.starts_with(stratum + ".");
}

}  // namespace ulpgate
