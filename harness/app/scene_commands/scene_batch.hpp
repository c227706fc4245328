// A batch: one scene in every type asked for, printed and recorded; what `run` and `compare` have in common.
#pragma once

#include <optional>

#include "harness/app/scene_commands/scene_options.hpp"

namespace ulpgate::app {

struct BatchRequest {
  // RealHP<4> runs beside every type, with these constants.
  std::optional<dem::Constants> compare;
  bool json = false;
};

// Writes scenes.jsonl and context.json where the task has a directory.  Throws a Failure of exit 3 where
// Ctrl-C ended it, with what was done written.
[[nodiscard]] Verdict run_batch(const SceneTask& task, const BatchRequest& batch);

}  // namespace ulpgate::app
