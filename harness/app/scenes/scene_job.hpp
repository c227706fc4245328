// SceneJob: the options of `ulpgate scene`, and what they make of a scene.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/app/scenes/scene_files.hpp"
#include "harness/app/shell/failure.hpp"
#include "kernels/dem/engine/engine.hpp"

namespace ulpgate::app {

struct SceneOptions {
  std::string name;
  std::string types = "double";
  std::vector<std::string> overrides;
  std::string integrator = "leapfrog";
  std::string dt;
  std::string until;
  std::uint64_t steps = 0;
  int threads = 1;
  bool all_parts = false;
  bool explain = false;
  bool compare = false;
  bool own_constants = false;
  bool ladder = false;
  bool correlate = false;
  std::string reference = "mpfr150";
  bool record = false;  // series, and trajectories of chains
  bool series = false;
  bool resume = false;
  bool overwrite = false;
  double checkpoint_seconds = 30;
  bool vtk = false;
  std::string snapshots;
  unsigned repeats = 0;
  std::string out;
  bool json = false;
};

struct SceneJob {
  LoadedScene loaded;
  std::uint64_t steps = 0;
  std::uint64_t record_every = 0;  // steps; 0: at the end only
  std::vector<std::uint64_t> snapshot_steps;
  std::string plan_text;
  std::string plan;
};

// Reads the scene and applies the options to it.
[[nodiscard]] SceneJob make_job(const SceneOptions& o);
[[nodiscard]] std::unique_ptr<dem::DemEngine> engine_of(const std::string& token, dem::Level level,
                                                        const SceneJob& job, const SceneOptions& o,
                                                        bool all_parts);

// Prints what the scene leaves out, and the step time with and without.
void explain_scene(const std::string& token, const SceneJob& job, const SceneOptions& o);
// Iterations per second of every type; timing.jsonl where there is a directory.
[[nodiscard]] ExitCode measure_scene(const SceneJob& job, const SceneOptions& o,
                                     const std::vector<std::string>& types, const std::filesystem::path& out);
// Correlates the angles of a chain of bodies with the run in o.reference: t_s of every type, and what limits
// it.
[[nodiscard]] ExitCode correlate_scene(const SceneJob& job, const SceneOptions& o,
                                       const std::vector<std::string>& types,
                                       const std::filesystem::path& out);
// Starts the program again with a policy under which waiting threads sleep, where it has several.
void let_waiting_threads_sleep(int threads);

}  // namespace ulpgate::app
