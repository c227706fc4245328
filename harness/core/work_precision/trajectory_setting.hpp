// TrajectorySetting: an initial value problem by one integrator in one type with one number of steps.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "harness/core/trajectories/trajectory_engine.hpp"
#include "harness/core/work_precision/setting_measurement.hpp"

namespace ulpgate {

// The true state at the end.
struct TrajectoryTruth {
  std::vector<std::string> state;  // decimal
  double error = 0;                // of it, relative to the component; absolute where the truth is 0
};
using SharedTruth = std::shared_ptr<Shared<TrajectoryTruth>>;

// By our own integration (trajectories/truth.hpp), to so many digits.
[[nodiscard]] SharedTruth shared_truth(const std::string& problem, const std::string& end, int digits);

// More evaluations than this are refused before they begin: a setting that nobody would choose.
inline constexpr double default_evaluation_budget = 1e8;

class TrajectorySetting final : public SettingMeasurement {
 public:
  // `engine` of setting.type, which outlives it.  `budget`: of evaluations, by what the method is known to
  // take a step.
  TrajectorySetting(WorkSetting setting, const TrajectoryEngine& engine, SharedTruth truth, double budget);

  [[nodiscard]] Work prepare() const override;

 protected:
  [[nodiscard]] WorkOutcome measure(const ode::StopFlag& stop) override;

 private:
  [[nodiscard]] Trajectory run(const ode::StopFlag& stop) const;

  const TrajectoryEngine& engine_;
  SharedTruth truth_;
  double budget_;
};

// Evaluations that a step takes, or about that where the method iterates.
[[nodiscard]] double evaluations_of_step(std::string_view integrator);

}  // namespace ulpgate
