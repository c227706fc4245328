// SceneJob: what was asked for on the command line, made into a scene, its steps and a plan.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/app/scenes/scene_files.hpp"
#include "kernels/dem/engine/engine.hpp"

namespace ulpgate::app {

// What to simulate, as it was typed; what is absent is the scene's own.
struct SceneRequest {
  std::string name;                      // a scene built in, or the path of a TOML file
  std::vector<std::string> overrides;    // key=value
  std::string integrator = "leapfrog";   // a splitting method
  std::optional<std::string> dt;         // s, an expression
  std::optional<std::string> until;      // s, an expression
  std::optional<std::string> steps;      // instead of until
  std::optional<std::string> snapshots;  // s, comma-separated expressions
  int threads = 1;
  bool all_parts = false;  // nothing is left out
  bool energy = false;     // the energy account is kept, whatever the scene says
};

struct SceneJob {
  LoadedScene loaded;
  std::string variant;  // the overrides, comma-separated
  std::string integrator;
  std::uint64_t steps = 0;
  std::uint64_t record_every = 0;  // steps; 0: at the end only
  std::vector<std::uint64_t> snapshot_steps;
  int threads = 1;
  bool all_parts = false;
  std::string plan_text;
  std::string plan;
};

// The most steps of a run: every number of them is a double, as times are computed from it.
constexpr std::uint64_t most_steps = std::uint64_t{1} << 53U;
// A number of steps, 1 to most_steps.  Throws a Failure that names `option` and the text where it is none.
[[nodiscard]] std::uint64_t parse_steps(const std::string& option, const std::string& text);

// Reads the scene and applies the request to it.  Throws a Failure that names the option, or file, line and
// key.
[[nodiscard]] SceneJob make_job(const SceneRequest& request);
// The simulation at its start.  Throws a Failure where the integrator does not apply to the scene.
[[nodiscard]] std::unique_ptr<dem::DemEngine> engine_of(const std::string& token, dem::Level level,
                                                        const SceneJob& job);
// The instant of the velocities that a state holds: half a step before its positions (the leapfrog), or
// theirs (composition methods).
enum class Velocities { half_step, on_step };
[[nodiscard]] Velocities velocities_of(const SceneJob& job);
// What the kinetic energy of such velocities is called in records: "half_step" or "on_step".
[[nodiscard]] std::string name_of(Velocities velocities);

}  // namespace ulpgate::app
