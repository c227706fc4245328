// Budgets and verdicts: the largest error that the gate accepts for each row, and the judgement of records by
// them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/core/records/row_record.hpp"

namespace ulpgate {

// The limits of one function part of one type.  Each stratum has its own: a libm that is 1e5 ULP off at one
// structured argument must not hide a regression to 5 ULP at ordinary ones.
struct Budget {
  std::string implementation;             // the code that was measured; empty where no record said
  std::map<std::string, double> max_ulp;  // by stratum
  // Kernels only: normwise error / (condition * unit roundoff), by stratum.
  std::map<std::string, double> over_condition;
  // "stratum.outcome" -> accepted count, e.g. "edges.zero_sign" -> 2.
  std::map<std::string, std::uint64_t> mismatch;
  std::string reason;  // why a limit was raised, empty if it never was
  friend bool operator==(const Budget&, const Budget&) = default;
};

// All budgets of one type, with the plan that they were measured by.
struct TypeBudgets {
  std::uint64_t samples = 0;
  std::uint64_t seed = 0;
  friend bool operator==(const TypeBudgets&, const TypeBudgets&) = default;
  std::map<std::string, Budget> rows;  // "sin", "ctan.re"
};
using Budgets = std::map<std::string, TypeBudgets>;  // by type token

// "sin" for a real function, "ctan.re" for a part.
[[nodiscard]] std::string budget_key(const RowRecord& record);

enum class FindingKind { regression, missing_budget, missing_record, incomplete, could_lower };

struct GateFinding {
  FindingKind kind;
  std::string type;
  std::string row;
  std::string message;
  double severity = 0;          // measured / budget; the worst come first
  std::vector<std::string> at;  // arguments that reproduce it
};

enum class MissingRecords { fail, ignore };

// Judges complete sets of records; findings are sorted: regressions by falling severity, then the others.
// Mismatch counts of drawn strata are compared as they are where samples and seed are those of the budget;
// for another size they are scaled, with five standard deviations of a Poisson count as allowance.
[[nodiscard]] std::vector<GateFinding> judge_records(const std::vector<RowRecord>& records,
                                                     const Budgets& budgets, MissingRecords missing);

// The budgets that just hold for these records: maxima rounded up to three significant digits.
[[nodiscard]] Budgets measured_budgets(const std::vector<RowRecord>& records, std::uint64_t samples,
                                       std::uint64_t seed);

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
// Merges `measured` into `present`: limits fall and rows appear freely; a limit that would rise is listed,
// and raised only with a reason.  Types, rows and strata that were not measured stay.
[[nodiscard]] std::vector<Raise> update_budgets(Budgets& present, const Budgets& measured,
                                                const std::string& reason);

}  // namespace ulpgate
