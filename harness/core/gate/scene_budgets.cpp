// Budgets of scenes.
#include "harness/core/gate/scene_budgets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/core/gate/limits.hpp"
#include "harness/core/verdict/verdict.hpp"

namespace ulpgate {

namespace {

// An energy error of a run whose every rounding is fixed varies only with the C library that made the start.
constexpr double energy_margin = 1.1;

using Limit = std::optional<double> SceneBudget::*;
using Value = std::optional<double> SceneMeasurement::*;
struct EnergyColumn {
  const char* name;
  Value value;
  Limit limit;
  const char* unit;
};
constexpr EnergyColumn energy_columns[] = {
    {"energy error", &SceneMeasurement::max_energy_error, &SceneBudget::max_energy_error, "J"},
    {"energy error with half-step velocities", &SceneMeasurement::max_energy_error_raw,
     &SceneBudget::max_energy_error_raw, "J"},
    {"energy made in a collision", &SceneMeasurement::energy_created, &SceneBudget::max_energy_created,
     "of the pair's"}};

void judge_one(const SceneMeasurement& m, const SceneBudget& budget, std::vector<GateFinding>& findings) {
  const auto add = [&](double severity, const std::string& message) {
    findings.push_back(
        {FindingKind::regression, m.type, m.scene + " " + m.run, message, severity, {m.reproduce}});
  };
  const auto absent = [&](const char* what) {
    findings.push_back({FindingKind::incomplete,
                        m.type,
                        m.scene + " " + m.run,
                        fmt::format("{} is budgeted and was not measured", what),
                        0,
                        {m.reproduce}});
  };
  const bool limits_energy =
      std::ranges::any_of(energy_columns, [&](const auto& c) { return (budget.*c.limit).has_value(); });
  if (!budget.t_s && !limits_energy) {
    findings.push_back({FindingKind::missing_budget,
                        m.type,
                        m.scene + " " + m.run,
                        "its budget limits nothing",
                        0,
                        {m.reproduce}});
  }
  if (budget.t_s) {
    if (!m.t_s) {
      absent("t_s");
    } else if (at_least(*m.t_s, *budget.t_s - t_s_allowance) != Standing::pass) {
      add(std::isnan(*m.t_s) ? HUGE_VAL : *budget.t_s / std::max(*m.t_s, 1e-9),
          fmt::format("true for {:g} s, budget {:g} s", *m.t_s, *budget.t_s));
    }
  }
  for (const auto& column : energy_columns) {
    if (!(budget.*column.limit)) continue;
    const double limit = *(budget.*column.limit);
    if (!(m.*column.value)) {
      absent(column.name);
    } else if (const double error = *(m.*column.value);
               !(error >= 0) || at_most(error, limit) != Standing::pass) {
      add(std::isnan(error) ? HUGE_VAL : error / std::max(limit, 1e-300),
          fmt::format("{} {:.4g} {}, budget {:.4g} {}", column.name, error, column.unit, limit, column.unit));
    }
  }
}

}  // namespace

std::string scene_budget_key(const SceneMeasurement& m) {
  return m.type + " " + m.run;
}

std::vector<GateFinding> judge_scenes(const std::vector<SceneMeasurement>& measured,
                                      const SceneBudgets& budgets, MissingRecords missing) {
  std::vector<GateFinding> findings;
  for (const auto& m : measured) {
    if (m.collisions_beyond > 0) {
      findings.push_back({FindingKind::regression,
                          m.type,
                          m.scene + " " + m.run,
                          fmt::format("{} collisions make energy beyond their condition, furthest {}",
                                      m.collisions_beyond, m.furthest_beyond),
                          HUGE_VAL,
                          {m.reproduce}});
    }
    const auto scene = budgets.find(m.scene);
    const SceneBudget* budget = nullptr;
    if (scene != budgets.end()) {
      const auto row = scene->second.find(scene_budget_key(m));
      if (row != scene->second.end()) budget = &row->second;
    }
    if (budget == nullptr) {
      findings.push_back({FindingKind::missing_budget,
                          m.type,
                          m.scene + " " + m.run,
                          "no budget; write one with --update",
                          0,
                          {m.reproduce}});
    } else {
      judge_one(m, *budget, findings);
    }
  }
  for (const auto& [scene, rows] : budgets) {
    for (const auto& [key, budget] : rows) {
      const bool found = std::ranges::any_of(measured, [&scene = scene, &key = key](const auto& m) {
        // By name: clang 14 captures no structured bindings.
        return m.scene == scene && scene_budget_key(m) == key;
      });
      if (!found && missing == MissingRecords::fail) {
        const std::size_t space = key.find(' ');
        findings.push_back({FindingKind::missing_record,
                            key.substr(0, space),
                            scene + key.substr(std::min(space, key.size())),
                            "budgeted but not measured",
                            0,
                            {}});
      }
    }
  }
  std::stable_sort(findings.begin(), findings.end(), [](const GateFinding& a, const GateFinding& b) {
    if (a.kind != b.kind) return a.kind < b.kind;
    return a.severity > b.severity;
  });
  return findings;
}

SceneBudget measured_scene_budget(const SceneMeasurement& m) {
  SceneBudget b;
  b.t_s = m.t_s;
  for (const auto& column : energy_columns) {
    if (m.*column.value) b.*column.limit = round_up(energy_margin * *(m.*column.value));
  }
  return b;
}

std::vector<Raise> update_scene_budgets(SceneBudgets& present, const std::vector<SceneMeasurement>& measured,
                                        const std::string& reason) {
  std::vector<Raise> raises;
  for (const auto& m : measured) {
    SceneBudget now = measured_scene_budget(m);
    auto& rows = present[m.scene];
    const auto old = rows.find(scene_budget_key(m));
    if (old == rows.end()) {
      rows[scene_budget_key(m)] = now;
      continue;
    }
    SceneBudget& kept = old->second;
    std::string what;
    const auto hold = [&](Limit limit, bool higher_is_looser, const char* name) {
      if (!(now.*limit)) return;
      if (!(kept.*limit)) {
        kept.*limit = now.*limit;
        return;
      }
      const double before = *(kept.*limit);
      const double after = *(now.*limit);
      const bool looser = higher_is_looser ? !(after <= before) : !(after >= before);
      if (looser) what += fmt::format(" {} {:g} -> {:g}", name, before, after);
      if (!looser || !reason.empty()) kept.*limit = now.*limit;
    };
    hold(&SceneBudget::t_s, false, "t_s");
    for (const auto& column : energy_columns) hold(column.limit, true, column.name);
    if (what.empty()) continue;
    raises.push_back({m.type, m.scene + " " + m.run, what});
    if (!reason.empty()) kept.reason = reason;
  }
  return raises;
}

}  // namespace ulpgate
