// SceneReference: the states of a scene at common instants, by ever smaller steps and more digits.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/app/scenes/scene_job.hpp"
#include "harness/app/store/kept_results.hpp"
#include "harness/core/work_precision/setting_measurement.hpp"

namespace ulpgate::app {

// Instants that all settings of a scene reach after whole numbers of steps.
struct SceneInstants {
  std::uint64_t positions = 1;  // at which positions are compared, the end among them
  // At which the product of a chain's angles is compared, a multiple of `positions`; of a scene without
  // angles, or of too few records for a correlation, the same.
  std::uint64_t records = 1;
  bool angles = false;
};
// For runs of these numbers of steps, all of which end at `until_s`; `dt_s` is the job's own step.
[[nodiscard]] SceneInstants instants_of(const SceneJob& job, double dt_s,
                                        const std::vector<std::uint64_t>& steps, double until_s);
// A type that is good enough for rough figures: double where it was built.
[[nodiscard]] const std::string& rough_type();

// What a run of a scene is looked at for.
struct SceneView {
  std::vector<std::vector<MpfrValue>> positions;  // by instant: x, y, z of every movable body, exact
  std::vector<double> products;                   // of the angles, from the start
};

// The largest component of a difference, by instant, relative to `size_m`.
[[nodiscard]] std::vector<double> position_errors(const SceneView& got, const SceneView& wanted,
                                                  double size_m);
// The longest side of the box around all bodies at the start, m.
[[nodiscard]] double scene_size(const dem::DemEngine& engine);
// "movable" in the order of their numbers.
void add_positions(const dem::DemEngine& engine, SceneView& view);

struct SceneReference {
  SceneView view;
  double size_m = 1;
  // Largest distance between the two finest runs, relative to the size: what the reference may be wrong by.
  double error = 0;
  std::string text;  // "sofroniou_spaletta10, dt = 1e-5/8, RealHP<4> of float"

  // Exact: what is read back gives the same records.
  [[nodiscard]] std::vector<std::string> to_lines() const;
  // Nothing where the lines are none.
  [[nodiscard]] static std::optional<SceneReference> from_lines(const std::vector<std::string>& lines);
};
// Where a run keeps its references; empty where it has no directory.
using KeptPlace = std::shared_ptr<std::optional<KeptResults>>;
using SharedReference = std::shared_ptr<Shared<SceneReference>>;

inline constexpr double most_reference_work = 4e7;  // evaluations of a body
struct ReferenceRequest {
  SceneRequest scene;  // of dt and steps at the coarsest setting
  std::uint64_t finest_steps = 1;
  SceneInstants instants;
  long bits = 53;           // of the most precise of the types that are held against it
  double wanted_error = 0;  // relative to the size: no finer one is needed
  // By the leapfrog, which converges slowly, no more steps than this; 0: as many as it takes.
  std::uint64_t most_steps = 0;
  double most_work = most_reference_work;

  // All that the reference depends on.
  [[nodiscard]] std::string key() const;
};
// The first level of precision whose RealHP<4> has enough bits runs the scene with the integrator of highest
// order that it admits, halving the step until two runs agree to the wanted error or the next would be more
// than most_work.  Where only the leapfrog applies, from a quarter of the finest step on.
[[nodiscard]] SharedReference shared_reference(ReferenceRequest request, KeptPlace kept = {});

// "1e-5*4", "1e-5", "1e-5/8": a step 2^k times as large.
[[nodiscard]] std::string scaled_dt(const std::string& dt, int k);

// Whether the scene, in this type, can be integrated by a method.
[[nodiscard]] bool admits(const SceneRequest& scene, const std::string& token, const std::string& integrator);

}  // namespace ulpgate::app
