// Budgets and verdicts.
#include "harness/core/gate/budgets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>

#include "harness/core/plan/plan.hpp"

namespace ulpgate {

namespace {

// The smallest number of three significant digits that is not below x.
double round_up(double x) {
  if (!(x > 0) || !std::isfinite(x)) return x;
  for (double up = x;; up = std::nextafter(up * (1 + 1e-4), HUGE_VAL)) {
    // strtod, unlike stod, gives infinity beyond the range: the next limit above 1.79e308.
    const double rounded = std::strtod(fmt::format("{:.2e}", up).c_str(), nullptr);
    if (rounded >= x) return rounded;
  }
}

std::string mismatch_key(const RowRecord& r, std::size_t outcome) {
  return fmt::format("{}.{}", r.stratum, outcome_names[outcome]);
}

std::uint64_t allowed_count(std::uint64_t budgeted, const RowRecord& r, const TypeBudgets& type) {
  const Stratum stratum = find_stratum(r.stratum).value_or(Stratum::edges);
  if (!is_drawn(stratum)) return budgeted;
  const auto kind = r.subject_class == kernel_class ? SubjectKind::kernel : SubjectKind::function;
  const std::uint64_t planned_then =
      drawn_count(kind, stratum, type.samples, {Stratum::uniform, Stratum::stratified});
  if (planned_then == r.planned && type.seed == r.seed) return budgeted;
  if (budgeted == 0) return 0;
  const double expected = static_cast<double>(budgeted) * static_cast<double>(r.planned) /
                          static_cast<double>(std::max<std::uint64_t>(planned_then, 1));
  return static_cast<std::uint64_t>(std::ceil(expected + 5 * std::sqrt(expected) + 5));
}

// `limit` is the row's own in this stratum.
void judge_row(const RowRecord& r, const Budget& budget, double limit, const TypeBudgets& type,
               std::vector<GateFinding>& findings) {
  const std::string row = budget_key(r);
  const Summary& s = r.summary;
  // NaN limits cannot be: comparisons are written so that anything unordered fails.
  if (s.judged() > 0 && !(s.max_error.value <= limit)) {
    findings.push_back({FindingKind::regression, r.type, row,
                        fmt::format("maximum error {:.6g} ULP, budget {:.6g} ({}: got {}, exact {})",
                                    s.max_error.value, limit, r.stratum, r.points.got, r.points.exact),
                        s.max_error.value / std::max(limit, 1e-300), r.points.argmax});
  }
  const auto beyond = budget.over_condition.find(r.stratum);
  if (beyond != budget.over_condition.end() && !(s.max_error_over_condition <= beyond->second)) {
    findings.push_back({FindingKind::regression, r.type, row,
                        fmt::format("normwise error {:.4g} times condition and roundoff, budget {:.4g} ({})",
                                    s.max_error_over_condition, beyond->second, r.stratum),
                        s.max_error_over_condition / std::max(beyond->second, 1e-300),
                        r.points.normwise_argmax});
  }
  for (std::size_t o = 1; o < outcome_count; ++o) {
    if (s.outcomes[o] == 0) continue;
    const auto it = budget.mismatch.find(mismatch_key(r, o));
    const std::uint64_t allowed = it == budget.mismatch.end() ? 0 : allowed_count(it->second, r, type);
    if (s.outcomes[o] <= allowed) continue;
    findings.push_back({FindingKind::regression, r.type, row,
                        fmt::format("{} results of class {} in {}, budget {}", s.outcomes[o],
                                    outcome_names[o], r.stratum, allowed),
                        HUGE_VAL, r.points.first_mismatch.at(static_cast<Outcome>(o))});
  }
}

}  // namespace

std::string budget_key(const RowRecord& r) {
  return r.part == "value" ? r.subject : r.subject + "." + r.part;
}

std::vector<GateFinding> judge_records(const std::vector<RowRecord>& records, const Budgets& budgets,
                                       MissingRecords missing) {
  std::vector<GateFinding> findings;
  std::map<std::array<std::string, 3>, double> measured;  // by type, row, stratum
  for (const RowRecord& r : records) {
    const std::string row = budget_key(r);
    if (r.summary.samples != r.planned) {
      findings.push_back({FindingKind::incomplete,
                          r.type,
                          row,
                          fmt::format("{} of {} samples in {}", r.summary.samples, r.planned, r.stratum),
                          0,
                          {}});
    }
    measured[{r.type, row, r.stratum}] = r.summary.judged() > 0 ? r.summary.max_error.value : 0;
    const auto type = budgets.find(r.type);
    const Budget* budget = nullptr;
    if (type != budgets.end()) {
      const auto it = type->second.rows.find(row);
      if (it != type->second.rows.end() && it->second.max_ulp.contains(r.stratum)) budget = &it->second;
    }
    if (budget == nullptr) {
      findings.push_back({FindingKind::missing_budget,
                          r.type,
                          row,
                          fmt::format("no budget for {}; write one with --update", r.stratum),
                          0,
                          {}});
      continue;
    }
    judge_row(r, *budget, budget->max_ulp.at(r.stratum), type->second, findings);
  }
  for (const auto& [token, type] : budgets) {
    for (const auto& [row, budget] : type.rows) {
      for (const auto& [stratum, limit] : budget.max_ulp) {
        const auto it = measured.find({token, row, stratum});
        if (it == measured.end()) {
          if (missing == MissingRecords::fail) {
            findings.push_back({FindingKind::missing_record,
                                token,
                                row,
                                fmt::format("budgeted but not measured in {}", stratum),
                                0,
                                {}});
          }
        } else if (missing == MissingRecords::fail && it->second < 0.5 * limit) {
          findings.push_back({FindingKind::could_lower,
                              token,
                              row,
                              fmt::format("measured {:.4g} ULP in {}, budget {:.4g}: lower it with --update",
                                          it->second, stratum, limit),
                              0,
                              {}});
        }
      }
    }
  }
  std::stable_sort(findings.begin(), findings.end(), [](const GateFinding& a, const GateFinding& b) {
    if (a.kind != b.kind) return a.kind < b.kind;
    return a.severity > b.severity;
  });
  return findings;
}

std::vector<OtherCode> other_codes(const std::vector<RowRecord>& records, const Budgets& budgets) {
  std::map<std::array<std::string, 3>, std::set<std::string>> rows;
  for (const RowRecord& r : records) {
    const auto type = budgets.find(r.type);
    if (type == budgets.end()) continue;
    const auto budget = type->second.rows.find(budget_key(r));
    if (budget == type->second.rows.end()) continue;
    const std::string& then = budget->second.implementation;
    if (!then.empty() && then != r.implementation)
      rows[{r.type, then, r.implementation}].insert(budget->first);
  }
  std::vector<OtherCode> found;
  for (const auto& [key, names] : rows) found.push_back({key[0], key[1], key[2], names.size()});
  return found;
}

Budgets measured_budgets(const std::vector<RowRecord>& records, std::uint64_t samples, std::uint64_t seed) {
  Budgets budgets;
  for (const RowRecord& r : records) {
    TypeBudgets& type = budgets[r.type];
    type.samples = samples;
    type.seed = seed;
    Budget& budget = type.rows[budget_key(r)];
    budget.implementation = r.implementation;
    budget.max_ulp[r.stratum] = r.summary.judged() > 0 ? round_up(r.summary.max_error.value) : 0;
    if (r.subject_class == kernel_class)
      budget.over_condition[r.stratum] = round_up(r.summary.max_error_over_condition);
    for (std::size_t o = 1; o < outcome_count; ++o) {
      if (r.summary.outcomes[o] > 0) budget.mismatch[mismatch_key(r, o)] = r.summary.outcomes[o];
    }
  }
  return budgets;
}

namespace {

bool is_of_stratum(const std::string& mismatch_key, const std::string& stratum) {
  return mismatch_key.starts_with(stratum + ".");
}

// What would rise from `before` to `after`, as text; empty when nothing would.
std::string rises(const Budget& before, const Budget& after, bool same_plan) {
  std::string what;
  for (const auto& [stratum, limit] : after.max_ulp) {
    const auto old = before.max_ulp.find(stratum);
    if (old != before.max_ulp.end() && limit > old->second)
      what += fmt::format(" {} {:.4g} -> {:.4g} ULP", stratum, old->second, limit);
  }
  for (const auto& [stratum, limit] : after.over_condition) {
    const auto old = before.over_condition.find(stratum);
    if (old != before.over_condition.end() && limit > old->second)
      what += fmt::format(" {} {:.4g} -> {:.4g} over condition", stratum, old->second, limit);
  }
  for (const auto& [key, count] : after.mismatch) {
    // A stratum without a limit was never measured: its counts appear freely, like its limit.
    if (!before.max_ulp.contains(key.substr(0, key.find('.')))) continue;
    const auto old = before.mismatch.find(key);
    const std::uint64_t known = old == before.mismatch.end() ? 0 : old->second;
    // Counts of another plan are not comparable one by one; a new class always is a raise.
    if (count > known && (same_plan || known == 0)) what += fmt::format(" {} {} -> {}", key, known, count);
  }
  return what.empty() ? what : what.substr(1);
}

// Replaces the limits of the strata that `measured` holds.
void replace_strata(Budget& mine, const Budget& measured) {
  for (const auto& [stratum, limit] : measured.max_ulp) {
    mine.max_ulp[stratum] = limit;
    std::erase_if(mine.mismatch,
                  [&name = stratum](const auto& entry) { return is_of_stratum(entry.first, name); });
  }
  for (const auto& [stratum, limit] : measured.over_condition) mine.over_condition[stratum] = limit;
  mine.mismatch.insert(measured.mismatch.begin(), measured.mismatch.end());
  mine.implementation = measured.implementation;
}

}  // namespace

std::vector<Raise> update_budgets(Budgets& present, const Budgets& measured, const std::string& reason) {
  std::vector<Raise> raises;
  for (const auto& [token, type] : measured) {
    const bool new_type = !present.contains(token);
    TypeBudgets& mine = present[token];
    const bool same_plan = new_type || (mine.samples == type.samples && mine.seed == type.seed);
    mine.samples = type.samples;
    mine.seed = type.seed;
    for (const auto& [row, budget] : type.rows) {
      Budget& old = mine.rows[row];
      const std::string what = rises(old, budget, same_plan);
      if (!what.empty()) raises.push_back({token, row, what});
      if (!what.empty() && reason.empty()) continue;
      replace_strata(old, budget);
      if (!what.empty()) old.reason = reason;
    }
  }
  return raises;
}

}  // namespace ulpgate
