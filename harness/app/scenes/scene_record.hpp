// What a run records on its way: the series, the trajectory at full precision, and checkpoints to go on from.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/app/scenes/scene_job.hpp"
#include "harness/app/scenes/vouched_file.hpp"
#include "harness/app/store/records.hpp"
#include "harness/core/collisions/collision_summary.hpp"
#include "harness/core/scenes/energy_drift.hpp"
#include "kernels/dem/engine/engine.hpp"
#include "reference/types/mpfr_value.hpp"

namespace ulpgate::app {

struct RecordPlan {
  std::string stem;                // of every file, <scene>_<type> of an ordinary run
  std::string plan;                // hash; a checkpoint of another plan is refused
  std::uint64_t record_every = 0;  // steps between records
  Velocities velocities = Velocities::half_step;
  bool chain = false;        // the scene records the angles of a chain of bodies
  bool series = false;       // write series/<stem>.csv
  bool trajectory = false;   // write trajectory/<stem>.csv
  int digits = 17;           // decimal digits that identify a number of the type
  int bits = 53;             // of the type
  double checkpoint_s = 30;  // between checkpoints
  // Where a ledger of collisions is kept: what its rows begin with, scene, type, dt ...; else null.
  Json collisions_of;
};

// What is known of a run from the rows of its series.
struct SceneStatistics {
  double energy_start = 0;  // sum of the account, J
  EnergyDrift averaged;     // kinetic energy from the mean of the half-step velocities
  EnergyDrift raw;          // from the half-step velocities themselves
  // Products of the chain's angles at multiples of record_every, from step 0.
  std::vector<double> products;
};

// Columns of the series: step, time_s, kinetic_half_step_J or kinetic_on_step_J (translation and rotation, of
// the velocities as the state holds them), the energy account by its names, energy_error_J and
// raw_energy_error_J (against the account of the first step, subtracted exactly), angle_<i>_rad,
// angle_product, mean_x_m, mean_y_m, mean_z_m; numbers as doubles. Columns of the trajectory: step, time_s,
// the angles and their product, x_i, y_i, z_i, vx_i, vy_i, vz_i of every movable body i, the energy account;
// decimal, as many digits as identify a number of the type.
class SceneRecorder {
 public:
  // Without a directory nothing is written and the statistics are kept all the same.  `fresh` stands at the
  // start.
  SceneRecorder(std::filesystem::path out, RecordPlan plan, const dem::DemEngine& fresh);

  // Goes on from the checkpoint where there is one: the files are cut to what it vouches for, `engine`, fresh
  // from the scene, is set to its state.  Throws a Failure that names the file where it cannot be used.
  [[nodiscard]] bool resume(dem::DemEngine& engine);
  // Opens the files of a run from the start.
  void begin();
  void add(const dem::DemEngine& engine);
  // Those that have ended since the last call; nothing where no ledger is kept.
  void add_collisions(dem::DemEngine& engine);
  // Those that the end of the run leaves open, and the totals; behind the last checkpoint.
  void end_collisions(const dem::DemEngine& engine);
  [[nodiscard]] bool checkpoint_is_due() const;
  // Everything recorded so far is on disk before the checkpoint names it.
  void checkpoint(dem::DemEngine& engine);
  // Writes what is left; without one a failure to write would go unseen.
  void close();

  [[nodiscard]] const SceneStatistics& statistics() const { return statistics_; }
  [[nodiscard]] const CollisionSummary& collisions() const { return collisions_; }

 private:
  [[nodiscard]] std::string header(const dem::DemEngine& engine) const;
  [[nodiscard]] std::string trajectory_header(const dem::DemEngine& engine) const;
  [[nodiscard]] std::string trajectory_row(const dem::DemEngine& engine) const;
  void note_start(const dem::DemEngine& engine);
  void replay(const std::string& series);
  [[nodiscard]] std::filesystem::path checkpoint_file() const;
  void add_collision(const dem::CollisionRecord& record);

  std::filesystem::path out_;
  RecordPlan plan_;
  std::vector<std::string> energy_names_;
  std::string header_, trajectory_header_;
  VouchedFile series_, trajectory_, ledger_;
  CollisionSummary collisions_;
  std::uint64_t collision_rows_ = 0;
  std::optional<MpfrValue> start_sum_, start_raw_;
  SceneStatistics statistics_;
  std::chrono::steady_clock::time_point last_checkpoint_ = std::chrono::steady_clock::now();
};

// Rows of a ledger in a file, of each run; the totals count all collisions.
inline constexpr std::uint64_t most_collision_rows = 20'000;
// The lines that the run of this stem left, of a run that is complete.
[[nodiscard]] std::string collision_lines_of(const std::filesystem::path& out, const std::string& stem);

// Of a run that is complete.
void remove_checkpoints(const std::filesystem::path& out);

}  // namespace ulpgate::app
