// WorkPrecisionJob: what `ulpgate work-precision` is to measure, from its options.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "harness/app/advice/scene_setting.hpp"
#include "harness/app/orders/measurement_run.hpp"
#include "harness/app/store/kept_results.hpp"
#include "harness/core/work_precision/trajectory_setting.hpp"

namespace ulpgate::app {

struct WorkPrecisionOptions {
  std::string subjects;  // "function", "kernel", "trajectory", "scene" or names, comma-separated
  std::string cases;     // problems, scenes built in or files of scenes
  std::string types = "double";
  std::string integrators = "all";
  std::string steps;  // of trajectories: "64,128" or "64..4096", which doubles
  // Of scenes: texts, s.  Of trajectories "plan:1e-6" or "plan:1e-3..1e-12", by decades.  Comma-separated.
  std::string dt;
  std::string until;                   // an end of the problem; of a scene s
  std::vector<std::string> overrides;  // of scenes
  std::uint64_t samples = 2000;        // of functions and kernels
  int digits = 0;                      // of true solutions; 0: default_digits() of the types
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
  KeptPlace
      kept;  // of truths and references: to be filled before the measurements where there is a directory
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
// What --dt names.
struct DtChoices {
  std::string of_scenes;           // comma-separated
  std::vector<double> tolerances;  // of planned steps, each once, falling
};
// Throws a Failure.
[[nodiscard]] DtChoices dt_choices(const std::string& text);
// As shared_truths(); what `kept` has, which is looked at when it is needed, is not computed again.
[[nodiscard]] ProblemTruths kept_truths(const std::string& problem, const std::string& end, int digits,
                                        const KeptPlace& kept);
// Two or more decimal digits beyond the widest of the types, from 15 to 34: more take a wider type, and
// minutes.
[[nodiscard]] int default_digits(const std::vector<std::string>& types);

// One step of a scene.
struct SceneRung {
  std::string dt;  // as its reader takes it
  std::uint64_t steps = 0;
};
// A scene at several steps that all end at the same time.
struct SceneLadder {
  SceneRequest scene;            // at its coarsest step, steps given
  std::vector<SceneRung> rungs;  // from the coarsest on
  double until_s = 0;
  double own_end_s = 0;  // of the scene, or until_s where that was asked for
  std::string end;       // until_s as text
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
// A step between two rungs: about 2^-halvings times the coarsest, such that as many steps fall on the
// ladder's end and on each of its instants.
[[nodiscard]] SceneRung rung_between(const SceneLadder& ladder, double halvings);
// The setting of a rung.
[[nodiscard]] std::unique_ptr<SceneSetting> scene_setting(const SceneLadder& ladder, const SceneRung& rung,
                                                          const std::string& type,
                                                          const std::string& integrator,
                                                          const SharedReference& reference);

}  // namespace ulpgate::app
