// The gate over records of scenes: scenes.jsonl and correlation.jsonl against budgets in TOML.
#pragma once

#include <filesystem>

#include "harness/core/gate/scene_budgets.hpp"

namespace ulpgate::app {

// Whether `directory` holds records of scenes.
[[nodiscard]] bool has_scene_records(const std::filesystem::path& directory);
// Of `directory`; errors name file and line.
[[nodiscard]] std::vector<SceneMeasurement> read_scene_measurements(const std::filesystem::path& directory);
// <scene>.toml each, of a directory; none where it does not exist.
[[nodiscard]] SceneBudgets read_scene_budgets(const std::filesystem::path& directory);
void write_scene_budgets(const std::filesystem::path& directory, const SceneBudgets& budgets);

}  // namespace ulpgate::app
