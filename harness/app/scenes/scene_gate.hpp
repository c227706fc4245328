// The gate over records of scenes: scenes.jsonl and correlation.jsonl against budgets in TOML.
#pragma once

#include <filesystem>

#include "harness/core/gate/scene_budgets.hpp"

namespace ulpgate::app {

// Whether `directory` holds records of scenes.
[[nodiscard]] bool has_scene_records(const std::filesystem::path& directory);
// Of `directory`, which holds a whole run of one plan.  Throws a Failure that names file and line: for rows
// of another plan, negative numbers and second records of a run too.
[[nodiscard]] std::vector<SceneMeasurement> read_scene_measurements(const std::filesystem::path& directory);
// <scene>.toml each, of a directory that exists; every row limits something, by a finite number.
[[nodiscard]] SceneBudgets read_scene_budgets(const std::filesystem::path& directory);
// Every file is read back before any old one is replaced; numbers that are not finite are refused.
void write_scene_budgets(const std::filesystem::path& directory, const SceneBudgets& budgets);

}  // namespace ulpgate::app
