// WorkPrecisionJob: what `ulpgate work-precision` is to measure, from its options.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "harness/app/advice/scene_setting.hpp"
#include "harness/app/orders/measurement_run.hpp"
#include "harness/core/work_precision/trajectory_setting.hpp"

namespace ulpgate::app {

struct WorkPrecisionOptions {
  std::string subjects;  // "function", "kernel", "trajectory", "scene" or names, comma-separated
  std::string cases;     // problems, scenes built in or files of scenes
  std::string types = "double";
  std::string integrators = "all";
  std::string steps;                   // of trajectories: "64,128" or "64..4096", which doubles
  std::string dt;                      // of scenes, s: texts, comma-separated
  std::string until;                   // an end of the problem; of a scene s
  std::vector<std::string> overrides;  // of scenes
  std::uint64_t samples = 2000;        // of functions and kernels
  int digits = 30;                     // of true solutions
  double budget = default_evaluation_budget;
  unsigned repeats = 5;
  unsigned threads = 0;
  std::string out;
  bool resume = false;
  bool overwrite = false;
  bool json = false;
};

struct WorkPrecisionJob {
  std::vector<std::string> types;
  std::vector<std::unique_ptr<Measurement>> measurements;
  std::vector<const SettingMeasurement*> settings;  // the same
  std::vector<CostModel::Row> costs;                // of them
  std::string plan_text;
  std::string plan;  // its hash
};

// Throws a Failure that names the option, and where nothing is left to measure.
[[nodiscard]] WorkPrecisionJob make_work_precision_job(const WorkPrecisionOptions& o);

// Names of the problems, and whether a name is one.
[[nodiscard]] std::vector<std::string> problem_names();
[[nodiscard]] const InitialValueInfo* find_problem(const std::string& name);
// "all" or names, in the order of the list of integrators, each once.
[[nodiscard]] std::vector<std::string> select_integrators_of(const std::string& text);
// `until` where it is one of the problem's ends, the first of them where it is empty.  Throws a Failure.
[[nodiscard]] std::string end_of_problem(const InitialValueInfo& problem, const std::string& until);
// "64,128", "64..4096"; each once, rising.  Throws a Failure.
[[nodiscard]] std::vector<std::uint64_t> step_list(const std::string& text);

// A scene at several steps that all end at the same time.
struct SceneLadder {
  SceneRequest scene;            // at its coarsest step, steps given
  std::vector<std::string> dts;  // from the coarsest on
  std::vector<std::uint64_t> steps;
  double until_s = 0;
  std::string end;  // until_s as text
  SceneInstants instants;
};
// `dt` is a list, or empty: the scene's own step times 2^coarser, and so on down to 2^-finer.  `until` may be
// empty: see default_until_s.
[[nodiscard]] SceneLadder scene_ladder(const std::string& name, const std::vector<std::string>& overrides,
                                       const std::string& dt, const std::string& until, int coarser,
                                       int finer);
// The scene's own end, at most 1 s and at most so many steps of its own size that their number times that of
// bodies is below 2e6.
[[nodiscard]] double default_until_s(const SceneJob& job);
// The methods of `names` that the scene admits.
[[nodiscard]] std::vector<std::string> admitted(const SceneLadder& ladder,
                                                const std::vector<std::string>& names);
// The setting of rung k of a ladder.
[[nodiscard]] std::unique_ptr<SceneSetting> scene_setting(const SceneLadder& ladder, std::size_t k,
                                                          const std::string& type,
                                                          const std::string& integrator,
                                                          const SharedReference& reference);

}  // namespace ulpgate::app
