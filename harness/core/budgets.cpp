// Budgets and verdicts.
#include "harness/core/budgets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

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
  const bool drawn = is_drawn(find_stratum(r.stratum).value_or(Stratum::edges));
  if (!drawn) return budgeted;
  const std::uint64_t planned_then = Plan::drawn_count(*find_stratum(r.stratum), type.samples);
  if (planned_then == r.planned && type.seed == r.seed) return budgeted;
  if (budgeted == 0) return 0;
  const double expected = static_cast<double>(budgeted) * static_cast<double>(r.planned) /
                          static_cast<double>(std::max<std::uint64_t>(planned_then, 1));
  return static_cast<std::uint64_t>(std::ceil(expected + 5 * std::sqrt(expected) + 5));
}

void judge_row(const RowRecord& r, const Budget& budget, const TypeBudgets& type,
               std::vector<Finding>& findings) {
  const std::string row = budget_key(r);
  const Summary& s = r.summary;
  // NaN limits cannot be: comparisons are written so that anything unordered fails.
  if (s.judged() > 0 && !(s.max_error.value <= budget.max_ulp)) {
    findings.push_back(
        {FindingKind::regression, r.type, row,
         fmt::format("maximum error {:.6g} ULP, budget {:.6g} ({}: got {}, exact {})", s.max_error.value,
                     budget.max_ulp, r.stratum, r.points.got, r.points.exact),
         s.max_error.value / std::max(budget.max_ulp, 1e-300), r.points.argmax});
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
  return r.part == "value" ? r.function : r.function + "." + r.part;
}

std::vector<Finding> judge_records(const std::vector<RowRecord>& records, const Budgets& budgets,
                                   MissingRecords missing) {
  std::vector<Finding> findings;
  std::map<std::pair<std::string, std::string>, double> measured;
  std::set<std::pair<std::string, std::string>> unbudgeted;
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
    auto& most = measured.try_emplace({r.type, row}, -1).first->second;
    most = std::max(most, r.summary.max_error.value);
    const auto type = budgets.find(r.type);
    if (type == budgets.end() || !type->second.rows.contains(row)) {
      if (unbudgeted.insert({r.type, row}).second) {
        findings.push_back(
            {FindingKind::missing_budget, r.type, row, "no budget; write one with --update", 0, {}});
      }
      continue;
    }
    judge_row(r, type->second.rows.at(row), type->second, findings);
  }
  for (const auto& [token, type] : budgets) {
    for (const auto& [row, budget] : type.rows) {
      const auto it = measured.find({token, row});
      if (it == measured.end()) {
        if (missing == MissingRecords::fail) {
          findings.push_back({FindingKind::missing_record, token, row, "budgeted but not measured", 0, {}});
        }
        continue;
      }
      if (it->second >= 0 && it->second < 0.5 * budget.max_ulp) {
        findings.push_back({FindingKind::could_lower,
                            token,
                            row,
                            fmt::format("measured {:.4g} ULP, budget {:.4g}: lower it with --update",
                                        it->second, budget.max_ulp),
                            0,
                            {}});
      }
    }
  }
  std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
    if (a.kind != b.kind) return a.kind < b.kind;
    return a.severity > b.severity;
  });
  return findings;
}

Budgets measured_budgets(const std::vector<RowRecord>& records, std::uint64_t samples, std::uint64_t seed) {
  Budgets budgets;
  for (const RowRecord& r : records) {
    TypeBudgets& type = budgets[r.type];
    type.samples = samples;
    type.seed = seed;
    Budget& budget = type.rows[budget_key(r)];
    budget.max_ulp = std::max(budget.max_ulp, round_up(r.summary.max_error.value));
    for (std::size_t o = 1; o < outcome_count; ++o) {
      if (r.summary.outcomes[o] > 0) budget.mismatch[mismatch_key(r, o)] = r.summary.outcomes[o];
    }
  }
  return budgets;
}

std::vector<Raise> update_budgets(Budgets& present, const Budgets& measured, const std::string& reason) {
  std::vector<Raise> raises;
  for (const auto& [token, type] : measured) {
    const bool new_type = !present.contains(token);
    TypeBudgets& mine = present[token];
    const bool same_plan = new_type || (mine.samples == type.samples && mine.seed == type.seed);
    mine.samples = type.samples;
    mine.seed = type.seed;
    for (const auto& [row, budget] : type.rows) {
      const auto it = mine.rows.find(row);
      if (it == mine.rows.end()) {
        mine.rows[row] = budget;
        continue;
      }
      std::string what;
      if (budget.max_ulp > it->second.max_ulp) {
        what = fmt::format("max_ulp {:.4g} -> {:.4g}", it->second.max_ulp, budget.max_ulp);
      }
      for (const auto& [key, count] : budget.mismatch) {
        const auto old = it->second.mismatch.find(key);
        const std::uint64_t before = old == it->second.mismatch.end() ? 0 : old->second;
        // Counts of another plan are not comparable one by one; a new class always is a raise.
        if (count > before && (same_plan || before == 0))
          what += fmt::format(" {} {} -> {}", key, before, count);
      }
      if (what.empty()) {
        const std::string kept = it->second.reason;
        it->second = budget;
        it->second.reason = kept;
      } else {
        raises.push_back({token, row, what});
        if (!reason.empty()) {
          it->second = budget;
          it->second.reason = reason;
        }
      }
    }
  }
  return raises;
}

}  // namespace ulpgate
