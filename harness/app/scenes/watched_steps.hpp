// Steps of a simulation under the eyes of the watchdog, in a floating-point environment that is looked at.
#pragma once

#include <cstdint>

#include "harness/app/scenes/scene_job.hpp"

namespace ulpgate::app {

// Takes `count` steps of an engine of the job.  The watchdog ends the program, with exit code 4 and the
// scene, type and steps, where none of the job's threads gets on for --timeout seconds.  Throws a Failure
// where the environment of any of them is not the standard one behind the steps: they are void then.
void take_steps(dem::DemEngine& engine, std::uint64_t count, const SceneJob& job);

}  // namespace ulpgate::app
