// Budgets of a platform.
#include "harness/core/gate/platform_rows.hpp"

#include <algorithm>
#include <set>

namespace ulpgate {

namespace {

template <class AllBudgets>
AllBudgets laid_over(AllBudgets base, const AllBudgets& overlay) {
  for (const auto& [file, content] : overlay) {
    const auto [at, fresh] = base.try_emplace(file, content);
    if (fresh) continue;
    for (const auto& [row, budget] : content.rows) at->second.rows[row] = budget;
  }
  return base;
}

// The rows, by file and key, of which the platform says something else than the budgets.
std::set<std::pair<std::string, std::string>> rows_that_differ(const std::vector<GateFinding>& findings) {
  std::set<std::pair<std::string, std::string>> rows;
  for (const auto& f : findings) {
    if (f.kind == FindingKind::regression || f.kind == FindingKind::missing_budget ||
        f.kind == FindingKind::lost_cases || f.kind == FindingKind::other_results)
      rows.insert({f.budget_file, f.budget_key});
  }
  return rows;
}

std::string what_of(const std::vector<GateFinding>& findings, const std::string& file,
                    const std::string& key) {
  const auto first = std::ranges::find_if(
      findings, [&](const auto& f) { return f.budget_file == file && f.budget_key == key; });
  return first == findings.end() ? "" : first->message;
}

}  // namespace

Budgets overlaid(Budgets base, const Budgets& overlay) {
  return laid_over(std::move(base), overlay);
}

FigureBudgets overlaid(FigureBudgets base, const FigureBudgets& overlay) {
  return laid_over(std::move(base), overlay);
}

PlatformRows<Budgets> platform_rows(const Budgets& held, const Budgets& measured,
                                    const std::vector<RowRecord>& records, const std::string& reason) {
  PlatformRows<Budgets> found;
  const auto findings = judge_records(records, held, MissingRecords::ignore);
  for (const auto& [token, row] : rows_that_differ(findings)) {
    const TypeBudgets& here = measured.at(token);
    TypeBudgets& type = found.rows[token];
    type.samples = here.samples;
    type.seed = here.seed;
    type.machine = here.machine;
    Budgets one;
    if (held.contains(token) && held.at(token).rows.contains(row))
      one[token].rows[row] = held.at(token).rows.at(row);
    Budgets now;
    now[token] = {here.samples, here.seed, {{row, here.rows.at(row)}}, here.machine};
    static_cast<void>(update_budgets(one, now, reason));
    Budget& budget = one[token].rows[row];
    budget.reason = reason;
    for (auto& [stratum, bound] : budget.bound_ulp) {
      const auto limit = budget.max_ulp.find(stratum);
      if (limit != budget.max_ulp.end()) bound = std::max(bound, limit->second);
    }
    for (auto& [stratum, bound] : budget.bound_over_condition) {
      const auto limit = budget.over_condition.find(stratum);
      if (limit != budget.over_condition.end()) bound = std::max(bound, limit->second);
    }
    type.rows[row] = std::move(budget);
    found.changes.push_back({token, row, what_of(findings, token, row)});
  }
  return found;
}

PlatformRows<FigureBudgets> platform_rows(const FigureBudgets& held, const std::vector<MeasuredRow>& measured,
                                          const std::string& reason) {
  PlatformRows<FigureBudgets> found;
  const auto findings = judge_figures(measured, held, MissingRecords::ignore);
  const auto rows = rows_that_differ(findings);
  for (const auto& m : measured) {
    if (!rows.contains({m.name, figure_key(m)})) continue;
    FigureFile& file = found.rows[m.name];
    file.of = m.of;
    FigureBudget budget = measured_figure_budget(m);
    // A figure within its limit keeps it.
    const auto base = held.find(m.name);
    if (base != held.end() && base->second.rows.contains(figure_key(m))) {
      for (const auto& [key, limit] : base->second.rows.at(figure_key(m)).limits) {
        const bool beyond = std::ranges::any_of(findings, [&, &key = key](const auto& f) {
          const auto columns = figure_columns(m.of);
          const auto column = std::ranges::find(columns, key, &FigureColumn::key);
          return f.budget_file == m.name && f.budget_key == figure_key(m) &&
                 f.kind == FindingKind::regression && column != columns.end() && f.what == column->words;
        });
        if (!beyond) budget.limits[key] = limit;
      }
    }
    budget.reason = reason;
    file.rows[figure_key(m)] = std::move(budget);
    found.changes.push_back(
        {m.type, m.name + (m.run.empty() ? "" : " " + m.run), what_of(findings, m.name, figure_key(m))});
  }
  return found;
}

}  // namespace ulpgate
