// How long each type stays true: correlation of a scene's angles with a run of more digits.
#pragma once

#include <string>
#include <vector>

#include "harness/app/scenes/scene_run.hpp"
#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

struct CorrelationRequest {
  std::vector<std::string> types;
  std::string reference;  // the type of the run that the others are held against
  bool json = false;
  bool trust = false;  // takes the reference for true
};

// Runs the scene in the reference type, at RealHP<4> and at half the step, then in every other type; prints
// and, with records.out, writes t_s (s) of each and what limits it, which only those two runs tell: with
// `trust` they are left out.  Throws a Failure where the scene records
// no angles, or where Ctrl-C ended it.
[[nodiscard]] Verdict correlate_scene(const SceneJob& job, const CorrelationRequest& c,
                                      const RecordRequest& records);

}  // namespace ulpgate::app
