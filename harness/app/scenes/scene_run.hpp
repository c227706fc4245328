// One simulation from its start, or its checkpoint, to its end, with all that is recorded on the way.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/app/scenes/scene_job.hpp"
#include "harness/app/scenes/scene_record.hpp"
#include "harness/app/store/records.hpp"
#include "harness/core/scenes/scene_compare.hpp"

namespace ulpgate::app {

// What a verb writes of its runs, and where.
struct RecordRequest {
  std::filesystem::path out;  // empty: nothing is written
  bool series = false;
  bool trajectory = false;  // of a chain, at full precision
  bool vtk = false;         // of every snapshot
  bool resume = false;      // from checkpoints in `out`
  bool overwrite = false;   // checkpoints in `out` that are not gone on from
  double checkpoint_s = 30;
};

struct RunRequest {
  std::string token;
  dem::Level level = dem::Level::own;
  std::string stem;  // of the files
  std::string label;
  // RealHP<4> runs beside it from the same state, with these constants.
  std::optional<dem::Constants> compare;
};

struct FinishedRun {
  std::unique_ptr<dem::DemEngine> engine;
  SceneStatistics statistics;
  std::vector<Divergence> divergence;
  bool complete = true;  // else interrupted; its checkpoint is written
};

// <scene>_<type>.
[[nodiscard]] std::string stem_of(const SceneJob& job, const std::string& token);

// Writes what `records` asks for.  Ctrl-C ends it early: the run is then not complete.
[[nodiscard]] FinishedRun run_to_end(const RunRequest& request, const SceneJob& job,
                                     const RecordRequest& records);

// The line of scenes.jsonl: nothing that depends on the machine, the time or the number of threads.
[[nodiscard]] Json scene_row(const FinishedRun& run, const std::string& token, const SceneJob& job);

// Starts the program again with a policy under which waiting threads sleep, where it has several.
void let_waiting_threads_sleep(int threads);

}  // namespace ulpgate::app
