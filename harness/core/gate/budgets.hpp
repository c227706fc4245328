// Budgets and verdicts: what the gate accepts of each row, and the judgement of records by it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/core/gate/findings/gate_finding.hpp"
#include "harness/core/records/row_record.hpp"

namespace ulpgate {

// The limits of one function part of one type, by stratum: a libm that is 1e5 ULP off at one structured
// argument must not hide a regression to 5 ULP at ordinary ones.  No limit is infinite: where an error is
// beyond measure there is no max_ulp, and `above` says how often that may be.
struct Budget {
  std::string implementation;                    // the code that was measured; empty where no record said
  std::map<std::string, std::uint64_t> samples;  // by stratum; its keys are the strata that were measured
  std::map<std::string, double> max_ulp;
  std::map<std::string, double> mean_ulp;
  std::map<std::string, double> p99_ulp;
  // Largest error over condition number; of kernels normwise / (condition * unit roundoff).
  std::map<std::string, double> over_condition;
  // Drawn strata: what no seed exceeds (bounds.hpp), which a plan of another seed or size is held to.
  std::map<std::string, double> bound_ulp;
  std::map<std::string, double> bound_over_condition;
  // Mean of the errors with those above p99_ulp counted as that, which another plan is compared by.
  std::map<std::string, double> winsorized_ulp;
  // Results that err by more than 2^exponent ULP, by exponent.  Of a list they say that no other argument may
  // join those that are known to be bad.
  std::map<std::string, std::map<int, std::uint64_t>> above;
  // "stratum.outcome" -> accepted count, e.g. "edges.zero_sign" -> 2.
  std::map<std::string, std::uint64_t> mismatch;
  // Of kernels, by stratum (digest.hpp): a record of the same points with another one has other results.
  std::map<std::string, std::string> digest;
  std::string reason;  // why a limit was raised, empty if it never was
  friend bool operator==(const Budget&, const Budget&) = default;

  // Whether the stratum was measured.
  [[nodiscard]] bool knows(const std::string& stratum) const {
    return samples.contains(stratum) || max_ulp.contains(stratum);
  }
};

// All budgets of one type, with the plan that they were measured by.
struct TypeBudgets {
  std::uint64_t samples = 0;
  std::uint64_t seed = 0;
  friend bool operator==(const TypeBudgets&, const TypeBudgets&) = default;
  std::map<std::string, Budget> rows;  // "sin", "ctan.re"
  // What decides bits where the limits were measured, by name; empty where nobody wrote it down.
  std::map<std::string, std::string> machine;
};
using Budgets = std::map<std::string, TypeBudgets>;  // by type token

// "sin" for a real function, "ctan.re" for a part.
[[nodiscard]] std::string budget_key(const RowRecord& record);

// What only a platform's own budgets can say is left out: on another one it would turn every row red.
void forget_digests(Budgets& budgets);

enum class MissingRecords { fail, ignore };

// What to do with drawn strata of another seed or size than the budget's.
struct OtherPlan {
  bool accepted = false;  // hold them to the limits that are derived for other plans
  // Fewer samples of a stratum than this say too little to be judged; nothing: a tenth of the budget's.
  std::optional<std::uint64_t> least_samples;
};

// Judges complete sets of records; findings are sorted: by kind, regressions by falling severity.
[[nodiscard]] std::vector<GateFinding> judge_records(const std::vector<RowRecord>& records,
                                                     const Budgets& budgets, MissingRecords missing,
                                                     const OtherPlan& other_plan = {});

// What each record was held against: its largest error, and the largest part of a limit.
[[nodiscard]] std::vector<JudgedRow> judged_rows(const std::vector<RowRecord>& records,
                                                 const Budgets& budgets);

// The budgets that just hold for these records: figures rounded up to three significant digits.
[[nodiscard]] Budgets measured_budgets(const std::vector<RowRecord>& records, std::uint64_t samples,
                                       std::uint64_t seed);

// Why these budgets, which were measured by another plan, cannot become part of `present`; empty where they
// can.  The plan of a type's file is that of all its rows.
[[nodiscard]] std::string why_another_plan(const Budgets& present, const std::vector<RowRecord>& records,
                                           std::uint64_t samples, std::uint64_t seed);

// Rows that were measured with another code than their budget was.
struct OtherCode {
  std::string type;
  std::string budgeted;  // implementations
  std::string measured;
  std::size_t rows = 0;
};
[[nodiscard]] std::vector<OtherCode> other_codes(const std::vector<RowRecord>& records,
                                                 const Budgets& budgets);

// A measured row that is worse than the present budget.
struct Raise {
  std::string type;
  std::string row;
  std::string what;
};
// Merges `measured`, of the same plan, into `present`: limits fall and rows appear freely; a limit that would
// become looser in any way is listed, and changed only with a reason.  Types, rows and strata that were not
// measured stay.
[[nodiscard]] std::vector<Raise> update_budgets(Budgets& present, const Budgets& measured,
                                                const std::string& reason);

// Limits that are above twice what was measured at the budget's own points become what was measured, figures
// rounded up to three digits; nothing becomes looser, and no list loses its worst cases by it.  Rows that
// were raised for a reason stay: what they were raised for need not show here.  Returns what became tighter.
[[nodiscard]] std::vector<Raise> tighten_budgets(Budgets& present, const std::vector<RowRecord>& records);

}  // namespace ulpgate
