// The options that sub-verbs of `ulpgate scene` share, each spelt and checked in one place.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "harness/app/scenes/scene_run.hpp"
#include "harness/app/shell/action.hpp"

namespace ulpgate::app {

// What the options of a sub-verb fill; a verb adds those that it needs, and all others are refused.
struct SceneOptions {
  SceneRequest scene;
  std::string types = "double";
  RecordRequest records;
  std::string out;
  bool record = false;
  bool series = false;
  bool json = false;
};

// Adds a sub-verb with its purpose and two examples in its --help.  `run` is called with what is known to be
// taken by the verb: words that it does not take are refused before.
void add_scene_verb(CLI::App& scene, Action& action, const std::string& name, const std::string& purpose,
                    const std::vector<std::string>& examples, const std::shared_ptr<SceneOptions>& o,
                    const std::function<void(CLI::App&)>& add_options, const std::function<Verdict()>& run);

// --types, --set, --dt, --allow-large: every verb has them.
void add_model_options(CLI::App& verb, SceneOptions& o);
// --integrator
void add_integrator_option(CLI::App& verb, SceneOptions& o);
// --until or --steps
void add_length_options(CLI::App& verb, SceneOptions& o);
// --threads
void add_threads_option(CLI::App& verb, SceneOptions& o);
// --all-parts
void add_all_parts_option(CLI::App& verb, SceneOptions& o);
// --out
CLI::Option* add_out_option(CLI::App& verb, SceneOptions& o);
// --record or --series, --snapshots, --vtk; `series` is the help of --series.
void add_record_options(CLI::App& verb, SceneOptions& o, CLI::Option* out, const std::string& series);
// --overwrite
CLI::Option* add_overwrite_option(CLI::App& verb, SceneOptions& o, CLI::Option* out);
// --resume or --overwrite, --checkpoint-seconds
void add_checkpoint_options(CLI::App& verb, SceneOptions& o, CLI::Option* out);
// --collisions
void add_collisions_option(CLI::App& verb, SceneOptions& o);
// --json
void add_json_option(CLI::App& verb, SceneOptions& o);

// What the options ask for: the scene's job, and what is recorded of its runs.
struct SceneTask {
  SceneJob job;
  RecordRequest records;
  std::vector<std::string> types;
};
// Makes the job, and the directory of the records, which is of `verb` and of what it asks beside the scene;
// threads that wait are made to sleep.  Throws a Failure that names the option.
[[nodiscard]] SceneTask make_task(SceneOptions o, const std::string& verb, const std::string& beside = "");

}  // namespace ulpgate::app
