// TrajectorySetting: an initial value problem by one integrator in one type with equal or planned steps.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "harness/core/trajectories/step_plan.hpp"
#include "harness/core/trajectories/trajectory_engine.hpp"
#include "harness/core/trajectories/truth_path.hpp"
#include "harness/core/work_precision/setting_measurement.hpp"

namespace ulpgate {

using SharedTruth = std::shared_ptr<Shared<TruePath>>;

// What the runs of a problem to one end are held against.
struct ProblemTruths {
  SharedTruth equal;   // at the 16ths of the end: runs of equal steps, where steps end there
  SharedTruth graded;  // at the graded times: runs of planned steps

  [[nodiscard]] const SharedTruth& of(const WorkSetting& setting) const {
    return setting.planned() ? graded : equal;
  }
};
inline constexpr std::uint64_t compared_parts = 16;

// By our own integration (trajectories/truth_path.hpp), to so many digits, when it is first asked for.
[[nodiscard]] ProblemTruths shared_truths(const std::string& problem, const std::string& end, int digits);

// The setting of so many equal steps.
[[nodiscard]] WorkSetting equal_setting(const std::string& problem, const std::string& type,
                                        const std::string& integrator, const std::string& end,
                                        std::uint64_t steps);
// The setting of the steps that graded_plan() makes for a tolerance, "plan:1e-6"; its number of steps is that
// of the plan.  Throws as graded_plan().
[[nodiscard]] WorkSetting planned_setting(const std::string& problem, const std::string& type,
                                          const std::string& integrator, const std::string& end,
                                          double tolerance);

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
  [[nodiscard]] Trajectory run(std::uint64_t instants, const ode::StopFlag& stop) const;
  void judge(const Trajectory& got, const TruePath& truth, WorkOutcome& o) const;

  const TrajectoryEngine& engine_;
  SharedTruth truth_;
  double budget_;
  const GradedPlan* plan_ = nullptr;  // of planned steps
};

// Evaluations that a step takes, or about that where the method iterates.
[[nodiscard]] double evaluations_of_step(std::string_view integrator);

}  // namespace ulpgate
