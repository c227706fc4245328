// One simulation from its start, or its checkpoint, to its end, with all that is recorded on the way.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/app/scenes/scene_job.hpp"
#include "harness/app/scenes/scene_record.hpp"
#include "harness/app/store/output_directory.hpp"
#include "harness/core/scenes/finite_watch.hpp"
#include "harness/core/scenes/scene_compare.hpp"

namespace ulpgate::app {

// What a verb writes of its runs, and where.
struct RecordRequest {
  std::filesystem::path out;                         // empty: nothing is written
  std::shared_ptr<const OutputDirectory> directory;  // that of `out`; none where nothing is written
  Json context;                                      // of the runs, while they are not finished
  bool series = false;
  bool trajectory = false;  // of a chain, at full precision
  bool vtk = false;         // of every snapshot
  bool resume = false;      // from checkpoints in `out`
  bool overwrite = false;   // what an earlier run left in `out`
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
  CollisionSummary collisions;  // where the job keeps a ledger
  std::vector<Divergence> divergence;
  // Where the state stopped being finite, which ends the run: "collision in float: diverged at step 12: ...".
  std::optional<std::string> diverged;
  bool complete = true;  // else interrupted; its checkpoint is written
};

// Watches a simulation of the job, which must outlive it.
[[nodiscard]] FiniteWatch finite_watch(const std::string& token, dem::Level level, const SceneJob& job);
// "collision in float: diverged at step 12: the velocity of body 0 is not finite"
[[nodiscard]] std::string diverged_text(const SceneJob& job, const std::string& type, const LostState& lost);

// <scene>_<type>.
[[nodiscard]] std::string stem_of(const SceneJob& job, const std::string& token);

// Writes what `records` asks for.  Ctrl-C ends it early: the run is then not complete.  So does a state that
// is no longer finite: its records end with the last finite one.
[[nodiscard]] FinishedRun run_to_end(const RunRequest& request, const SceneJob& job,
                                     const RecordRequest& records);

// The line of scenes.jsonl: nothing that depends on the machine, the time or the number of threads.
[[nodiscard]] Json scene_row(const FinishedRun& run, const std::string& token, const SceneJob& job);

// Starts the program again with a policy under which waiting threads sleep, where it has several.
void let_waiting_threads_sleep(int threads);

}  // namespace ulpgate::app
