// WorkPrecisionRow: what one setting of one subject came to, the part that is the same on every machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ulpgate {

enum class WorkSubject { function, kernel, trajectory, scene };
[[nodiscard]] std::string_view to_string(WorkSubject subject);
[[nodiscard]] std::optional<WorkSubject> work_subject_of(std::string_view text);

// What the dt of planned steps begins with.
inline constexpr std::string_view plan_mark = "plan:";

// What is run.
struct WorkSetting {
  WorkSubject subject = WorkSubject::function;
  std::string name;
  std::string type;        // token
  std::string integrator;  // empty of functions and kernels, as all that follows
  std::string end;         // time, as text: of a trajectory in the problem's unit, of a scene in s
  // Of a scene: the step as its reader takes it.  Of a trajectory "plan:1e-6", steps planned for that
  // tolerance, or empty: equal steps.
  std::string dt;
  std::uint64_t steps = 0;
  double dt_value = 0;  // end/steps, rounded: of planned steps their mean

  [[nodiscard]] bool planned() const { return dt.starts_with(plan_mark); }
  // All that the points of one curve of error over step share: "trajectory/kepler/double/leapfrog".
  [[nodiscard]] std::string curve() const;
  // Of no two settings of a run.
  [[nodiscard]] std::string key() const;
  friend bool operator==(const WorkSetting&, const WorkSetting&) = default;
};

enum class WorkFailure {
  none,
  diverged,  // the state left the numbers
  refused,   // by the method or by the scene, or more work than the budget
  mismatch,  // a function or kernel gave what no error in ULP describes
};
[[nodiscard]] std::string_view to_string(WorkFailure failure);  // "" of none
[[nodiscard]] std::optional<WorkFailure> work_failure_of(std::string_view text);

// What it came to.  Errors are relative: of a stiff problem's state the largest over the components of each
// relative to itself (one that has decayed to 1e-30 of its largest counts by that), of another's the largest
// component of the difference relative to the largest of the true state; of a scene the largest component of
// a movable body's position against the reference, relative to the scene's size; of a function its largest
// ULP error times 2^(1-p), a bound; of a kernel its largest normwise error.  A point that failed has none.
struct WorkOutcome {
  WorkFailure failure = WorkFailure::none;
  std::string why;                // of the failure, or a remark
  std::uint64_t steps = 0;        // taken: of a run that diverged, those to that point
  std::uint64_t evaluations = 0;  // of the force or the slope; of functions and kernels the arguments judged
  std::optional<double> final_error;
  std::optional<double> largest_error;      // of trajectories and scenes over `instants`
  std::optional<double> largest_error_ulp;  // of functions and kernels
  std::optional<double> energy_error;       // largest, relative to the energy's scale
  // Times at which a run was compared, the end among them: of equal steps those of the 16ths of the end
  // (scenes: at most 64 equal parts of it) that are ends of steps, of planned ones all graded times.
  std::optional<std::uint64_t> instants;
  // What the errors may be wrong by: the truth's own error, relative as they are.
  std::optional<double> reference_error;
  std::optional<double> t_s;  // s for which the angles of a chain stay true
  bool t_s_to_the_end = false;
  // d ln(error)/dt along a run of a scene, 1/s: how perturbations grow.
  std::optional<double> growth_rate;
  std::optional<double> correct_digits;  // of the final error, of functions and kernels of the largest

  // What a curve shows: the final error, of functions and kernels the largest.
  [[nodiscard]] std::optional<double> error() const;
  // One line, exact.
  [[nodiscard]] std::string to_text() const;
  // Throws std::invalid_argument where `text` is none.
  [[nodiscard]] static WorkOutcome from_text(std::string_view text);
  friend bool operator==(const WorkOutcome&, const WorkOutcome&) = default;
};

// -log10(error), from 0 to `most`; `most` for an error of 0.
[[nodiscard]] double correct_digits_of(double error, double most);

struct WorkPrecisionRow {
  WorkSetting setting;
  WorkOutcome outcome;
};

}  // namespace ulpgate
