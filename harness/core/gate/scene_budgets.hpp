// Budgets of scenes: how long a type must stay true and how far its energy may err.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/core/gate/budgets.hpp"

namespace ulpgate {

// What one run of a scene in one type showed.
struct SceneMeasurement {
  std::string scene;
  std::string type;
  std::string run;            // what else fixes its numbers: "leapfrog dt=1e-5 steps=1200000 mass=yade"
  std::optional<double> t_s;  // s
  std::optional<double> max_energy_error;  // J
  std::optional<double> max_energy_error_raw;
  std::string reproduce;  // a command
  // Of a ledger of collisions, where one was kept and some have ended: the largest part of a pair's energy
  // that one of them made from nothing.
  std::optional<double> energy_created{};
  // Those that made more than their condition allows, and which of them went furthest.
  std::uint64_t collisions_beyond = 0;
  std::string furthest_beyond{};
};

struct SceneBudget {
  std::optional<double> t_s;  // least
  std::optional<double> max_energy_error;
  std::optional<double> max_energy_error_raw;
  std::optional<double> max_energy_created;
  std::string reason;
  friend bool operator==(const SceneBudget&, const SceneBudget&) = default;
};

// By scene, then by "type run".
using SceneBudgets = std::map<std::string, std::map<std::string, SceneBudget>>;

[[nodiscard]] std::string scene_budget_key(const SceneMeasurement& m);

// t_s comes in chunks of 0.05 s: another C library may start a chaotic run from a last digit that differs and
// lose two of them.
inline constexpr double t_s_allowance = 0.1;

// GateFinding::at holds the one command that reproduces the run.  A NaN is beyond every budget.  That no
// collision makes energy beyond its condition needs none: it holds whatever the budgets say.
[[nodiscard]] std::vector<GateFinding> judge_scenes(const std::vector<SceneMeasurement>& measured,
                                                    const SceneBudgets& budgets, MissingRecords missing);

// The measured t_s; energies with a tenth above, rounded up to three digits.
[[nodiscard]] SceneBudget measured_scene_budget(const SceneMeasurement& m);

// Limits become tighter and rows appear freely; one that would become looser is listed, and changed only with
// a reason.
[[nodiscard]] std::vector<Raise> update_scene_budgets(SceneBudgets& present,
                                                      const std::vector<SceneMeasurement>& measured,
                                                      const std::string& reason);

}  // namespace ulpgate
