// SceneJob: what was asked for on the command line, made into a scene, its steps and a plan.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/app/scenes/scene_files.hpp"
#include "harness/app/shell/failure.hpp"
#include "kernels/dem/engine/engine.hpp"
#include "kernels/scenes/reader/scene_fault.hpp"

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
  bool all_parts = false;   // nothing is left out
  bool energy = false;      // the energy account is kept, whatever the scene says
  bool collisions = false;  // a ledger of collisions is kept
  // More memory, steps or records than a run takes without being asked.
  bool allow_large = false;
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
  bool allow_large = false;
  bool collisions = false;  // a ledger of them is kept; no part of the plan, whose trajectory is the same
  std::string plan_text;
  std::string plan;
};

// The most steps of a run: every number of them is a double, as times are computed from it.
constexpr std::uint64_t most_steps = std::uint64_t{1} << 53U;
// A number of steps, 1 to most_steps.  Throws a Failure that names `option` and the text where it is none.
[[nodiscard]] std::uint64_t parse_steps(const std::string& option, const std::string& text);

// `fault` as it is told to people, with the option that takes a large scene all the same.
[[nodiscard]] Failure scene_failure(const std::string& what, const scenes::SceneFault& fault);

// Reads the scene and applies the request to it.  Throws a Failure that names the option, or file, line and
// key.
[[nodiscard]] SceneJob make_job(const SceneRequest& request);
// More work, or more records, than this is refused unless the job allows it.
constexpr double most_body_steps = 1e14;
constexpr std::uint64_t most_records = 100'000'000;
// Throws a Failure where the scene is none in one of the types, or more than may be taken without
// allow_large: the sizes of everything are known before any of it is written.
void check_job(const SceneJob& job, const std::vector<std::string>& types);
// The simulation at its start.  Throws a Failure that names the type, and the key or the body, where the
// scene cannot be simulated in it, or where the integrator does not apply to the scene.
[[nodiscard]] std::unique_ptr<dem::DemEngine> engine_of(const std::string& token, dem::Level level,
                                                        const SceneJob& job);
// The instant of the velocities that a state holds: half a step before its positions (the leapfrog), or
// theirs (composition methods).
enum class Velocities { half_step, on_step };
[[nodiscard]] Velocities velocities_of(const SceneJob& job);
// What the kinetic energy of such velocities is called in records: "half_step" or "on_step".
[[nodiscard]] std::string name_of(Velocities velocities);

}  // namespace ulpgate::app
