// Watched steps.
#include "harness/app/scenes/watched_steps.hpp"

#include <fmt/format.h>

#include "harness/app/machine/environment.hpp"
#include "harness/core/watch/heartbeat.hpp"

namespace ulpgate::app {

void take_steps(dem::DemEngine& engine, std::uint64_t count, const SceneJob& job) {
  if (count == 0) return;
  const std::uint64_t first = engine.iteration() + 1;
  const WorkPlace place(
      job.loaded.scene.name, engine.type_name(),
      count == 1 ? fmt::format("step {}", first) : fmt::format("steps {} to {}", first, first + count - 1));
  engine.step(count);
  check_environment_of_team(job.threads);
}

}  // namespace ulpgate::app
