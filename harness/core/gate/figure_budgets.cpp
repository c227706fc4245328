// Budgets of rows that have a few named figures.
#include "harness/core/gate/figure_budgets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/core/gate/digest.hpp"
#include "harness/core/gate/limits.hpp"
#include "harness/core/verdict/verdict.hpp"

namespace ulpgate {

namespace {

constexpr auto least_value = LimitSense::at_least;

constexpr std::array<FigureColumn, 5> scene_columns = {
    {{"t_s", "true for", "s", LimitSense::at_least, 1, t_s_allowance},
     {"max_energy_error", "energy error", "J"},
     {"max_energy_error_raw", "energy error with half-step velocities", "J"},
     {"max_energy_created", "energy made in a collision", "of the pair's"},
     // Of these nobody knows what they made of energy: their number is what can be held.
     {"still_open", "collisions that the end of the run cut off:", "", LimitSense::at_most, 1}}};
// An order is measured next to the floor of rounding, where a last digit moves it by some hundredths.
constexpr std::array<FigureColumn, 2> order_columns = {
    {{"measured_order", "measured order", "", LimitSense::at_least, 1, 0.05},
     {"least_error", "least error", ""}}};
constexpr std::array<FigureColumn, 1> drift_columns = {{{"max_energy_error", "energy error", ""}}};
constexpr std::array<FigureColumn, 1> stress_columns = {{{"error", "error of rounding", ""}}};
constexpr std::array<FigureColumn, 3> work_columns = {{{"final_error", "final error", ""},
                                                       {"largest_error", "largest error", ""},
                                                       {"energy_error", "energy error", ""}}};

}  // namespace

std::span<const FigureColumn> figure_columns(RowKind of) {
  switch (of) {
    case RowKind::scene:
      return scene_columns;
    case RowKind::order:
      return order_columns;
    case RowKind::drift:
      return drift_columns;
    case RowKind::stress:
      return stress_columns;
    case RowKind::work_precision:
      return work_columns;
    default:
      return {};
  }
}

namespace {

std::string label(const MeasuredRow& m) {
  return m.run.empty() ? m.name : m.name + " " + m.run;
}

const FigureBudget* find_budget(const FigureBudgets& budgets, const MeasuredRow& m) {
  const auto file = budgets.find(m.name);
  if (file == budgets.end()) return nullptr;
  const auto row = file->second.rows.find(figure_key(m));
  return row == file->second.rows.end() ? nullptr : &row->second;
}

GateFinding finding(FindingKind kind, const MeasuredRow& m, std::string message, double severity = 0) {
  GateFinding f{kind, m.type, label(m), std::move(message), severity};
  f.of = m.of;
  f.reproduce = m.reproduce;
  f.budget_file = m.name;
  f.budget_key = figure_key(m);
  return f;
}

std::string with_unit(double x, const FigureColumn& column) {
  return fmt::format("{:.4g}{}{}", x, column.unit.empty() ? "" : " ", column.unit);
}

bool holds(const FigureColumn& column, double measured, double limit) {
  if (column.sense == least_value)
    return ulpgate::at_least(measured, limit - column.allowance) == Standing::pass;
  return measured >= 0 && ulpgate::at_most(measured, limit) == Standing::pass;
}

// Above 1 beyond the limit.
double ratio_of(const FigureColumn& column, double measured, double limit) {
  if (std::isnan(measured)) return HUGE_VAL;
  return column.sense == least_value ? limit / std::max(measured, 1e-9) : budget_ratio(measured, limit);
}

void judge_one(const MeasuredRow& m, const FigureBudget& budget, std::vector<GateFinding>& findings) {
  if (budget.limits.empty() && budget.outcome.empty() && budget.digest.empty())
    findings.push_back(finding(FindingKind::missing_budget, m, "its budget limits nothing"));
  if (budget.outcome != m.outcome) {
    GateFinding f = finding(FindingKind::regression, m,
                            fmt::format("{}, budget {}", m.outcome.empty() ? "no outcome" : m.outcome,
                                        budget.outcome.empty() ? "of no outcome" : budget.outcome),
                            HUGE_VAL);
    f.what = "outcome";
    f.got = m.outcome;
    f.wanted = budget.outcome;
    findings.push_back(std::move(f));
  }
  if (!budget.digest.empty() && budget.digest != m.digest) {
    GateFinding f =
        m.digest.empty()
            ? finding(FindingKind::incomplete, m, "a digest is budgeted and was not measured")
            : finding(FindingKind::other_results, m,
                      fmt::format("final state {}, of the budget {} (--update where that is meant)", m.digest,
                                  budget.digest));
    f.what = "final state";
    f.got = m.digest;
    f.wanted = budget.digest;
    findings.push_back(std::move(f));
  }
  for (const auto& column : figure_columns(m.of)) {
    const auto limit = budget.limits.find(std::string(column.key));
    if (limit == budget.limits.end()) continue;
    const auto figure = m.figures.find(limit->first);
    if (figure == m.figures.end()) {
      findings.push_back(finding(FindingKind::incomplete, m,
                                 fmt::format("{} is budgeted and was not measured",
                                             column.sense == least_value ? column.key : column.words)));
    } else if (!holds(column, figure->second, limit->second)) {
      GateFinding f = finding(FindingKind::regression, m,
                              fmt::format("{} {}, budget {}", column.words, with_unit(figure->second, column),
                                          with_unit(limit->second, column)),
                              ratio_of(column, figure->second, limit->second));
      f.what = column.words;
      f.measured = figure->second;
      f.budget = limit->second;
      findings.push_back(std::move(f));
    }
  }
}

// The budget's number for what was measured.
double limit_of(const FigureColumn& column, double measured) {
  return column.sense == least_value ? measured : round_up(column.margin * measured);
}

// Whether the budget asks for less than half of what this run shows.
bool is_slack(const FigureColumn& column, double measured, double limit) {
  if (!std::isfinite(measured) || measured < 0) return false;
  return column.sense == least_value ? limit < measured / ratchet
                                     : limit_of(column, measured) < limit / ratchet;
}

void note_slack(const MeasuredRow& m, const FigureBudget& budget, std::vector<GateFinding>& findings) {
  for (const auto& column : figure_columns(m.of)) {
    const auto limit = budget.limits.find(std::string(column.key));
    const auto figure = m.figures.find(std::string(column.key));
    if (limit == budget.limits.end() || figure == m.figures.end()) continue;
    if (!is_slack(column, figure->second, limit->second)) continue;
    GateFinding f =
        finding(FindingKind::could_lower, m,
                fmt::format("measured {} {}, budget {}: {}", column.words, with_unit(figure->second, column),
                            with_unit(limit->second, column),
                            budget.reason.empty() ? "can be lowered (--tighten)"
                                                  : "was raised for a reason, --update lowers it"));
    f.what = column.words;
    f.measured = figure->second;
    f.budget = limit->second;
    findings.push_back(std::move(f));
  }
}

}  // namespace

void forget_digests(FigureBudgets& budgets) {
  for (auto& [name, file] : budgets)
    for (auto& [key, budget] : file.rows) budget.digest.clear();
}

std::string figure_key(const MeasuredRow& m) {
  return m.run.empty() ? m.type : m.type + " " + m.run;
}

std::vector<GateFinding> breaches(const std::vector<MeasuredRow>& measured) {
  std::vector<GateFinding> findings;
  for (const auto& m : measured) {
    if (m.breach.empty()) continue;
    GateFinding f = finding(FindingKind::regression, m, m.breach, HUGE_VAL);
    f.what = "what holds whatever the budgets say";
    f.got = m.got;
    f.wanted = m.wanted;
    findings.push_back(std::move(f));
  }
  return findings;
}

std::vector<GateFinding> judge_figures(const std::vector<MeasuredRow>& measured, const FigureBudgets& budgets,
                                       MissingRecords missing) {
  std::vector<GateFinding> findings = breaches(measured);
  for (const auto& m : measured) {
    const FigureBudget* budget = find_budget(budgets, m);
    if (budget == nullptr) {
      findings.push_back(finding(FindingKind::missing_budget, m, "no budget; write one with --update"));
      continue;
    }
    judge_one(m, *budget, findings);
    const auto open = m.figures.find("still_open");
    if (open != m.figures.end() && open->second > 0 && !budget->limits.contains("still_open")) {
      findings.push_back(finding(
          FindingKind::missing_budget, m,
          fmt::format("{:g} collisions are cut off by the end of the run, and no budget says how many "
                      "may be; write one with --update",
                      open->second)));
    }
    if (missing == MissingRecords::fail) note_slack(m, *budget, findings);
  }
  for (const auto& [name, file] : budgets) {
    for (const auto& [key, budget] : file.rows) {
      const bool found = std::ranges::any_of(measured, [&name = name, &key = key](const auto& m) {
        // By name: clang 14 captures no structured bindings.
        return m.name == name && figure_key(m) == key;
      });
      if (found || missing == MissingRecords::ignore) continue;
      const std::size_t space = std::min(key.find(' '), key.size());
      GateFinding f{FindingKind::missing_record, key.substr(0, space), name + key.substr(space),
                    "budgeted but not measured"};
      f.of = file.of;
      f.budget_file = name;
      f.budget_key = key;
      findings.push_back(std::move(f));
    }
  }
  sort_findings(findings);
  return findings;
}

std::vector<JudgedRow> judged_rows(const std::vector<MeasuredRow>& measured, const FigureBudgets& budgets) {
  std::vector<JudgedRow> rows;
  for (const auto& m : measured) {
    const FigureBudget* budget = find_budget(budgets, m);
    bool any = false;
    for (const auto& column : figure_columns(m.of)) {
      const auto figure = m.figures.find(std::string(column.key));
      if (figure == m.figures.end()) continue;
      any = true;
      JudgedRow row{m.of, m.type, label(m), "", std::string(column.key), figure->second, {}, {}};
      if (budget != nullptr && budget->limits.contains(figure->first)) {
        row.budget = budget->limits.at(figure->first);
        row.ratio = ratio_of(column, figure->second, *row.budget);
      }
      rows.push_back(std::move(row));
    }
    if (!any) rows.push_back({m.of, m.type, label(m), "", "outcome", {}, {}, {}});
  }
  return rows;
}

FigureBudget measured_figure_budget(const MeasuredRow& m) {
  FigureBudget b;
  b.outcome = m.outcome;
  if (has_portable_results(m.type)) b.digest = m.digest;
  for (const auto& column : figure_columns(m.of)) {
    const auto figure = m.figures.find(std::string(column.key));
    if (figure != m.figures.end()) b.limits[figure->first] = limit_of(column, figure->second);
  }
  return b;
}

std::vector<Raise> update_figure_budgets(FigureBudgets& present, const std::vector<MeasuredRow>& measured,
                                         const std::string& reason) {
  std::vector<Raise> raises;
  for (const auto& m : measured) {
    const FigureBudget now = measured_figure_budget(m);
    FigureFile& file = present[m.name];
    file.of = m.of;
    const auto [row, fresh] = file.rows.try_emplace(figure_key(m), now);
    if (fresh) continue;
    FigureBudget& kept = row->second;
    std::string what;
    for (const auto& column : figure_columns(m.of)) {
      const auto after = now.limits.find(std::string(column.key));
      if (after == now.limits.end()) continue;
      const auto before = kept.limits.find(after->first);
      if (before == kept.limits.end()) {
        kept.limits.insert(*after);
        continue;
      }
      const bool looser = column.sense == least_value ? !(after->second >= before->second)
                                                      : !(after->second <= before->second);
      if (looser)
        what += fmt::format(" {} {:g} -> {:g}", column.sense == least_value ? column.key : column.words,
                            before->second, after->second);
      if (!looser || !reason.empty()) before->second = after->second;
    }
    if (kept.outcome != now.outcome) {
      what += fmt::format(" outcome '{}' -> '{}'", kept.outcome, now.outcome);
      if (!reason.empty()) kept.outcome = now.outcome;
    }
    // Other results are no looser ones: what is loosened decides.
    if (what.empty() || !reason.empty()) kept.digest = now.digest;
    if (what.empty()) continue;
    raises.push_back({m.type, label(m), what});
    if (!reason.empty()) kept.reason = reason;
  }
  return raises;
}

std::vector<Raise> tighten_figure_budgets(FigureBudgets& present, const std::vector<MeasuredRow>& measured) {
  std::vector<Raise> changes;
  for (const auto& m : measured) {
    if (find_budget(present, m) == nullptr) continue;
    FigureBudget& budget = present.at(m.name).rows.at(figure_key(m));
    if (!budget.reason.empty()) continue;
    std::string what;
    for (const auto& column : figure_columns(m.of)) {
      const auto limit = budget.limits.find(std::string(column.key));
      const auto figure = m.figures.find(std::string(column.key));
      if (limit == budget.limits.end() || figure == m.figures.end()) continue;
      if (!is_slack(column, figure->second, limit->second)) continue;
      const double after = limit_of(column, figure->second);
      what += fmt::format("{}{} {:g} -> {:g}", what.empty() ? "" : "; ", column.key, limit->second, after);
      limit->second = after;
    }
    if (!what.empty()) changes.push_back({m.type, label(m), what});
  }
  return changes;
}

}  // namespace ulpgate
