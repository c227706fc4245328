// One simulation from its start, or its checkpoint, to its end, with all that is recorded on the way.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/app/scenes/scene_job.hpp"
#include "harness/app/scenes/scene_record.hpp"
#include "harness/app/store/records.hpp"
#include "harness/core/scenes/scene_compare.hpp"

namespace ulpgate::app {

struct RunRequest {
  std::string token;
  dem::Level level = dem::Level::own;
  std::string stem;  // of the files
  std::string label;
  bool compare = false;     // RealHP<4> runs beside it
  bool trajectory = false;  // at full precision
};

struct FinishedRun {
  std::unique_ptr<dem::DemEngine> engine;
  SceneStatistics statistics;
  std::vector<Divergence> divergence;
  bool complete = true;  // else interrupted; its checkpoint is written
};

// <scene>_<type>.
[[nodiscard]] std::string stem_of(const SceneJob& job, const std::string& token);

[[nodiscard]] FinishedRun run_to_end(const RunRequest& request, const SceneJob& job, const SceneOptions& o,
                                     const std::filesystem::path& out);

// The line of scenes.jsonl.
[[nodiscard]] Json scene_row(const FinishedRun& run, const std::string& token, const SceneJob& job,
                             const SceneOptions& o);

}  // namespace ulpgate::app
