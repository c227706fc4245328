// What a budget limits, figure by figure: one table serves measuring, judging, updating and the files.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "harness/core/gate/budgets.hpp"

namespace ulpgate {

// A figure of a record and the limit of it that holds for the budget's own plan, and the one that holds for
// another seed or size where there is one (bounds.hpp).
struct LimitColumn {
  std::string_view key;    // in budget files
  std::string_view words;  // in findings
  std::map<std::string, double> Budget::*limits;
  std::map<std::string, double> Budget::*bounds;  // nullptr: none
  double (*figure)(const Summary&);
};
[[nodiscard]] const std::array<LimitColumn, 4>& limit_columns();
// The ones that are bounds of columns, by the key that they have in files.
struct BoundColumn {
  std::string_view key;
  std::map<std::string, double> Budget::*limits;
};
inline constexpr std::array<BoundColumn, 2> bound_columns = {
    {{"bound_ulp", &Budget::bound_ulp}, {"bound_over_condition", &Budget::bound_over_condition}}};

// A limit above this many times what was measured can be lowered.
inline constexpr double ratchet = 2;

// The smallest number of three significant digits that is not below x; infinity and NaN stay.
[[nodiscard]] double round_up(double x);

// Exponents of the errors 2^e ULP that `above` counts results beyond.  Twice as far apart each time: a
// result that leaves its decade joins a count, and a file holds a dozen of them at most.
inline constexpr std::array<int, 12> tail_exponents = {0, 1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1023};
// What lies beyond the last of them has no maximum that could be a limit.
inline constexpr int beyond_measure = tail_exponents.back();
// Results that err by more than 2^exponent ULP.
[[nodiscard]] std::uint64_t count_above(const UlpHistogram& histogram, int exponent);
// Results that err by more than `edge`, an upper edge of a bucket.
[[nodiscard]] std::uint64_t count_above_edge(const UlpHistogram& histogram, double edge);

// Mean and variance of the errors with those above `cap` counted as `cap`: bounded, so that the means of two
// samples can be compared whatever the tail is.  Errors count as the middle of their bucket.
struct WinsorizedMean {
  double mean = 0;
  double variance = 0;
};
[[nodiscard]] WinsorizedMean winsorized_mean(const UlpHistogram& histogram, double cap);

// How many of `samples` may have a property that `seen` of `seen_samples` others had: five standard
// deviations of the difference of two Poisson counts more than expected, and five for small ones.
[[nodiscard]] std::uint64_t allowed_count(std::uint64_t seen, std::uint64_t seen_samples,
                                          std::uint64_t samples);
// How far the means of two samples of numbers in [0, range] differ by chance with a probability of less than
// 1e-7: both sides' empirical Bernstein bounds (Maurer, Pontil: "Empirical Bernstein bounds and sample
// variance penalization", 2009).
[[nodiscard]] double mean_allowance(double variance, double range, std::uint64_t samples,
                                    std::uint64_t other_samples);

// Samples of the record's stratum when its budget was measured.
[[nodiscard]] std::uint64_t budgeted_samples(const RowRecord& record, const TypeBudgets& type,
                                             const Budget& budget);
// Whether the record's points are those that the budget was measured at.  A list is the same for every seed
// and size, as are all values of a type.
[[nodiscard]] bool is_of_plan(const RowRecord& record, const TypeBudgets& type, const Budget& budget);

// Whether they are some of them: of one seed the first points of a run are those of a smaller run, but for
// `stratified`, whose cells depend on their number.
[[nodiscard]] bool is_part_of_plan(const RowRecord& record, const TypeBudgets& type, const Budget& budget);

[[nodiscard]] std::string mismatch_key(const RowRecord& record, std::size_t outcome);
[[nodiscard]] bool is_of_stratum(const std::string& mismatch_key, const std::string& stratum);

}  // namespace ulpgate
